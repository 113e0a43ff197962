#include "output/whole_video.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/little_endian.h"
#include "core/regular_file.h"
#include "core/text.h"

namespace scarf {
namespace {

uint64_t big_endian(std::span<const uint8_t> bytes) {
  uint64_t value = 0;
  for (const uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

// Bytes of the chunk that begins so; 0 if it is none, or was never finished.
uint64_t chunk_bytes(std::span<const uint8_t, 16> head) {
  constexpr uint64_t kHead = 8;
  if (std::string_view(reinterpret_cast<const char*>(head.data()), 4) == "RIFF") {
    const uint64_t size = load_little_endian<uint32_t>(&head[4]);
    return size == 0 ? 0 : kHead + size + size % 2;
  }
  const uint64_t size = big_endian(head.first(4));
  if (size == 1) return big_endian(head.subspan(8, 8));
  return size < kHead ? 0 : size;
}

Result<bool> is_whole(int fd) {
  struct stat status {};
  if (fstat(fd, &status) != 0) return Error{ErrorCode::io, std::generic_category().message(errno)};
  const auto size = static_cast<uint64_t>(status.st_size);
  uint64_t at = 0;
  while (at < size) {
    std::array<uint8_t, 16> head{};
    const ssize_t count = pread(fd, head.data(), head.size(), static_cast<off_t>(at));
    if (count < 0) return Error{ErrorCode::io, std::generic_category().message(errno)};
    const uint64_t bytes = count < 8 ? 0 : chunk_bytes(head);
    if (bytes == 0 || bytes > size - at) return false;
    at += bytes;
  }
  return size > 0;
}

// Why a file could not grow: by letting it grow a little. It is of no use any more.
std::string reason_of(const std::string& path) {
  const FileDescriptor file(open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const std::vector<char> some(64 * 1024);
  for (int i = 0; i < 16; ++i) {
    if (write(file.get(), some.data(), some.size()) < 0) return std::generic_category().message(errno);
  }
  return "the encoder has not finished it";
}

}  // namespace

Result<void> check_whole_video(const std::string& path, const std::string& shown) {
  const auto file = open_regular(path);
  if (!file) return Error{ErrorCode::io, text("cannot write ", shown, ": ", file.error().message)};
  const auto whole = is_whole(file->get());
  if (!whole) return Error{ErrorCode::io, text("cannot write ", shown, ": ", whole.error().message)};
  if (*whole) return {};
  return Error{ErrorCode::io, text("cannot write ", shown, ": ", reason_of(path))};
}

}  // namespace scarf
