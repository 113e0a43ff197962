// Writer of DAT, version 2.
#include <utility>

#include "io/base/checked_sink.h"
#include "io/base/prophesee_header.h"
#include "io/base/writers.h"
#include "io/records/dat.h"

namespace scarf {
namespace {

// The clock has 32 bits; scarf writes no wraps of it.
constexpr int64_t kTimeEnd = int64_t{1} << 32;
constexpr int32_t kLargestCoordinate = 0x3FFF;

class DatWriter final : public CheckedSink {
 public:
  DatWriter(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor,
                    {.format = "dat",
                     .t_min = 0,
                     .t_end = kTimeEnd,
                     .max_coordinate = kLargestCoordinate,
                     .header = true}),
        sensor_(sensor) {}

 protected:
  void encode_header(std::span<const HeaderLine> lines) override {
    output_.append(prophesee_header_text("dat", sensor_, lines));
    output_.append_word(uint8_t{dat::kEventCd});
    output_.append_word(static_cast<uint8_t>(dat::kRecordBytes));
  }

  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      output_.append_word(static_cast<uint32_t>(e.t));
      output_.append_word(uint32_t{e.p} << 28 | uint32_t{e.y} << 14 | e.x);
    }
  }

 private:
  SensorSize sensor_;
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_dat(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule) {
  return create_sink<DatWriter>(path, sensor, rule);
}

}  // namespace scarf
