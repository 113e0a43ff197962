// Writer of EVT4: single events, and masks where they are shorter.
#include <utility>

#include "io/checked_sink.h"
#include "io/evt4.h"
#include "io/pixel_run.h"
#include "io/prophesee_header.h"
#include "io/writers.h"

namespace scarf {
namespace {

constexpr size_t kFewestInMask = 3;  // of 2 words

class Evt4Writer final : public CheckedSink {
 public:
  Evt4Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"evt4", 0, evt2::kTimeEnd, false, evt2::kCoordinateMask}) {
    output_.append(prophesee_header_text("evt4", sensor));
  }

 protected:
  void encode(std::span<const Event> events) override {
    while (!events.empty()) {
      const Event& e = events.front();
      const auto t = static_cast<uint64_t>(e.t);
      high_.carry_to(t >> evt2::kTimeLowBits, [&](uint32_t value) { put(evt4::kTimeHigh, value); });
      const auto low = static_cast<uint32_t>(t & evt2::kTimeLowMask);
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
  void put(evt4::Type type, uint32_t payload) { output_.append_word(uint32_t{type} << 28 | payload); }

  HeldHigh<evt2::kTimeHighBits> high_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt4(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Evt4Writer>(*std::move(output), sensor));
}

}  // namespace scarf
