// Writer of Event Stream 2 (.es), DVS.
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/writers.h"
#include "io/records/event_stream.h"

namespace scarf {
namespace {

using namespace event_stream;

// Every 127 us without an event cost a byte: later times, Unix times above all, would fill the disk.
constexpr int64_t kTimeEnd = int64_t{1} << 34;

class EventStreamWriter final : public CheckedSink {
 public:
  EventStreamWriter(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"es", 0, kTimeEnd, false}), height_(sensor.height) {
    output_.append(kMagic);
    for (const uint8_t byte : {kMajorVersion, uint8_t{0}, uint8_t{0}, uint8_t{kDvs}}) {
      output_.append_word(byte);
    }
    output_.append_word(static_cast<uint16_t>(sensor.width));
    output_.append_word(static_cast<uint16_t>(sensor.height));
  }

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      for (; e.t - t_ >= kDvsOverflowTime; t_ += kDvsOverflowTime) output_.append_word(kDvsOverflow);
      output_.append_word(static_cast<uint8_t>((e.t - t_) << 1 | e.p));
      t_ = e.t;
      output_.append_word(e.x);
      output_.append_word(static_cast<uint16_t>(height_ - 1 - e.y));
    }
  }

 private:
  int32_t height_;
  int64_t t_ = 0;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_event_stream(const std::string& path, SensorSize sensor,
                                                       const OutputRule& rule) {
  return create_sink<EventStreamWriter>(path, sensor, rule);
}

}  // namespace scarf
