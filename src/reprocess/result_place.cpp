#include "reprocess/result_place.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/text.h"
#include "io/files/new_file.h"
#include "io/files/output_files.h"

namespace scarf::reprocess {
namespace {

namespace fs = std::filesystem;

Error failed(const std::string& what, const std::string& path, const std::string& why) {
  return {ErrorCode::io, text("cannot ", what, " ", path, ": ", why)};
}

// The path without a slash at its end, as parent_path() needs it.
std::string without_slash(std::string path) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

// Locks a folder; nullopt if another program holds it, or removed it meanwhile.
std::optional<int> lock_folder(const std::string& folder) {
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  struct stat mine {};
  struct stat there {};
  // File systems without locks (ENOLCK, ENOTSUP) are used as they are.
  const bool held = flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  const bool same = fstat(fd, &mine) == 0 && stat(folder.c_str(), &there) == 0 && mine.st_ino == there.st_ino;
  if (!held && same) return fd;
  close(fd);
  return std::nullopt;
}

// In a working folder: it was made by scarf.
constexpr std::string_view kMark = ".scarf-working";

bool is_marked(const std::string& folder) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(fs::path(folder) / kMark, ignored));
}

// What scarf has made in a working folder that is marked and locked; what others have put there stays.
Result<void> clear(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> scratch;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_temporary_name(entry->path().filename().string())) scratch.push_back(entry->path().string());
  }
  if (error) return failed("list", folder, error.message());
  for (const std::string& path : scratch) {
    if (auto r = remove_scratch(path); !r) return r;
  }
  return {};
}

void remove_working(const std::string& place, const std::string& folder) {
  std::error_code ignored;
  size_t entries = 0;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    ++entries;
  }
  if (ignored || entries > 1) return;  // the mark stays with what others have put there
  // It goes away with its mark at once, so that nobody finds it without.
  const auto bin = ScratchFolder::create(place);
  if (bin) (void)rename_over(folder, bin->path()).ok();
}

// The folder appears with its mark, so that it is never there without.
Result<void> make_working(const std::string& place, const std::string& folder) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(folder, ignored))) return {};
  auto made = ScratchFolder::create(place);
  if (!made) return made.error();
  if (auto r = write_new_file(made->file(kMark), ""); !r) return r;
  const auto named = made->become(folder);
  // Another run may have been faster; the lock will tell.
  return named || is_marked(folder) ? Result<void>() : named;
}

std::string place_of(const std::string& out, const std::string& relative) {
  return (fs::path(out) / relative).string();
}

// The names of all that is written of a recording; the record comes last.
std::vector<std::string> results_of(const std::string& name, const std::vector<std::string>& suffixes) {
  std::vector<std::string> names;
  for (const std::string& suffix : suffixes) names.push_back(without_slash(name + suffix));
  names.push_back(text(name, kRecordSuffix));
  return names;
}

}  // namespace

Result<void> check_place(const std::string& out, const std::string& relative,
                         const std::vector<std::string>& suffixes, bool replace, const OutputRule& rule) {
  const fs::path place = place_of(out, relative);
  const std::string folder = place.parent_path().string();
  const std::string name = place.filename().string();
  const auto owned = OwnedFiles::read(folder, list_name_of(name));
  if (!owned) return owned.error();
  const std::string working = place.string() + std::string(kUnfinishedSuffix);
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(working, ignored)) && !is_marked(working)) {
    return Error{ErrorCode::illegal_parameter,
                 text(working, " was not written by scarf; move it away, or give another output")};
  }
  return owned->check(results_of(name, suffixes), replace, rule);
}

Result<ResultPlace> ResultPlace::claim(const std::string& out, const std::string& relative,
                                       const std::vector<std::string>& suffixes, bool replace,
                                       const OutputRule& rule) {
  ResultPlace claimed;
  claimed.place_ = place_of(out, relative);
  claimed.suffixes_ = suffixes;
  claimed.replace_ = replace;
  claimed.rule_ = rule;
  const std::string folder = text(claimed.place_, kUnfinishedSuffix);
  const std::string parent = fs::path(claimed.place_).parent_path().string();
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) return failed("make the folder", parent, error.message());
  if (auto r = check_place(out, relative, suffixes, replace, rule); !r) return r.error();
  if (auto r = make_working(claimed.place_, folder); !r) return r.error();
  const auto lock = lock_folder(folder);
  if (!lock || !is_marked(folder)) {
    if (lock) close(*lock);
    return Error{ErrorCode::io,
                 text("another run works on ", claimed.place_, "; wait for it, or use another output")};
  }
  claimed.folder_ = folder;
  claimed.lock_ = *lock;
  const auto there = [] { return true; };
  claimed.mark_name_.note((fs::path(folder) / kMark).string(), TemporaryName::Kind::file, there);
  claimed.folder_name_.note(folder, TemporaryName::Kind::empty_folder, there);
  if (auto r = clear(folder); !r) return r.error();
  auto working = ScratchFolder::create((fs::path(folder) / "results").string());
  if (!working) return working.error();
  claimed.working_.push_back(*std::move(working));
  return claimed;
}

ResultPlace::ResultPlace(ResultPlace&& other) noexcept
    : place_(std::move(other.place_)),
      suffixes_(std::move(other.suffixes_)),
      replace_(other.replace_),
      rule_(other.rule_),
      folder_(std::move(other.folder_)),
      working_(std::move(other.working_)),
      folder_name_(std::move(other.folder_name_)),
      mark_name_(std::move(other.mark_name_)),
      lock_(std::exchange(other.lock_, -1)) {}

ResultPlace::~ResultPlace() {
  if (lock_ < 0) return;
  working_.clear();
  remove_working(place_, folder_);
  close(lock_);
}

std::string ResultPlace::working(const std::string& suffix) const {
  return working_.front().file(text(fs::path(place_).filename().string(), suffix));
}

Result<void> ResultPlace::complete(const std::string& record) {
  if (auto r = write_new_file(working(std::string(kRecordSuffix)), record); !r) return r;
  const fs::path place = place_;
  const std::string name = place.filename().string();
  const auto moved = OwnedFiles::replace(place.parent_path().string(), list_name_of(name), working_.front(),
                                         results_of(name, suffixes_), replace_, rule_);
  return moved ? moved : Result<void>(Error{ErrorCode::io, moved.error().message});
}

bool looks_unfinished(const std::string& relative) {
  for (const fs::path& part : fs::path(relative)) {
    if (part.string().ends_with(kUnfinishedSuffix)) return true;
  }
  return false;
}

void remove_stale(const std::string& out, const std::string& relative) {
  const std::string folder = text(place_of(out, relative), kUnfinishedSuffix);
  const auto lock = lock_folder(folder);
  if (!lock) return;
  // Whoever claims the place meets what could not be removed, and tells.
  if (is_marked(folder) && clear(folder).ok()) remove_working(place_of(out, relative), folder);
  close(*lock);
}

}  // namespace scarf::reprocess
