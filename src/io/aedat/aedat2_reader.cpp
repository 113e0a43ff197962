// Reader of AEDAT 1 and 2.
#include <type_traits>
#include <utility>

#include "io/aedat/aedat2.h"
#include "io/base/buffered_source.h"
#include "io/base/decoded_triggers.h"
#include "io/base/known_formats.h"
#include "io/base/put_event.h"

namespace scarf {
namespace {

using aedat2::Chip;
using aedat2::Clock;
using aedat2::Layout;
using aedat2::Record;

constexpr std::string_view kName1 = "aedat1";
constexpr std::string_view kName2 = "aedat2";

uint32_t load_big_endian(const uint8_t* from) {
  return uint32_t{from[0]} << 24 | uint32_t{from[1]} << 16 | uint32_t{from[2]} << 8 | from[3];
}

// The records of a version: an address and a time.
template <int version>
struct Records {
  static constexpr size_t kAddressBytes = version == 1 ? 2 : 4;
  static constexpr size_t kBytes = kAddressBytes + 4;

  static uint32_t address(const uint8_t* record) {
    if constexpr (version == 1) return uint32_t{record[0]} << 8 | record[1];
    return load_big_endian(record);
  }
  static int32_t time(const uint8_t* record) {
    return static_cast<int32_t>(load_big_endian(record + kAddressBytes));
  }
};

template <int version>
class Aedat2Reader final : public BufferedSource {
  using Words = Records<version>;

 public:
  Aedat2Reader(Input input, const Chip& chip, const ReadOptions& options)
      : BufferedSource(std::move(input.bytes), std::move(input.name), chip.sensor, options), chip_(chip) {}

  std::string_view format() const override { return version == 1 ? kName1 : kName2; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool /*last*/, std::span<Event> out) override {
    const Layout layout = chip_.layout;  // copies, for the compiler to hold in registers
    const auto right = static_cast<uint32_t>(chip_.sensor.width - 1);
    const auto bottom = static_cast<uint32_t>(chip_.sensor.height - 1);
    Clock clock = clock_;
    size_t at = 0;
    size_t count = 0;
    for (; count < out.size() && at + Words::kBytes <= bytes.size(); at += Words::kBytes) {
      const uint8_t* const record = bytes.data() + at;
      const uint32_t address = Words::address(record);
      const Record kind = aedat2::kind_of(layout, address);
      if (kind == Record::event) [[likely]] {
        // What lies beyond the left or upper edge becomes a coordinate beyond every sensor.
        const uint32_t x = right - (address >> layout.x_shift & layout.x_mask);
        const uint32_t y = bottom - (address >> layout.y_shift & layout.y_mask);
        const bool on = (address >> layout.p_shift & 1) == layout.on;
        put_event(out[count++], clock.unwrap(Words::time(record)), x & 0xFFFF, y & 0xFFFF, on ? 1 : 0);
        continue;
      }
      if (kind == Record::trigger) clock.unwrap(Words::time(record));
      ++(kind == Record::undefined ? tally_.report.unknown_words : tally_.report.skipped);
    }
    clock_ = clock;
    return {at, tally_.keep(out.first(count)), count < out.size()};
  }

 private:
  Chip chip_;
  Clock clock_;
};

template <int version>
class Aedat2Triggers {
 public:
  explicit Aedat2Triggers(const Layout& layout) : layout_(layout) {}

  struct Decoded {
    size_t bytes = 0;
    size_t triggers = 0;
  };

  Decoded decode(std::span<const uint8_t> bytes, std::span<Trigger> out) {
    using Words = Records<version>;
    Decoded decoded;
    while (decoded.triggers < out.size() && decoded.bytes + Words::kBytes <= bytes.size()) {
      const uint8_t* const record = bytes.data() + decoded.bytes;
      decoded.bytes += Words::kBytes;
      const uint32_t address = Words::address(record);
      const Record kind = aedat2::kind_of(layout_, address);
      if (kind != Record::event && kind != Record::trigger) continue;
      const int64_t t = clock_.unwrap(Words::time(record));
      if (kind == Record::trigger) out[decoded.triggers++] = aedat2::trigger_of(layout_, address, t);
    }
    return decoded;
  }

 private:
  Layout layout_;
  Clock clock_;
};

template <int version>
Result<Chip> read_header(Input& input, const ReadOptions& options) {
  return version == 1 ? aedat2::read_header_of_version_1(input.bytes, options.sensor)
                      : aedat2::read_header(input.bytes, options.sensor);
}

template <int version>
Result<std::unique_ptr<EventSource>> open_aedat2(Input input, const ReadOptions& options) {
  const auto chip = read_header<version>(input, options);
  if (!chip) return chip.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<Aedat2Reader<version>>(std::move(input), *chip, options));
}

template <int version>
Result<std::unique_ptr<TriggerSource>> open_aedat2_triggers(Input input, const ReadOptions& options) {
  const auto chip = read_header<version>(input, options);
  if (!chip) return chip.error();
  return make_decoded_triggers(std::move(input), options, Aedat2Triggers<version>(chip->layout));
}

}  // namespace

const Format kAedat1Format = {
    .name = kName1,
    .title = "AEDAT 1 of jAER (DVS128)",
    .recognise = [](const Beginning& beginning) { return starts_with(beginning.bytes, "#!AER-DAT1"); },
    .open = open_aedat2<1>,
    .open_triggers = open_aedat2_triggers<1>};

const Format kAedat2Format = {
    .name = kName2,
    .title = "AEDAT 2 of jAER and v2e (DVS128, DAVIS)",
    .recognise = [](const Beginning& beginning) { return starts_with(beginning.bytes, "#!AER-DAT2"); },
    .open = open_aedat2<2>,
    .open_triggers = open_aedat2_triggers<2>};

}  // namespace scarf
