// Writer of EVT4: single events, and masks where they are shorter.
#include <utility>

#include "io/base/writers.h"
#include "io/evt/evt2_fields_writer.h"
#include "io/evt/evt4.h"
#include "io/evt/pixel_run.h"

namespace scarf {
namespace {

constexpr size_t kFewestInMask = 3;  // of 2 words

class Evt4Writer final : public Evt2FieldsWriter {
 public:
  Evt4Writer(ByteWriter output, SensorSize sensor) : Evt2FieldsWriter("evt4", std::move(output), sensor) {}

 protected:
  void encode(std::span<const Event> events) override {
    while (!events.empty()) {
      const Event& e = events.front();
      const uint32_t low = set_time(e.t);
      const uint32_t fields = low << 22 | uint32_t{e.x} << 11 | e.y;
      const size_t run = pixel_run(events, e.x + uint32_t{evt4::kMaskLength});
      if (run >= kFewestInMask) {
        put(e.p ? evt4::kVectorOn : evt4::kVectorOff, fields);
        output_.append_word(pixel_bits(events.first(run), e.x));
        events = events.subspan(run);
      } else {
        put(e.p ? evt4::kOn : evt4::kOff, fields);
        events = events.subspan(1);
      }
    }
  }

 private:
  void put_time_high(uint32_t high) override { put(evt4::kTimeHigh, high); }
  void put_trigger(uint32_t fields) override { put(evt4::kTrigger, fields); }

  void put(evt4::Type type, uint32_t payload) { output_.append_word(uint32_t{type} << 28 | payload); }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt4(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  return create_sink<Evt4Writer>(path, sensor, rule);
}

}  // namespace scarf
