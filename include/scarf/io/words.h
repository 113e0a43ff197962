// The words of a recording as they are in the file, for a decoder elsewhere (scarf/device/decoder.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scarf/io/recordings.h"

namespace scarf {

/// The bytes behind the header of a Prophesee RAW recording.
class WordSource {
 public:
  virtual ~WordSource() = default;
  /// As EventSource says: "evt2" or "evt3".
  virtual std::string_view format() const = 0;
  virtual std::optional<SensorSize> sensor() const = 0;
  /// Reads up to out.size() bytes (at least 1); 0 means the end. Words may be cut. Errors: io; bad_input
  /// instead of the end, if the file has changed since it was opened.
  virtual Result<size_t> read(std::span<uint8_t> out) = 0;
  /// For who stops before the end: that error, if it is due now.
  virtual Result<void> unchanged() const { return {}; }
};

/// Opens a recording as open_events does, which says what it is. Errors: as open_events; bad_input for a
/// recording of anything but EVT2 or EVT3 words; illegal_parameter for "-", since the recording is opened
/// twice.
Result<std::unique_ptr<WordSource>> open_words(const std::string& path, const ReadOptions& options = {});

}  // namespace scarf
