// Writer of EVT4: single events, and masks where they are shorter.
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/prophesee_header.h"
#include "io/base/writers.h"
#include "io/evt/evt4.h"
#include "io/evt/pixel_run.h"

namespace scarf {
namespace {

constexpr size_t kFewestInMask = 3;  // of 2 words

class Evt4Writer final : public CheckedSink {
 public:
  Evt4Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor,
                    {.format = "evt4",
                     .t_min = 0,
                     .t_end = evt2::kTimeEnd,
                     .max_coordinate = evt2::kCoordinateMask,
                     .trigger_inputs = evt2::kTriggerInputMask + 1,
                     .header = true}),
        sensor_(sensor) {}

 protected:
  void encode_header(std::span<const HeaderLine> lines) override {
    output_.append(prophesee_header_text("evt4", sensor_, lines));
  }

  void encode_trigger(const Trigger& trigger) override {
    put(evt4::kTrigger, set_time(trigger.t) << 22 | uint32_t{trigger.id} << 8 | trigger.value);
  }

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
  uint32_t set_time(int64_t t) {
    return clock_.set(t, [&](uint32_t high) { put(evt4::kTimeHigh, high); });
  }

  void put(evt4::Type type, uint32_t payload) { output_.append_word(uint32_t{type} << 28 | payload); }

  SensorSize sensor_;
  evt2::HeldClock clock_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt4(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Evt4Writer>(*std::move(output), sensor));
}

}  // namespace scarf
