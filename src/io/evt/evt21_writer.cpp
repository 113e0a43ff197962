// Writer of EVT2.1 in the byte order `little`: neighbours of a row share a word.
#include <utility>

#include "io/base/writers.h"
#include "io/evt/evt21.h"
#include "io/evt/evt2_fields_writer.h"
#include "io/evt/pixel_run.h"

namespace scarf {
namespace {

class Evt21Writer final : public Evt2FieldsWriter {
 public:
  Evt21Writer(ByteWriter output, SensorSize sensor) : Evt2FieldsWriter("evt21", std::move(output), sensor) {}

 protected:
  void encode(std::span<const Event> events) override {
    while (!events.empty()) {
      const Event& e = events.front();
      const uint32_t low = set_time(e.t);
      // Cameras' masks begin at multiples of their length.
      const auto base = static_cast<uint32_t>(e.x / evt21::kMaskLength * evt21::kMaskLength);
      const size_t run = pixel_run(events, base + evt21::kMaskLength);
      put(e.p ? evt21::kPositive : evt21::kNegative, low << 22 | base << 11 | e.y,
          pixel_bits(events.first(run), base));
      events = events.subspan(run);
    }
  }

 private:
  void put_time_high(uint32_t high) override { put(evt21::kTimeHigh, high, 0); }
  void put_trigger(uint32_t fields) override { put(evt21::kTrigger, fields, 0); }

  void put(evt21::Type type, uint32_t payload, uint32_t mask) {
    output_.append_word(uint64_t{type} << 60 | uint64_t{payload} << 32 | mask);
  }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt21(const std::string& path, SensorSize sensor,
                                                const OutputRule& rule) {
  return create_sink<Evt21Writer>(path, sensor, rule);
}

}  // namespace scarf
