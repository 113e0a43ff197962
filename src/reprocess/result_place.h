// The place of one recording's results in the output tree, filled so that a crash at any moment leaves the
// recording either finished or plainly unfinished.
//
// Everything is written into a folder of its own within <recording>.tmp/. When all of it has reached the disk
// it is moved to its place, and when that has reached the disk too, the record is moved last: a record that
// is there tells that everything it names is there, complete. A hidden list (owned_files.h) says which
// results are ours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "output/owned_files.h"
#include "scarf/core/result.h"

namespace scarf::reprocess {

inline constexpr std::string_view kRecordSuffix = ".json";
inline constexpr std::string_view kUnfinishedSuffix = ".tmp";

/// Whether results may go to their place. `suffixes` are added to the name of the recording; the record is
/// one more. Results of an earlier run may be there if `replace` says so and nobody has changed them; nothing
/// else may. Errors: illegal_parameter, naming what is in the way; io.
Result<void> check_place(const std::string& out, const std::string& relative,
                         const std::vector<std::string>& suffixes, bool replace, const OutputRule& rule);

class ResultPlace {
 public:
  /// Makes the working folder. It is locked: a second program that claims the place at the same time gets an
  /// error. Errors: as check_place; io.
  static Result<ResultPlace> claim(const std::string& out, const std::string& relative,
                                   const std::vector<std::string>& suffixes, bool replace,
                                   const OutputRule& rule);
  /// Removes the working folder and what is in it.
  ~ResultPlace();
  ResultPlace(ResultPlace&& other) noexcept;
  ResultPlace& operator=(ResultPlace&&) = delete;

  /// Where an output is to be written. `suffix` is added to the name of the recording.
  std::string working(const std::string& suffix) const;
  /// Moves the outputs into place, and the record last. Errors: as check_place; io; then the recording is
  /// unfinished.
  Result<void> complete(const std::string& record);

 private:
  ResultPlace() = default;

  std::string place_;                  // <out>/<relative>
  std::vector<std::string> suffixes_;  // without slashes
  bool replace_ = false;
  OutputRule rule_;
  std::string folder_;                  // <place>.tmp
  std::vector<ScratchFolder> working_;  // one within the folder, or none: moved from
  TemporaryName folder_name_;
  TemporaryName mark_name_;
  int lock_ = -1;  // file descriptor of the folder; -1: moved from
};

/// Whether a relative path can be mirrored: no part of it may look unfinished.
bool looks_unfinished(const std::string& relative);

/// Removes what a run that was killed has left of a recording, unless another run works on it.
void remove_stale(const std::string& out, const std::string& relative);

}  // namespace scarf::reprocess
