// Pictures as files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/output_files.h"
#include "output/picture.h"
#include "scarf/core/result.h"

namespace scarf {

/// Writes an image file of the kind that the name's extension says. Errors: as OutputFile::create; io.
Result<void> write_picture(const std::string& path, const PictureView& picture, const OutputRule& rule);

/// "NAME_000012.png": sorted by name is sorted by index.
std::string numbered_picture(std::string_view name, uint64_t index);

/// The list of the pictures in a folder.
inline constexpr std::string_view kPictureList = "frames.csv";

/// A folder of numbered pictures and a list of them, which appear together when they are complete. What else
/// is in the folder stays.
class PictureFolder {
 public:
  /// Whether pictures with these names may go into a folder: it may hold files of others, but no numbered
  /// picture of one of the names and no list of pictures, unless an earlier run has written it, nobody has
  /// changed it, and the rule allows to overwrite. Errors: illegal_parameter, naming the file that is in the
  /// way.
  static Result<void> check(const std::string& path, const std::vector<std::string_view>& names,
                            const OutputRule& rule);
  /// Errors: as check; io.
  static Result<PictureFolder> create(const std::string& path, const std::vector<std::string_view>& names,
                                      const OutputRule& rule);

  /// Each name and index once. Errors: io.
  Result<void> write(std::string_view name, uint64_t index, const PictureView& picture);
  /// Puts everything in place, with `list` as kPictureList. Pictures of an earlier run go away. Errors: as
  /// check; io.
  Result<void> finish(std::string_view list);

 private:
  PictureFolder(std::string path, std::vector<std::string_view> names, const OutputRule& rule,
                MadeFolder parents, ScratchFolder scratch);

  std::string path_;
  std::vector<std::string_view> names_;
  OutputRule rule_;
  MadeFolder parents_;
  ScratchFolder scratch_;
  std::vector<std::string> files_;
};

}  // namespace scarf
