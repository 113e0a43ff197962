// The files of a recording of the Event-Camera Dataset, in a folder or in a zip archive.
// Source: Mueggler et al., "The Event-Camera Dataset and Simulator", 2017; E2VID's zip with one text file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_reader.h"
#include "io/base/format.h"
#include "io/base/zip_archive.h"
#include "scarf/core/result.h"

namespace scarf {

class EcdFiles {
 public:
  /// Errors: unrecognised, for an archive without events.txt or one text file; bad_input.
  static Result<EcdFiles> find(const Input& input);

  /// The lines of the events. Errors: io, bad_input.
  Result<ByteReader> events() const { return open(events_); }
  /// Whether they are events by their name; else they are the only text of an archive.
  bool named_events() const;

  /// Whether there is a list of images.
  bool has_images() const;
  /// Its lines: time and name. Errors: io, bad_input.
  Result<ByteReader> images() const { return open(kImages); }
  /// A file by its name in the list of images. Errors: io, bad_input.
  Result<ByteReader> open(std::string_view name) const;

 private:
  static constexpr std::string_view kImages = "images.txt";

  const ZipArchive::Member* member(std::string_view name) const;

  std::shared_ptr<InputFiles> watched_;
  std::string folder_;  // where they lie; of an archive: the beginning of its names
  std::optional<ZipArchive> archive_;
  std::string events_;
};

/// Whether a folder holds such a recording.
bool is_ecd_folder(const std::string& path);

}  // namespace scarf
