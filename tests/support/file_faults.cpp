// Linked into a program, makes the n-th file call on a folder fail: of the program and of every library in
// it, because the definitions here come before those of libc. What counts and fails is said in the
// environment:
//   SCARF_FAULT_FOLDER  calls on files below this folder count
//   SCARF_FAULT_ERROR   the errno: only calls that may fail with it count
//   SCARF_FAULT_AT      number of the call that fails, from 1; 0: none
//   SCARF_FAULT_STAYS   set: so do all calls behind it, as on a disk that stays full
//   SCARF_FAULT_COUNT   the file that gets the number of calls when the program ends
// Not seen are the calls that libc's own buffered files make (fwrite), whose failures a small disk has to
// show.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

enum Kind : unsigned { reads = 1, writes = 2, opens = 4 };

class Faults {
 public:
  static Faults& get() {
    static Faults* const faults = new Faults;  // outlives everything that opens files
    return *faults;
  }

  bool below(const char* path) const {
    return path != nullptr && !folder_.empty() && std::string_view(path).starts_with(folder_);
  }
  void watch(int fd, bool watched) {
    if (fd >= 0 && static_cast<size_t>(fd) < watched_.size()) watched_[static_cast<size_t>(fd)] = watched;
  }
  bool watches(int fd) const {
    return fd >= 0 && static_cast<size_t>(fd) < watched_.size() && watched_[static_cast<size_t>(fd)];
  }

  // Whether this call fails; errno is then set.
  bool fails(unsigned kind) {
    if ((kind & applies()) == 0) return false;
    const long call = ++calls_;
    if (at_ == 0 || call < at_ || (call > at_ && !stays_)) return false;
    errno = error_;
    return true;
  }

 private:
  Faults()
      : folder_(value("SCARF_FAULT_FOLDER")),
        error_(number("SCARF_FAULT_ERROR")),
        at_(number("SCARF_FAULT_AT")),
        stays_(*value("SCARF_FAULT_STAYS") != '\0') {
    std::atexit([] {
      const std::string text = std::to_string(get().calls_);
      const int fd = static_cast<int>(
          syscall(SYS_openat, AT_FDCWD, value("SCARF_FAULT_COUNT"), O_WRONLY | O_CREAT | O_TRUNC, 0666));
      if (fd < 0) return;
      syscall(SYS_write, fd, text.data(), text.size());
      syscall(SYS_close, fd);
    });
  }

  static const char* value(const char* name) {
    const char* const found = std::getenv(name);
    return found == nullptr ? "" : found;
  }
  static int number(const char* name) { return std::atoi(value(name)); }

  unsigned applies() const {
    switch (error_) {
      case ENOSPC:
        return writes;
      case EISDIR:
        return opens;
      default:
        return reads | writes | opens;
    }
  }

  const std::string folder_;
  const int error_;
  const long at_;
  const bool stays_;
  std::atomic<long> calls_ = 0;
  std::array<std::atomic<bool>, 4096> watched_{};
};

// libc's own definition.
template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

unsigned kind_of_open(int flags) {
  return (flags & O_CREAT) != 0 ? unsigned{writes} | opens : unsigned{opens};
}

using Open = int(const char*, int, ...);
using OpenAt = int(int, const char*, int, ...);

int opened(int fd) {
  Faults::get().watch(fd, true);
  return fd;
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

template <class Real, class... Arguments>
auto on(int fd, unsigned kind, const char* name, Arguments... arguments) {
  static Real* const call = real<Real>(name);
  using Answer = decltype(call(arguments...));
  Faults& faults = Faults::get();
  return faults.watches(fd) && faults.fails(kind) ? Answer{-1} : call(arguments...);
}

}  // namespace

extern "C" {

#define SCARF_OPEN(name)                                                                    \
  int name(const char* path, int flags, ...) {                                              \
    static Open* const call = real<Open>(#name);                                            \
    va_list arguments;                                                                      \
    va_start(arguments, flags);                                                             \
    const mode_t mode = mode_of(flags, arguments);                                          \
    va_end(arguments);                                                                      \
    if (!Faults::get().below(path)) return call(path, flags, mode);                         \
    return Faults::get().fails(kind_of_open(flags)) ? -1 : opened(call(path, flags, mode)); \
  }
SCARF_OPEN(open)
SCARF_OPEN(open64)

#define SCARF_OPENAT(name)                                                                          \
  int name(int folder, const char* path, int flags, ...) {                                          \
    static OpenAt* const call = real<OpenAt>(#name);                                                \
    va_list arguments;                                                                              \
    va_start(arguments, flags);                                                                     \
    const mode_t mode = mode_of(flags, arguments);                                                  \
    va_end(arguments);                                                                              \
    if (!Faults::get().below(path)) return call(folder, path, flags, mode);                         \
    return Faults::get().fails(kind_of_open(flags)) ? -1 : opened(call(folder, path, flags, mode)); \
  }
SCARF_OPENAT(openat)
SCARF_OPENAT(openat64)

#define SCARF_FOPEN(name)                                                                                   \
  FILE* name(const char* path, const char* mode) {                                                          \
    static auto* const call = real<FILE*(const char*, const char*)>(#name);                                 \
    const unsigned kind = std::strpbrk(mode, "wa") != nullptr ? unsigned{writes} | opens : unsigned{opens}; \
    if (!Faults::get().below(path)) return call(path, mode);                                                \
    if (Faults::get().fails(kind)) return nullptr;                                                          \
    FILE* const file = call(path, mode);                                                                    \
    if (file != nullptr) opened(fileno(file));                                                              \
    return file;                                                                                            \
  }
SCARF_FOPEN(fopen)
SCARF_FOPEN(fopen64)

int mkstemp(char* pattern) {
  static auto* const call = real<int(char*)>("mkstemp");
  if (!Faults::get().below(pattern)) return call(pattern);
  return Faults::get().fails(unsigned{writes} | opens) ? -1 : opened(call(pattern));
}
int mkostemp(char* pattern, int flags) {
  static auto* const call = real<int(char*, int)>("mkostemp");
  if (!Faults::get().below(pattern)) return call(pattern, flags);
  return Faults::get().fails(unsigned{writes} | opens) ? -1 : opened(call(pattern, flags));
}

int close(int fd) {
  static auto* const call = real<int(int)>("close");
  const bool fails = Faults::get().watches(fd) && Faults::get().fails(writes);
  const int error = errno;
  Faults::get().watch(fd, false);
  const int closed = call(fd);  // it is closed all the same
  if (!fails) return closed;
  errno = error;
  return -1;
}

ssize_t read(int fd, void* out, size_t size) {
  return on<ssize_t(int, void*, size_t)>(fd, reads, "read", fd, out, size);
}
ssize_t pread(int fd, void* out, size_t size, off_t at) {
  return on<ssize_t(int, void*, size_t, off_t)>(fd, reads, "pread", fd, out, size, at);
}
ssize_t pread64(int fd, void* out, size_t size, off64_t at) {
  return on<ssize_t(int, void*, size_t, off64_t)>(fd, reads, "pread64", fd, out, size, at);
}
ssize_t write(int fd, const void* bytes, size_t size) {
  return on<ssize_t(int, const void*, size_t)>(fd, writes, "write", fd, bytes, size);
}
ssize_t pwrite(int fd, const void* bytes, size_t size, off_t at) {
  return on<ssize_t(int, const void*, size_t, off_t)>(fd, writes, "pwrite", fd, bytes, size, at);
}
ssize_t pwrite64(int fd, const void* bytes, size_t size, off64_t at) {
  return on<ssize_t(int, const void*, size_t, off64_t)>(fd, writes, "pwrite64", fd, bytes, size, at);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  return on<ssize_t(int, const iovec*, int)>(fd, writes, "writev", fd, parts, count);
}
int fsync(int fd) {
  return on<int(int)>(fd, writes, "fsync", fd);
}
int fdatasync(int fd) {
  return on<int(int)>(fd, writes, "fdatasync", fd);
}
int ftruncate(int fd, off_t size) noexcept {
  return on<int(int, off_t)>(fd, writes, "ftruncate", fd, size);
}
int ftruncate64(int fd, off64_t size) noexcept {
  return on<int(int, off64_t)>(fd, writes, "ftruncate64", fd, size);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const call = real<int(const char*, const char*)>("rename");
  return Faults::get().below(to) && Faults::get().fails(writes) ? -1 : call(from, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  static auto* const call = real<int(int, const char*, int, const char*, unsigned)>("renameat2");
  const bool fails = Faults::get().below(to) && Faults::get().fails(writes);
  return fails ? -1 : call(from_folder, from, to_folder, to, flags);
}
int link(const char* from, const char* to) noexcept {
  static auto* const call = real<int(const char*, const char*)>("link");
  return Faults::get().below(to) && Faults::get().fails(writes) ? -1 : call(from, to);
}
int mkdir(const char* path, mode_t mode) noexcept {
  static auto* const call = real<int(const char*, mode_t)>("mkdir");
  return Faults::get().below(path) && Faults::get().fails(writes) ? -1 : call(path, mode);
}

}  // extern "C"
