// The files of scarf in a folder that may hold files of others: named by a hidden list, which is written
// before they come and while they are replaced, so that a crash at any moment leaves nothing that is not
// known to be ours.
//
// The list is JSON: {"schema": 1, "files": [{"name": "frame_000000.png", "bytes": 812}, {"name":
// "a.frames"}]}. An entry without bytes is a folder that has a list of its own. A file is ours if it has that
// size, and the modification time of the list, which all of them get when they are complete. So the list does
// not depend on the clock, and a file that was changed since belongs to who changed it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/output_files.h"
#include "scarf/core/result.h"

namespace scarf {

/// The name of every list ends in this; that of a folder that is one output is this alone.
inline constexpr std::string_view kListName = ".scarf-files";

/// ".NAME.scarf-files": the list of the results called NAME.
std::string list_name_of(std::string_view name);
/// Whether a file's name is that of a list.
bool is_list_name(std::string_view name);

class OwnedFiles {
 public:
  /// What the list of that name says; without one, nothing is ours. A file of that name that is no list of
  /// ours is an error: illegal_parameter. Errors: io.
  static Result<OwnedFiles> read(const std::string& folder,
                                 const std::string& list_name = std::string(kListName));

  bool empty() const { return files_.empty(); }
  bool names(const std::string& file) const { return files_.contains(file); }
  /// Whether a file, or a folder with all that is in it, is there, is named, and is as scarf left it.
  bool owns(const std::string& file) const;
  /// Whether scarf may put these files into the folder, in place of its own, which go away if `replace` says
  /// so. Nothing there may be an input. Errors: illegal_parameter, naming the file that is in the way; io.
  Result<void> check(const std::vector<std::string>& files, bool replace, const OutputRule& rule) const;

  /// Moves files out of a scratch folder into the folder, whose earlier ones, if they are still ours, go
  /// away. The last one is put in place last, when the others are on the disk, and is the first to go: while
  /// it is there the others are, complete. Errors: as check; io.
  static Result<void> replace(const std::string& folder, const std::string& list_name, ScratchFolder& scratch,
                              const std::vector<std::string>& files, bool replace, const OutputRule& rule);
  /// Writes the list of these files into their scratch folder and gives all of them its time.
  static Result<void> list(const ScratchFolder& scratch, const std::vector<std::string>& files,
                           const std::string& list_name = std::string(kListName));

 private:
  struct File {
    std::optional<uint64_t> bytes;  // none: a folder
    int64_t written = 0;            // nanoseconds since 1970
  };

  explicit OwnedFiles(std::string folder) : folder_(std::move(folder)) {}
  Result<void> read_list(const std::string& name);
  std::string path_of(const std::string& file) const;
  Result<void> remove(const std::string& file) const;

  std::string folder_;
  std::multimap<std::string, File> files_;  // of two lists, while results are replaced
};

}  // namespace scarf
