#include "io/files/file_state.h"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>

#include "core/text.h"

namespace scarf {
namespace {

constexpr int64_t kSecond = 1'000'000'000;  // nanoseconds
constexpr int64_t kCoarsest = 2 * kSecond;  // a step of time, of FAT

int64_t nanoseconds(const timespec& time) {
  return int64_t{time.tv_sec} * kSecond + time.tv_nsec;
}

}  // namespace

std::optional<FileState> file_state(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileState{static_cast<uint64_t>(status.st_dev), static_cast<uint64_t>(status.st_ino),
                   static_cast<uint64_t>(status.st_size), nanoseconds(status.st_mtim),
                   nanoseconds(status.st_ctim)};
}

std::string difference(const FileState& before, const std::optional<FileState>& after) {
  if (!after) return "it is no longer there";
  if (before.device != after->device || before.inode != after->inode) {
    return "another file has taken its place";
  }
  if (before.bytes != after->bytes) return text("size ", before.bytes, " -> ", after->bytes, " bytes");
  if (before.modified_ns != after->modified_ns) return "its time of modification is another one";
  return {};
}

bool settled(const FileState& state, int64_t now) {
  return std::max(state.modified_ns, state.changed_ns) < now - kCoarsest;
}

int64_t system_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return nanoseconds(now);
}

}  // namespace scarf
