// Writer of EVT2: one TIME_HIGH word per change of the time's upper bits.
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/prophesee_header.h"
#include "io/base/writers.h"
#include "io/evt/evt2.h"

namespace scarf {
namespace {

class Evt2Writer final : public CheckedSink {
 public:
  Evt2Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor,
                    {.format = "evt2",
                     .t_min = 0,
                     .t_end = evt2::kTimeEnd,
                     .max_coordinate = evt2::kCoordinateMask,
                     .trigger_inputs = evt2::kTriggerInputMask + 1,
                     .header = true}),
        sensor_(sensor) {}

 protected:
  void encode_header(std::span<const HeaderLine> lines) override {
    output_.append(prophesee_header_text("evt2", sensor_, lines));
  }

  void encode_trigger(const Trigger& trigger) override {
    put(evt2::kTrigger, set_time(trigger.t) << 22 | uint32_t{trigger.id} << 8 | trigger.value);
  }

  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      const uint32_t low = set_time(e.t);
      put(e.p ? evt2::kOn : evt2::kOff, low << 22 | uint32_t{e.x} << 11 | e.y);
    }
  }

 private:
  uint32_t set_time(int64_t t) {
    return clock_.set(t, [&](uint32_t high) { put(evt2::kTimeHigh, high); });
  }

  void put(evt2::Type type, uint32_t payload) { output_.append_word(uint32_t{type} << 28 | payload); }

  SensorSize sensor_;
  evt2::HeldClock clock_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt2(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Evt2Writer>(*std::move(output), sensor));
}

}  // namespace scarf
