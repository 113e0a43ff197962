// Writer of EVT2.1 in the byte order `little`: neighbours of a row share a word.
#include <utility>

#include "io/checked_sink.h"
#include "io/evt21.h"
#include "io/pixel_run.h"
#include "io/prophesee_header.h"
#include "io/writers.h"

namespace scarf {
namespace {

class Evt21Writer final : public CheckedSink {
 public:
  Evt21Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"evt21", 0, evt2::kTimeEnd, false, evt2::kCoordinateMask}) {
    output_.append(prophesee_header_text("evt21", sensor));
  }

 protected:
  void encode(std::span<const Event> events) override {
    while (!events.empty()) {
      const Event& e = events.front();
      const auto t = static_cast<uint64_t>(e.t);
      high_.carry_to(t >> evt2::kTimeLowBits, [&](uint32_t value) { put(evt21::kTimeHigh, value, 0); });
      // Cameras' masks begin at multiples of their length.
      const auto base = static_cast<uint32_t>(e.x / evt21::kMaskLength * evt21::kMaskLength);
      const size_t run = pixel_run(events, base + evt21::kMaskLength);
      const uint32_t low = t & evt2::kTimeLowMask;
      put(e.p ? evt21::kPositive : evt21::kNegative, low << 22 | base << 11 | e.y,
          pixel_bits(events.first(run), base));
      events = events.subspan(run);
    }
  }

 private:
  void put(evt21::Type type, uint32_t payload, uint32_t mask) {
    output_.append_word(uint64_t{type} << 60 | uint64_t{payload} << 32 | mask);
  }

  HeldHigh<evt2::kTimeHighBits> high_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt21(const std::string& path, SensorSize sensor,
                                                const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Evt21Writer>(*std::move(output), sensor));
}

}  // namespace scarf
