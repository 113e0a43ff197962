// Reader of Event Stream 2 (.es), DVS and ATIS.

#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/buffered_source.h"
#include "io/base/known_formats.h"
#include "io/base/sensor_size.h"
#include "io/base/writers.h"
#include "io/records/event_stream.h"

namespace scarf {
namespace {

using namespace event_stream;

constexpr std::string_view kName = "es";

class EventStreamReader final : public BufferedSource {
 public:
  EventStreamReader(Input input, SensorSize sensor, Type type, const ReadOptions& options)
      : BufferedSource(std::move(input.bytes), std::move(input.name), sensor, options),
        bottom_row_(static_cast<uint16_t>(sensor.height - 1)),
        type_(type) {}

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool /*last*/, std::span<Event> out) override {
    const Decoded decoded = type_ == kDvs ? decode_dvs(bytes, out) : decode_atis(bytes, out);
    return {decoded.bytes, tally_.keep(out.first(decoded.events)), decoded.starved};
  }

 private:
  // A row above the sensor becomes one far below it: the difference wraps to at least the sensor's height.
  uint16_t row_from_top(uint16_t y) const { return static_cast<uint16_t>(bottom_row_ - y); }

  Event event_at(const uint8_t* at, uint8_t p) const {
    return {t_, load_little_endian<uint16_t>(at + 1), row_from_top(load_little_endian<uint16_t>(at + 3)), p};
  }

  Decoded decode_dvs(std::span<const uint8_t> bytes, std::span<Event> out) {
    size_t count = 0;
    size_t at = 0;
    while (count < out.size() && at < bytes.size()) {
      const uint8_t code = bytes[at];
      if (code >= kDvsReset) [[unlikely]] {
        if (code == kDvsOverflow) t_ += kDvsOverflowTime;
        ++at;
        continue;
      }
      if (at + kEventBytes > bytes.size()) break;
      t_ += code >> 1;
      out[count++] = event_at(bytes.data() + at, code & 1);
      at += kEventBytes;
    }
    return {at, count, count < out.size()};
  }

  Decoded decode_atis(std::span<const uint8_t> bytes, std::span<Event> out) {
    size_t count = 0;
    size_t at = 0;
    while (count < out.size() && at < bytes.size()) {
      const uint8_t code = bytes[at];
      if ((code & kAtisOverflowMask) == kAtisOverflowMask) {
        t_ += kAtisOverflowTime * (code & 3);
        ++at;
        continue;
      }
      if (at + kEventBytes > bytes.size()) break;
      t_ += code >> 2;
      // Odd codes begin and end exposures; they are no brightness changes.
      const bool change = (code & 1) == 0;
      if (change) out[count++] = event_at(bytes.data() + at, code >> 1 & 1);
      at += kEventBytes;
    }
    return {at, count, count < out.size()};
  }

  uint16_t bottom_row_;
  Type type_;
  int64_t t_ = 0;
};

Error cannot(std::string_view what) {
  return {ErrorCode::bad_input, text("this Event Stream ", what)};
}

Result<std::unique_ptr<EventSource>> open_event_stream(Input input, const ReadOptions& options) {
  if (const auto filled = input.bytes.fill(kHeaderBytes); !filled) return filled.error();
  const auto bytes = input.bytes.available();
  if (bytes.size() <= kTypeAt || !starts_with(bytes, kMagic)) return cannot("has no whole header");
  const auto major = bytes[kMagic.size()];
  if (major != kMajorVersion) {
    return cannot(text("has version ", int{major}, "; scarf reads version ", int{kMajorVersion}));
  }
  const auto type = static_cast<Type>(bytes[kTypeAt]);
  switch (type) {
    case kDvs:
    case kAtis:
      break;
    case kGeneric:
      return Error{ErrorCode::unrecognised,
                   "this Event Stream is a generic one, which holds no events of pixels"};
    case kColor:
      return cannot("holds colours, not brightness changes");
    case kAmd:
    default:
      return cannot(text("has type ", int{type}, "; scarf reads 1 (DVS) and 2 (ATIS)"));
  }
  if (bytes.size() < kHeaderBytes) return cannot("has no whole header");
  const auto legal = checked_sensor(load_little_endian<uint16_t>(bytes.data() + kSizeAt),
                                    load_little_endian<uint16_t>(bytes.data() + kSizeAt + 2), "the header");
  if (!legal) return legal.error();
  if (const auto agreed = agreed_sensor(*legal, options.sensor); !agreed) return agreed.error();
  input.bytes.skip(kHeaderBytes);
  return std::unique_ptr<EventSource>(
      std::make_unique<EventStreamReader>(std::move(input), *legal, type, options));
}

bool recognise_event_stream(const Beginning& beginning) {
  return starts_with(beginning.bytes, kMagic);
}

}  // namespace

const Format kEventStreamFormat = {.name = kName,
                                   .title = "Event Stream 2 (.es), DVS and ATIS",
                                   .recognise = recognise_event_stream,
                                   .open = open_event_stream,
                                   .create = create_event_stream};

}  // namespace scarf
