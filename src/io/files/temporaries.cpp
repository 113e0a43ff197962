// The signal handler does nothing but system calls that POSIX allows in one, and getdents64, which is one.
#include "io/files/temporaries.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <utility>

namespace scarf {

struct TemporaryName::Entry {
  static constexpr int kFree = -1;

  std::atomic<bool> taken = true;
  std::atomic<int> kind = kFree;
  Entry* next = nullptr;
  char path[PATH_MAX] = {};
};

struct Temporaries {
  using Entry = TemporaryName::Entry;

  // Entries are used again and never given back: the handler may walk them at any time.
  static inline std::atomic<Entry*> first = nullptr;
  static inline std::atomic<int> being_made = 0;
  static inline std::atomic<bool> ending = false;

  static Entry* take() {
    for (Entry* e = first; e != nullptr; e = e->next) {
      bool expected = false;
      if (e->taken.compare_exchange_strong(expected, true)) return e;
    }
    auto* const made = new Entry;
    made->next = first;
    while (!first.compare_exchange_weak(made->next, made)) {
    }
    return made;
  }
};

namespace {

constexpr int kSignals[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGPIPE, SIGALRM,
                            SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ};
constexpr int kDeepest = 4;      // folders within folders that scarf itself makes
constexpr int kPatience = 1000;  // milliseconds

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// While one lives, no signal is handled by this thread, and a handler of another one waits.
class Making {
 public:
  Making() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
    ++Temporaries::being_made;
    if (!Temporaries::ending) return;
    --Temporaries::being_made;
    for (;;) pause();  // the program ends
  }
  ~Making() {
    --Temporaries::being_made;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;

 private:
  sigset_t before_{};
};

// As the kernel hands them out.
struct DirectoryEntry {
  uint64_t inode;
  int64_t offset;
  uint16_t length;
  uint8_t type;
  char name[1];
};

void remove_content(int folder, int depth) {
  static char buffers[kDeepest][16 * 1024];
  if (depth >= kDeepest) return;
  bool removed = true;
  while (removed) {  // entries may be passed over while others are removed
    removed = false;
    lseek(folder, 0, SEEK_SET);
    for (;;) {
      const long size = syscall(SYS_getdents64, folder, buffers[depth], sizeof buffers[depth]);
      if (size <= 0) break;
      for (long at = 0; at < size;) {
        const auto* const entry = reinterpret_cast<const DirectoryEntry*>(buffers[depth] + at);
        at += entry->length;
        const char* const name = buffers[depth] + at - entry->length + offsetof(DirectoryEntry, name);
        if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
        if (unlinkat(folder, name, 0) == 0) {
          removed = true;
          continue;
        }
        const int inner = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (inner < 0) continue;
        remove_content(inner, depth + 1);
        close(inner);
        removed |= unlinkat(folder, name, AT_REMOVEDIR) == 0;
      }
    }
  }
}

void remove_all_noted() {
  for (int wait = 0; wait < kPatience && Temporaries::being_made > 0; ++wait) {
    const timespec millisecond{0, 1'000'000};
    nanosleep(&millisecond, nullptr);
  }
  const auto each = [](TemporaryName::Kind kind, auto remove) {
    for (auto* e = Temporaries::first.load(); e != nullptr; e = e->next) {
      if (e->kind == static_cast<int>(kind)) remove(e->path);
    }
  };
  each(TemporaryName::Kind::file, [](const char* path) { unlink(path); });
  each(TemporaryName::Kind::folder, [](const char* path) {
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    remove_content(folder, 0);
    close(folder);
    rmdir(path);
  });
  // Folders may be in each other.
  for (int pass = 0; pass < kDeepest; ++pass) {
    each(TemporaryName::Kind::empty_folder, [](const char* path) { rmdir(path); });
  }
}

void end_by(int signal) {
  if (Temporaries::ending.exchange(true)) {
    for (;;) pause();  // another thread is at it
  }
  remove_all_noted();
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  sigaction(signal, &standard, nullptr);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  kill(getpid(), signal);  // the process as a whole: the other threads may have it blocked
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  for (;;) pause();
}

}  // namespace

TemporaryName::TemporaryName(TemporaryName&& other) noexcept : entry_(std::exchange(other.entry_, nullptr)) {}

TemporaryName& TemporaryName::operator=(TemporaryName&& other) noexcept {
  if (this != &other) {
    forget();
    entry_ = std::exchange(other.entry_, nullptr);
  }
  return *this;
}

bool TemporaryName::note(const std::string& path, Kind kind, const std::function<bool()>& make) {
  forget();
  if (path.size() >= sizeof Entry::path) {
    errno = ENAMETOOLONG;
    return false;
  }
  Entry* const entry = Temporaries::take();
  const Making making;
  std::copy_n(path.c_str(), path.size() + 1, entry->path);
  // Noted first: the name is not known to anyone else, so nobody else's file can have it.
  entry->kind = static_cast<int>(kind);
  entry_ = entry;
  if (make()) return true;
  const int why = errno;
  forget();
  errno = why;
  return false;
}

void TemporaryName::forget() {
  if (entry_ == nullptr) return;
  entry_->kind = Entry::kFree;
  std::exchange(entry_, nullptr)->taken = false;
}

void remove_temporaries_on_signals() {
  struct sigaction handled {};
  handled.sa_handler = end_by;
  sigfillset(&handled.sa_mask);
  for (const int signal : kSignals) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) {
      sigaction(signal, &handled, nullptr);
    }
  }
}

}  // namespace scarf
