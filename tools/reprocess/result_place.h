// The place of one recording's results in the output tree, filled so that a crash at any moment leaves the
// recording either finished or plainly unfinished.
//
// Everything is written into a folder <recording>.tmp/ under its final name. When all of it has reached the
// disk it is moved to its place, and when that has reached the disk too, the record is moved last: a record
// that is there tells that everything it names is there, complete.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scarf/result.h"

namespace scarf::tools::reprocess {

inline constexpr std::string_view kRecordSuffix = ".json";
inline constexpr std::string_view kUnfinishedSuffix = ".tmp";

class ResultPlace {
 public:
  /// Makes the working folder, empty; an earlier record and what it names count no longer. The folder is
  /// locked: a second program that claims the place at the same time gets an error. Errors: io.
  static Result<ResultPlace> claim(const std::string& out, const std::string& relative);
  /// Removes the working folder and what is in it.
  ~ResultPlace();
  ResultPlace(ResultPlace&& other) noexcept;
  ResultPlace& operator=(ResultPlace&&) = delete;

  /// Where an output is to be written. `suffix` is added to the name of the recording.
  std::string working(const std::string& suffix) const;
  /// Moves the outputs into place, and the record last. Errors: io; then the recording is unfinished.
  Result<void> complete(const std::vector<std::string>& suffixes, const std::string& record);

 private:
  ResultPlace(std::string place, std::string folder, int lock)
      : place_(std::move(place)), folder_(std::move(folder)), lock_(lock) {}

  std::string place_;   // <out>/<relative>
  std::string folder_;  // the working folder
  int lock_;            // file descriptor of the folder; -1: moved from
};

/// Whether a relative path can be mirrored: no part of it may look unfinished.
bool looks_unfinished(const std::string& relative);

/// Removes what a run that was killed has left of a recording, unless another run works on it.
void remove_stale(const std::string& out, const std::string& relative);

}  // namespace scarf::tools::reprocess
