#include "tools/reprocess/result_place.h"

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
#include "tools/files.h"

namespace scarf::tools::reprocess {
namespace {

namespace fs = std::filesystem;

Error failed(const std::string& what, const std::string& path, const std::string& why) {
  return {ErrorCode::io, text("cannot ", what, " ", path, ": ", why)};
}

Error failed(const std::string& what, const std::string& path) {
  return failed(what, path, std::generic_category().message(errno));
}

// The path without a slash at its end, as parent_path() needs it.
std::string without_slash(std::string path) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

// Waits until a file's content, or a folder's entries, are on the disk.
Result<void> synchronise(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return failed("open", path);
  const bool done = fsync(fd) == 0 || errno == EINVAL;  // EINVAL: a file system without a disk
  const int why = errno;
  close(fd);
  errno = why;
  return done ? Result<void>() : failed("write", path);
}

Result<void> synchronise_tree(const std::string& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (auto r = synchronise(entry->path().string()); !r) return r;
  }
  if (error) return failed("list", folder, error.message());
  return synchronise(folder);
}

Result<void> remove_tree(const std::string& path) {
  std::error_code error;
  fs::remove_all(path, error);
  return error ? failed("remove", path, error.message()) : Result<void>();
}

Result<void> move_over(const std::string& from, const std::string& to) {
  if (auto r = remove_tree(to); !r) return r;  // a folder does not take the place of one with content
  std::error_code error;
  fs::rename(from, to, error);
  return error ? failed("write", to, error.message()) : Result<void>();
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

Result<void> empty_folder(const std::string& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (auto r = remove_tree(entry.path().string()); !r) return r;
  }
  return error ? failed("list", folder, error.message()) : Result<void>();
}

std::string place_of(const std::string& out, const std::string& relative) {
  return (fs::path(out) / relative).string();
}

}  // namespace

Result<ResultPlace> ResultPlace::claim(const std::string& out, const std::string& relative) {
  const std::string place = place_of(out, relative);
  const std::string folder = text(place, kUnfinishedSuffix);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failed("make the folder", folder, error.message());
  const auto lock = lock_folder(folder);
  if (!lock) {
    return Error{ErrorCode::io, text("another run works on ", place, "; wait for it, or use another output")};
  }
  ResultPlace claimed(place, folder, *lock);
  if (auto r = empty_folder(folder); !r) return r.error();
  const std::string record = text(place, kRecordSuffix);
  if (!fs::exists(record, error)) return claimed;
  if (auto r = remove_tree(record); !r) return r.error();
  if (auto r = synchronise(fs::path(place).parent_path().string()); !r) return r.error();
  return claimed;
}

ResultPlace::ResultPlace(ResultPlace&& other) noexcept
    : place_(std::move(other.place_)),
      folder_(std::move(other.folder_)),
      lock_(std::exchange(other.lock_, -1)) {}

ResultPlace::~ResultPlace() {
  if (lock_ < 0) return;
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  close(lock_);
}

std::string ResultPlace::working(const std::string& suffix) const {
  return (fs::path(folder_) / text(fs::path(place_).filename().string(), suffix)).string();
}

Result<void> ResultPlace::complete(const std::vector<std::string>& suffixes, const std::string& record) {
  const std::string record_name(kRecordSuffix);
  if (auto r = write_file(working(record_name), record); !r) return r;
  if (auto r = synchronise_tree(folder_); !r) return r;
  for (const std::string& suffix : suffixes) {
    if (auto r = move_over(without_slash(working(suffix)), without_slash(place_ + suffix)); !r) return r;
  }
  const std::string parent = fs::path(place_).parent_path().string();
  if (auto r = synchronise(parent); !r) return r;
  if (auto r = move_over(working(record_name), place_ + record_name); !r) return r;
  return synchronise(parent);
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
  std::error_code ignored;  // whoever claims the place meets what could not be removed, and tells
  fs::remove_all(folder, ignored);
  close(*lock);
}

}  // namespace scarf::tools::reprocess
