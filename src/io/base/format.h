// A format: how it is recognised, opened and created. Each is defined beside its reader; formats.cpp lists
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/base/byte_reader.h"
#include "io/base/input_files.h"
#include "io/base/prophesee_header.h"
#include "io/files/output_files.h"
#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// A recording that is to be opened.
struct Input {
  ByteReader
      bytes;  ///< from the file's first byte on, or from behind its Prophesee header; empty for a folder
  std::string path;  ///< empty for pipes and memory: formats that seek refuse those (see require_path)
  std::string name;  ///< what messages call it
  bool folder = false;
  std::optional<PropheseeHeader> header;
  /// Where further files are opened, or named if a library opens them: those of a folder, and companions.
  std::shared_ptr<InputFiles> files = std::make_shared<InputFiles>();
};

/// What recognition sees of a recording.
struct Beginning {
  std::span<const uint8_t> bytes;
  bool ended = false;  ///< these bytes are all of the file
  bool last = false;  ///< there will be no longer look: these bytes are all of the file, or kLookAhead's most
  const std::string& path;
  bool folder = false;
};

/// Whether the bytes begin with a signature.
inline bool starts_with(std::span<const uint8_t> bytes, std::string_view signature) {
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(signature);
}

/// Options of ReadOptions that only some formats have a use for.
enum FormatOption : uint32_t {
  kTakesStream = 1,
  kTakesColumns = 2,
  kTakesTimeUnit = 4,
  kTakesFirstHigh = 8,
  kTakesYarpTime = 16,
};

struct Format {
  std::string_view name;
  std::string_view title;
  uint32_t options = 0;    ///< FormatOption
  bool prophesee = false;  ///< may stand behind a Prophesee header
  bool packed = false;     ///< may be compressed as a whole: recognise() is asked of files that otherwise are
                           ///< not read as they are
  std::string_view missing = {};  ///< not built in: the library and Debian package that it needs
  bool (*recognise)(const Beginning&) = nullptr;  ///< none: by name, or by a Prophesee header
  Result<std::unique_ptr<EventSource>> (*open)(Input, const ReadOptions&) = nullptr;
  Result<std::unique_ptr<EventSink>> (*create)(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) = nullptr;
  Result<std::unique_ptr<FrameSource>> (*open_frames)(Input, const ReadOptions&) = nullptr;
  Result<std::unique_ptr<TriggerSource>> (*open_triggers)(Input, const ReadOptions&) = nullptr;
  bool writes_header = false;    ///< what `create` makes has room for EventSink::write_header ...
  bool writes_triggers = false;  ///< ... and for write_triggers
};

/// All of them, in the order in which they are asked whether they recognise a recording.
std::span<const Format* const> all_formats();
/// Errors: illegal_parameter, naming those that exist.
Result<const Format*> find_format(std::string_view name);

/// What create_events does, under a rule that more than one output may share. Errors: the same.
Result<std::unique_ptr<EventSink>> create_recording(const std::string& path, std::string_view format,
                                                    SensorSize sensor, const OutputRule& rule);

/// Errors: bad_input, for an input that is a pipe or memory: `title` needs a file.
Result<void> require_path(const Input& input, std::string_view title);

}  // namespace scarf
