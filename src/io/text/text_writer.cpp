// Writer of text lines `t x y p` behind a first line `width height`.
#include <charconv>
#include <utility>

#include "core/text.h"
#include "io/base/checked_sink.h"
#include "io/base/decimal.h"
#include "io/base/writers.h"

namespace scarf {
namespace {

class TextWriter final : public CheckedSink {
 public:
  TextWriter(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"text", -kMaxTextTime + 1, kMaxTextTime, true}) {
    output_.append(text(sensor.width, " ", sensor.height, "\n"));
  }

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      char line[64];
      char* at = line;
      if (e.t < 0) *at++ = '-';
      const int64_t t = e.t < 0 ? -e.t : e.t;
      at = put(at, t / 1'000'000);
      *at++ = '.';
      for (int64_t digit = 100'000; digit > 0; digit /= 10) *at++ = static_cast<char>('0' + t / digit % 10);
      *at++ = ' ';
      at = put(at, e.x);
      *at++ = ' ';
      at = put(at, e.y);
      *at++ = ' ';
      *at++ = static_cast<char>('0' + e.p);
      *at++ = '\n';
      output_.append({line, at});
    }
  }

 private:
  static char* put(char* at, int64_t value) { return std::to_chars(at, at + 20, value).ptr; }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_text(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  return create_sink<TextWriter>(path, sensor, rule);
}

}  // namespace scarf
