// Writer of EVT2: one TIME_HIGH word per change of the time's upper bits.
#include <utility>

#include "io/base/writers.h"
#include "io/evt/evt2.h"
#include "io/evt/evt2_fields_writer.h"

namespace scarf {
namespace {

class Evt2Writer final : public Evt2FieldsWriter {
 public:
  Evt2Writer(ByteWriter output, SensorSize sensor) : Evt2FieldsWriter("evt2", std::move(output), sensor) {}

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      const uint32_t low = set_time(e.t);
      put(e.p ? evt2::kOn : evt2::kOff, low << 22 | uint32_t{e.x} << 11 | e.y);
    }
  }

 private:
  void put_time_high(uint32_t high) override { put(evt2::kTimeHigh, high); }
  void put_trigger(uint32_t fields) override { put(evt2::kTrigger, fields); }

  void put(evt2::Type type, uint32_t payload) { output_.append_word(uint32_t{type} << 28 | payload); }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt2(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  return create_sink<Evt2Writer>(path, sensor, rule);
}

}  // namespace scarf
