// What the readers of all formats share: the input, its refilling, and the report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/base/byte_reader.h"
#include "io/base/event_tally.h"
#include "io/base/format.h"
#include "scarf/io/recordings.h"

namespace scarf {

class BufferedSource : public EventSource {
 public:
  /// `name` is what error messages call the file.
  BufferedSource(ByteReader input, std::string name, std::optional<SensorSize> sensor,
                 const ReadOptions& options);
  /// The same, with the header of the input.
  BufferedSource(Input input, std::optional<SensorSize> sensor, const ReadOptions& options);

  std::span<const HeaderLine> header() const final { return header_; }
  std::optional<SensorSize> sensor() const final { return tally_.sensor(); }
  Result<size_t> read(std::span<Event> out) final;
  const ReadReport& report() const final { return tally_.report; }
  uint64_t bytes_read() const final { return input_.consumed(); }
  uint64_t bytes_total() const final { return input_.total(); }

 protected:
  struct Decoded {
    size_t bytes = 0;      ///< taken from the front of the input
    size_t events = 0;     ///< left at the front of the output
    bool starved = false;  ///< no whole word or line was left, and room in the output was
  };

  /// Decodes whole words or lines from the front of `bytes` until `out` is full or no whole one is left, and
  /// passes every event through tally_. `last`: nothing follows `bytes`; what is left then counts as
  /// truncated.
  virtual Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) = 0;

  EventTally tally_;

 private:
  ByteReader input_;
  std::string name_;
  std::vector<HeaderLine> header_;
};

}  // namespace scarf
