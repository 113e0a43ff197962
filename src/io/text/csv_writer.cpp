// Writer of CSV lines `x,y,p,t` behind a first line `%geometry:width,height`, as OpenEB writes and reads
// them.
#include <charconv>
#include <utility>

#include "core/text.h"
#include "io/base/checked_sink.h"
#include "io/base/decimal.h"
#include "io/base/writers.h"

namespace scarf {
namespace {

class CsvWriter final : public CheckedSink {
 public:
  CsvWriter(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"csv", -kMaxTextTime + 1, kMaxTextTime, true}) {
    output_.append(text("%geometry:", sensor.width, ",", sensor.height, "\n"));
  }

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      char line[64];
      char* at = line;
      for (const int64_t value : {int64_t{e.x}, int64_t{e.y}, int64_t{e.p}, e.t}) {
        at = std::to_chars(at, at + 20, value).ptr;
        *at++ = ',';
      }
      at[-1] = '\n';
      output_.append({line, at});
    }
  }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_csv(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule) {
  return create_sink<CsvWriter>(path, sensor, rule);
}

}  // namespace scarf
