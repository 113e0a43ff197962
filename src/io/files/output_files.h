// The one place where files are made, replaced and removed: nothing that is read is ever written to, and
// nothing that scarf did not make is replaced or removed, unless its owner said so.
//
// An output is written under a name of its own beside its place and takes its place when it is complete and
// on the disk. A path that leads to a device or a pipe is written directly, and "-" is standard output.
#pragma once

#include <sys/stat.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/temporaries.h"
#include "scarf/core/result.h"

namespace scarf {

/// What a command reads, and whether it may replace files that are there. Copies are the same rule; any
/// thread may use it.
class OutputRule {
 public:
  explicit OutputRule(bool overwrite = false, std::span<const std::string> inputs = {});

  /// Whether the user said that files may be replaced.
  bool overwrite() const;
  /// A file or folder, with all that is in it; "-" is standard input. Whatever name leads to one of these
  /// files, it is never written to. What is not there is no input.
  /// `except`: a folder within it for outputs, which is none; what is there is left to whose it is.
  void add_input(const std::string& path, const std::string& except = {});
  /// The input that a file or folder is, or is part of, whatever its name.
  std::optional<std::string> input_of(const struct stat& file) const;

  /// Whether a file may be written to `path`. Errors: illegal_parameter: an input, a file that is there
  /// without overwrite(), a symbolic link, a folder, no name at all; io: its folder is not there.
  Result<void> check(const std::string& path) const;
  /// The same for all files of a command; no two may be the same one.
  Result<void> check(std::span<const std::string> paths) const;

 private:
  friend class OutputFile;
  struct State;
  std::shared_ptr<State> state_;
};

/// A file that is being written. Destroyed before it is published, it leaves nothing.
class OutputFile {
 public:
  /// Makes the file under a temporary name, exclusively. Errors: as OutputRule::check, also where the same
  /// command has written to `path` before; io.
  static Result<OutputFile> create(const std::string& path, const OutputRule& rule);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;

  /// The final name, for messages.
  const std::string& path() const { return path_; }
  /// For libraries that open by name: the file, which is there and empty. It has the extension of the final
  /// name.
  const std::string& name() const { return name_; }
  int descriptor() const { return descriptor_; }

  /// Puts a file of the same folder, or of one within it, in the place of what was written so far. Errors:
  /// io.
  Result<void> take(const std::string& file);
  /// Writes all to the disk, and puts the file in its place unless something else came there meanwhile that
  /// may not be replaced. A file that is replaced leaves its permissions. To be called once. Errors: io.
  Result<void> publish();

 private:
  OutputFile(std::string path, const OutputRule& rule) : path_(std::move(path)), rule_(rule) {}

  std::string path_;
  std::string name_;
  OutputRule rule_;
  int descriptor_ = -1;
  bool direct_ = false;
  TemporaryName temporary_;
};

/// A folder that only this process uses, beside what it will become. It goes away with all that is in it.
class ScratchFolder {
 public:
  /// Beside `path`, in a folder that is there. Errors: io.
  static Result<ScratchFolder> create(const std::string& path);
  ~ScratchFolder() { remove(); }
  ScratchFolder(ScratchFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), temporary_(std::move(other.temporary_)) {}
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  const std::string& path() const { return path_; }
  std::string file(std::string_view name) const;
  /// Renames the folder. Errors: io, also where something has that name.
  Result<void> become(const std::string& path);

 private:
  explicit ScratchFolder(std::string path) : path_(std::move(path)) {}
  void remove();

  std::string path_;
  TemporaryName temporary_;
};

/// A folder that is made for an output, with those above it; what is still empty in the end goes away.
class MadeFolder {
 public:
  /// Errors: io.
  static Result<MadeFolder> create(const std::string& path);
  ~MadeFolder();
  MadeFolder(MadeFolder&& other) noexcept : made_(std::exchange(other.made_, {})) {}
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  MadeFolder& operator=(MadeFolder&&) = delete;

 private:
  MadeFolder() = default;

  std::vector<std::pair<std::string, TemporaryName>> made_;  // outer ones first
};

/// Whether a name is one that OutputFile or ScratchFolder gives to what is unfinished.
bool is_temporary_name(std::string_view name);

/// Removes a scratch folder that a killed process has left, which nobody uses any more. Errors: io.
Result<void> remove_scratch(const std::string& path);

/// How a file or folder is given a name that must be free. The kernel's way is not there on every file
/// system.
enum class Naming { by_kernel, by_link, by_placeholder };
/// Errors: io, also where something has that name, which stays.
Result<void> rename_to_free_name(const std::string& from, const std::string& to,
                                 Naming naming = Naming::by_kernel);
/// Replaces what is there, which is known to be scarf's own. Errors: io.
Result<void> rename_over(const std::string& from, const std::string& to);
/// Errors: io; nothing there is none.
Result<void> remove_file(const std::string& path);
Result<void> remove_empty_folder(const std::string& path);

/// Wait until the names in a folder, or all below it, are on the disk. Errors: io.
Result<void> sync_folder(const std::string& folder);
Result<void> sync_tree(const std::string& folder);

}  // namespace scarf
