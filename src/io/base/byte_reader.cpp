#include "io/base/byte_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/regular_file.h"
#include "core/text.h"

namespace scarf {
namespace {

Error system_error(const char* what) {
  return {ErrorCode::io, text(what, ": ", std::generic_category().message(errno))};
}

}  // namespace

// A file descriptor, closed with the last copy of the reader's function; standard input stays open.
class ByteReader::Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(const std::string& path)
      : fd_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (fd_ >= 0 && fd_ != STDIN_FILENO) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void hold(int fd) { fd_ = fd; }
  int number() const { return fd_; }  ///< negative: it could not be opened
  Result<size_t> read_some(std::span<uint8_t> out) const {
    for (;;) {
      const ssize_t count = read(fd_, out.data(), out.size());
      if (count >= 0) return static_cast<size_t>(count);
      if (errno != EINTR) return system_error("cannot read");
    }
  }

 private:
  int fd_ = -1;
};

// One byte more than a small input has: that it ends can then be seen without growing.
ByteReader::ByteReader(ReadSome read_some, uint64_t total)
    : read_some_(std::move(read_some)),
      capacity_(total == 0 ? kCapacity : static_cast<size_t>(std::min<uint64_t>(total + 1, kCapacity))),
      buffer_(std::make_unique_for_overwrite<uint8_t[]>(capacity_)),
      total_(total) {}

Result<ByteReader> ByteReader::open(const std::string& path) {
  auto file = std::make_shared<Descriptor>(path);
  if (file->number() < 0) return system_error("cannot open");
  return over_descriptor(std::move(file));
}

Result<ByteReader> ByteReader::open_regular(const std::string& path) {
  auto opened = scarf::open_regular(path);
  if (!opened) return opened.error();
  auto file = std::make_shared<Descriptor>();
  file->hold(opened->release());
  return over_descriptor(std::move(file));
}

Result<ByteReader> ByteReader::over_descriptor(std::shared_ptr<const Descriptor> file) {
  struct stat status {};
  const bool sized = fstat(file->number(), &status) == 0 && S_ISREG(status.st_mode);
  return ByteReader([file](std::span<uint8_t> out) { return file->read_some(out); },
                    sized ? static_cast<uint64_t>(status.st_size) : 0);
}

ByteReader ByteReader::over(std::span<const uint8_t> bytes) {
  const auto read_some = [rest = bytes](std::span<uint8_t> out) mutable -> Result<size_t> {
    const size_t count = std::min(out.size(), rest.size());
    std::copy_n(rest.begin(), count, out.begin());
    rest = rest.subspan(count);
    return count;
  };
  return ByteReader(read_some, bytes.size());
}

void ByteReader::observe(Seen seen) {
  read_some_ = [inner = std::move(read_some_), seen = std::move(seen)](std::span<uint8_t> out) {
    const auto count = inner(out);
    if (count && *count > 0) seen(out.first(*count));
    return count;
  };
}

Result<void> ByteReader::refill() {
  if (ended_) return {};
  auto larger = std::unique_ptr<uint8_t[]>();
  if (end_ - begin_ == capacity_ && capacity_ < kCapacity) {  // the input is longer than it said
    capacity_ = kCapacity;
    larger = std::make_unique_for_overwrite<uint8_t[]>(capacity_);
  }
  std::memmove(larger ? larger.get() : buffer_.get(), buffer_.get() + begin_, end_ - begin_);
  if (larger) buffer_ = std::move(larger);
  end_ -= begin_;
  begin_ = 0;
  const auto count = read_some_({buffer_.get() + end_, capacity_ - end_});
  if (!count) return count.error();
  end_ += *count;
  ended_ = *count == 0;
  return {};
}

Result<void> ByteReader::fill(size_t count) {
  while (available().size() < count && !ended_) {
    if (const auto refilled = refill(); !refilled) return refilled;
  }
  return {};
}

void ByteReader::skip(size_t count) {
  begin_ += count;
  consumed_ += count;
}

}  // namespace scarf
