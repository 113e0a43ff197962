// Writer of EVT2: one TIME_HIGH word per change of the time's upper bits.
#include <utility>

#include "io/checked_sink.h"
#include "io/evt2.h"
#include "io/prophesee_header.h"
#include "io/writers.h"

namespace scarf {
namespace {

class Evt2Writer final : public CheckedSink {
 public:
  Evt2Writer(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"evt2", 0, evt2::kTimeEnd, false, evt2::kCoordinateMask}) {
    output_.append(prophesee_header_text("evt2", sensor));
  }

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      const auto t = static_cast<uint64_t>(e.t);
      high_.carry_to(t >> evt2::kTimeLowBits, [&](uint32_t value) { put(evt2::kTimeHigh, value); });
      const uint32_t low = t & evt2::kTimeLowMask;
      put(e.p ? evt2::kOn : evt2::kOff, low << 22 | uint32_t{e.x} << 11 | e.y);
    }
  }

 private:
  void put(evt2::Type type, uint32_t payload) { output_.append_word(uint32_t{type} << 28 | payload); }

  HeldHigh<evt2::kTimeHighBits> high_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_evt2(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Evt2Writer>(*std::move(output), sensor));
}

}  // namespace scarf
