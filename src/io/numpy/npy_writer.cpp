// Writer of a NumPy array whose items are those of Metavision's EventCD: x, y, p, t in 16 bytes.
#include <utility>

#include "core/text.h"
#include "io/base/checked_sink.h"
#include "io/base/event_tally.h"
#include "io/base/writers.h"
#include "io/numpy/numpy_header.h"

namespace scarf {
namespace {

// The whole header, whatever the number of events: so it can be written first and completed at the end.
constexpr size_t kHeaderBytes = 192;

std::string header_for(uint64_t events) {
  return numpy_header_text("[('x', '<u2'), ('y', '<u2'), ('p', '<i2'), ('', '|V2'), ('t', '<i8')]",
                           text("(", events, ",)"), kHeaderBytes);
}

class NpyWriter final : public CheckedSink {
 public:
  NpyWriter(ByteWriter output, SensorSize sensor)
      : CheckedSink(std::move(output), sensor, {"npy", -kMaxTime + 1, kMaxTime, true}) {
    output_.append(header_for(0));
  }

 protected:
  void encode(std::span<const Event> events) override {
    for (const Event& e : events) {
      output_.append_word(e.x);
      output_.append_word(e.y);
      output_.append_word(uint32_t{e.p});  // and the padding
      output_.append_word(e.t);
    }
  }

  Result<void> complete() override { return output_.overwrite(0, header_for(count())); }
};

}  // namespace

Result<std::unique_ptr<EventSink>> create_npy(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule) {
  if (path == "-") {
    return Error{
        ErrorCode::illegal_parameter,
        "npy begins with the number of events, so that it cannot go to standard output; name a file"};
  }
  return create_sink<NpyWriter>(path, sensor, rule);
}

}  // namespace scarf
