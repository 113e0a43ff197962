// Writer of EVT2.1 in the byte order `little`: neighbours of a row share a word.
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/prophesee_header.h"
#include "io/base/writers.h"
#include "io/evt/evt21.h"
#include "io/evt/pixel_run.h"

namespace scarf {
namespace {

class Evt21Writer final : public CheckedSink {
 public:
  Evt21Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor,
                    {.format = "evt21",
                     .t_min = 0,
                     .t_end = evt2::kTimeEnd,
                     .max_coordinate = evt2::kCoordinateMask,
                     .trigger_inputs = evt2::kTriggerInputMask + 1,
                     .header = true}),
        sensor_(sensor) {}

 protected:
  void encode_header(std::span<const HeaderLine> lines) override {
    output_.append(prophesee_header_text("evt21", sensor_, lines));
  }

  void encode_trigger(const Trigger& trigger) override {
    put(evt21::kTrigger, set_time(trigger.t) << 22 | uint32_t{trigger.id} << 8 | trigger.value, 0);
  }

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
  uint32_t set_time(int64_t t) {
    return clock_.set(t, [&](uint32_t high) { put(evt21::kTimeHigh, high, 0); });
  }

  void put(evt21::Type type, uint32_t payload, uint32_t mask) {
    output_.append_word(uint64_t{type} << 60 | uint64_t{payload} << 32 | mask);
  }

  SensorSize sensor_;
  evt2::HeldClock clock_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt21(const std::string& path, SensorSize sensor,
                                                const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Evt21Writer>(*std::move(output), sensor));
}

}  // namespace scarf
