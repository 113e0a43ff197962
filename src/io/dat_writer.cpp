// Writer of DAT, version 2.
#include <utility>

#include "core/text.h"
#include "io/checked_sink.h"
#include "io/dat.h"
#include "io/writers.h"

namespace scarf {
namespace {

// The clock has 32 bits; scarf writes no wraps of it.
constexpr int64_t kTimeEnd = int64_t{1} << 32;
constexpr int32_t kLargestCoordinate = 0x3FFF;

class DatWriter final : public CheckedSink {
 public:
  DatWriter(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"dat", 0, kTimeEnd, false, kLargestCoordinate}) {
    output_.append(text("% Data file containing CD events.\n% Version 2\n% Height ", sensor.height,
                        "\n% Width ", sensor.width, "\n% end\n"));
    output_.append_word(uint8_t{dat::kEventCd});
    output_.append_word(static_cast<uint8_t>(dat::kRecordBytes));
  }

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      output_.append_word(static_cast<uint32_t>(e.t));
      output_.append_word(uint32_t{e.p} << 28 | uint32_t{e.y} << 14 | e.x);
    }
  }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_dat(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<DatWriter>(*std::move(output), sensor));
}

}  // namespace scarf
