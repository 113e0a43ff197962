#include "io/files/output_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/text.h"
#include "io/files/new_file.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;

using Identity = std::pair<dev_t, ino_t>;

constexpr std::string_view kStandardStream = "-";
constexpr mode_t kPermissions = 0777;
constexpr int kTries = 16;  // of an unpredictable name
constexpr size_t kRandomDigits = 16;
constexpr size_t kStem = 100;  // bytes of a name that its temporary name keeps
constexpr std::string_view kUnfinished = ".part";

Error failed(std::string_view what, const std::string& path, int why = errno) {
  return {ErrorCode::io, text("cannot ", what, " ", path, ": ", std::generic_category().message(why))};
}

Error refused(std::string message) {
  return {ErrorCode::illegal_parameter, std::move(message)};
}

Identity identity_of(const struct stat& file) {
  return {file.st_dev, file.st_ino};
}

bool holds_data(const struct stat& file) {
  return S_ISREG(file.st_mode) || S_ISDIR(file.st_mode) || S_ISBLK(file.st_mode);
}

// Names of this process's own standard output, which need not be opened.
bool is_standard_output(const std::string& path) {
  return path == kStandardStream || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// The same for all ways of writing the path of a file that need not be there.
std::string key_of(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path folder = fs::weakly_canonical(absolute.parent_path(), error);
  return error ? path : (folder / absolute.filename()).lexically_normal().string();
}

// ".NAME.<16 digits>.part.EXTENSION" beside the path.
std::string temporary_beside(const std::string& path) {
  uint64_t random = 0;
  while (getrandom(&random, sizeof random, 0) != sizeof random) {
  }
  std::string digits;
  for (size_t i = 0; i < kRandomDigits; ++i) digits += "0123456789abcdef"[random >> (4 * i) & 15];
  const fs::path place = path;
  const std::string name = place.filename().string().substr(0, kStem);
  const std::string extension = place.extension().string().substr(0, kStem);
  return (place.parent_path() / text('.', name, '.', digits, kUnfinished, extension)).string();
}

// What is at an output's path.
struct Place {
  enum class Kind { free, replaced, direct } kind = Kind::free;
  struct stat status {};
};

Result<Place> place_at(const std::string& path, const OutputRule& rule) {
  if (path.empty()) return refused("the name of the output is empty");
  Place place;
  if (is_standard_output(path)) {
    place.kind = Place::Kind::direct;
    return place;
  }
  if (lstat(path.c_str(), &place.status) != 0) {
    if (errno != ENOENT) return failed("write", path);
    struct stat folder {};
    if (stat(folder_of(path).c_str(), &folder) == 0) {
      if (S_ISDIR(folder.st_mode)) return place;
      errno = ENOTDIR;
    }
    if (errno != ENOENT) return failed("write", path);
    return Error{ErrorCode::io, text("the folder of ", path, " does not exist; create it first")};
  }
  struct stat target {};
  const bool there = stat(path.c_str(), &target) == 0;
  if (there && holds_data(target)) {
    if (const auto input = rule.input_of(target)) {
      return refused(text(path, " is ", *input == path ? "an input" : text("the input ", *input),
                          ", which is never written to; give the output another name"));
    }
  }
  if (S_ISLNK(place.status.st_mode) && (!there || holds_data(target))) {
    return refused(text(path, " is a symbolic link; give the name of the file itself, or another one"));
  }
  if (S_ISDIR(target.st_mode)) return refused(text(path, " is a folder; give the name of a file"));
  if (!holds_data(target)) {
    place.kind = Place::Kind::direct;
    return place;
  }
  if (!rule.overwrite()) {
    return refused(
        text(path, " is there already; give another name, or WriteOptions::overwrite to replace it"));
  }
  place.kind = S_ISREG(target.st_mode) ? Place::Kind::replaced : Place::Kind::direct;
  return place;
}

// Some file systems have no disk to write to.
bool synced(int descriptor) {
  return fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

// What a folder's index and file systems without renameat2 say.
bool unsupported(int why) {
  return why == EINVAL || why == ENOSYS || why == ENOTSUP || why == EPERM;
}

// Each makes `to` of `from`, unless it is there: EEXIST.
bool rename_by_kernel(const std::string& from, const std::string& to) {
  return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0;
}

bool rename_by_link(const std::string& from, const std::string& to) {
  return link(from.c_str(), to.c_str()) == 0 && unlink(from.c_str()) == 0;
}

// Something empty of our own is put there first, and replaced.
bool rename_by_placeholder(const std::string& from, const std::string& to) {
  struct stat status {};
  if (lstat(from.c_str(), &status) != 0) return false;
  if (S_ISDIR(status.st_mode)) {
    if (mkdir(to.c_str(), kPermissions) != 0) return false;
  } else {
    const int made = open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (made < 0) return false;
    close(made);
  }
  return rename(from.c_str(), to.c_str()) == 0;
}

}  // namespace

struct OutputRule::State {
  bool overwrite = false;
  std::mutex mutex;
  std::map<Identity, std::string> inputs;
  struct Folder {
    std::string path;
    std::string except;  // within it, or empty
  };
  std::vector<Folder> folders;    // whose content is not among the inputs yet
  std::set<std::string> written;  // keys of outputs

  void add(const std::string& path, const std::string& shown) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && holds_data(status))
      inputs.try_emplace(identity_of(status), shown);
  }
};

OutputRule::OutputRule(bool overwrite, std::span<const std::string> inputs)
    : state_(std::make_shared<State>()) {
  state_->overwrite = overwrite;
  for (const std::string& path : inputs) add_input(path);
}

bool OutputRule::overwrite() const {
  return state_->overwrite;
}

void OutputRule::add_input(const std::string& path, const std::string& except) {
  const std::lock_guard lock(state_->mutex);
  struct stat status {};
  if (path == kStandardStream) {
    if (fstat(STDIN_FILENO, &status) == 0 && holds_data(status)) {
      state_->inputs.try_emplace(identity_of(status), "standard input");
    }
    return;
  }
  state_->add(path, path);
  if (stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
    state_->folders.push_back({path, except});
    return;
  }
  // What SQLite keeps beside a database is part of it.
  for (const char* companion : {"-wal", "-shm", "-journal"}) state_->add(path + companion, path);
}

std::optional<std::string> OutputRule::input_of(const struct stat& file) const {
  const std::lock_guard lock(state_->mutex);
  for (const auto& [folder, except] : std::exchange(state_->folders, {})) {
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      std::error_code ignored;
      if (!except.empty() && entry->is_directory(ignored) && fs::equivalent(entry->path(), except, ignored)) {
        entry.disable_recursion_pending();
      } else {
        state_->add(entry->path().string(), folder);
      }
    }
  }
  const auto found = state_->inputs.find(identity_of(file));
  return found == state_->inputs.end() ? std::nullopt : std::optional(found->second);
}

Result<void> OutputRule::check(const std::string& path) const {
  const auto place = place_at(path, *this);
  return place ? Result<void>() : Result<void>(place.error());
}

Result<void> OutputRule::check(std::span<const std::string> paths) const {
  std::map<std::string, std::string> keys;
  for (const std::string& path : paths) {
    if (auto r = check(path); !r) return r;
    const auto place = place_at(path, *this);
    if (place && place->kind == Place::Kind::direct) continue;
    const auto [at, fresh] = keys.try_emplace(key_of(path), path);
    if (!fresh) return refused(text("two outputs would both be ", path, "; give one of them another name"));
  }
  return {};
}

Result<OutputFile> OutputFile::create(const std::string& path, const OutputRule& rule) {
  const auto place = place_at(path, rule);
  if (!place) return place.error();
  OutputFile file(path, rule);
  if (place->kind == Place::Kind::direct) {
    file.direct_ = true;
    if (is_standard_output(path)) {
      file.path_ = "standard output";
      file.name_ = "/dev/stdout";
      file.descriptor_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
      if (file.descriptor_ < 0) return failed("write", file.path_);
      return file;
    }
    file.name_ = path;
    file.descriptor_ = open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    struct stat opened {};
    if (file.descriptor_ < 0 || fstat(file.descriptor_, &opened) != 0) return failed("write", path);
    if (S_ISREG(opened.st_mode)) return refused(text(path, " has just become a file; try again"));
    return file;
  }
  {
    const std::lock_guard lock(rule.state_->mutex);
    if (!rule.state_->written.insert(key_of(path)).second) {
      return refused(text("two outputs would both be ", path, "; give one of them another name"));
    }
  }
  // Nobody may read what replaces a file that he may not read.
  const mode_t mode = place->kind == Place::Kind::replaced ? place->status.st_mode & 0600 : 0666;
  for (int attempt = 0; file.descriptor_ < 0; ++attempt) {
    file.name_ = temporary_beside(path);
    const auto make = [&] {
      file.descriptor_ =
          open(file.name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode | 0600);
      return file.descriptor_ >= 0;
    };
    if (file.temporary_.note(file.name_, TemporaryName::Kind::file, make)) break;
    if (errno != EEXIST || attempt == kTries) return failed("create", path);
  }
  return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      name_(std::move(other.name_)),
      rule_(other.rule_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      direct_(other.direct_),
      temporary_(std::move(other.temporary_)) {}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (!direct_) unlink(name_.c_str());
  close(descriptor_);
}

Result<void> OutputFile::take(const std::string& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0 || rename(file.c_str(), name_.c_str()) != 0) {
    const int why = errno;
    if (descriptor >= 0) close(descriptor);
    return failed("write", path_, why);
  }
  close(std::exchange(descriptor_, descriptor));
  return {};
}

Result<void> OutputFile::publish() {
  if (descriptor_ < 0) return Error{ErrorCode::io, text(path_, " is finished already")};
  if (direct_) {
    const int closed = close(std::exchange(descriptor_, -1));
    return closed == 0 ? Result<void>() : Result<void>(failed("write", path_));
  }
  struct stat written {};
  struct stat named {};
  if (fstat(descriptor_, &written) != 0 || lstat(name_.c_str(), &named) != 0) return failed("write", path_);
  if (identity_of(written) != identity_of(named)) {
    return Error{ErrorCode::io,
                 text("cannot write ", path_, ": ", name_, " was replaced by another program")};
  }
  const auto place = place_at(path_, rule_);  // again: minutes may have passed
  if (!place) return Error{ErrorCode::io, text("cannot write the result: ", place.error().message)};
  const bool replaces = place->kind == Place::Kind::replaced;
  if (replaces) {
    const struct stat& old = place->status;
    if (old.st_uid != written.st_uid || old.st_gid != written.st_gid) {
      // Only who may give files away can keep the owner.
      [[maybe_unused]] const int kept = fchown(descriptor_, old.st_uid, old.st_gid);
    }
    if (fchmod(descriptor_, old.st_mode & kPermissions) != 0) return failed("write", path_);
  }
  if (!synced(descriptor_)) return failed("write", path_);
  const std::string folder = folder_of(path_);  // behind the renaming nothing may throw
  const auto moved = replaces ? rename_over(name_, path_) : rename_to_free_name(name_, path_);
  if (!moved) return moved;
  temporary_.forget();
  if (close(std::exchange(descriptor_, -1)) != 0) return failed("write", path_);
  return sync_folder(folder);
}

Result<ScratchFolder> ScratchFolder::create(const std::string& path) {
  for (int attempt = 0;; ++attempt) {
    ScratchFolder folder(temporary_beside(path));
    const auto make = [&] { return mkdir(folder.path_.c_str(), kPermissions) == 0; };
    if (folder.temporary_.note(folder.path_, TemporaryName::Kind::folder, make)) return folder;
    const int why = errno;
    folder.path_.clear();
    if (why != EEXIST || attempt == kTries) return failed("create", path, why);
  }
}

std::string ScratchFolder::file(std::string_view name) const {
  return (fs::path(path_) / name).string();
}

Result<void> ScratchFolder::become(const std::string& path) {
  if (auto r = rename_to_free_name(path_, path); !r) return r;
  temporary_.forget();
  path_.clear();
  return sync_folder(folder_of(path));
}

void ScratchFolder::remove() {
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  path_.clear();
}

Result<MadeFolder> MadeFolder::create(const std::string& path) {
  MadeFolder folder;
  fs::path whole;
  for (const fs::path& part : fs::path(path)) {
    whole /= part;
    const std::string name = whole.string();
    const auto make = [&] { return mkdir(name.c_str(), kPermissions) == 0; };
    TemporaryName noted;
    if (noted.note(name, TemporaryName::Kind::empty_folder, make)) {
      folder.made_.emplace_back(name, std::move(noted));
      continue;
    }
    const int why = errno;
    std::error_code ignored;
    if (!fs::is_directory(whole, ignored)) return failed("make the folder", path, why);
  }
  return folder;
}

MadeFolder::~MadeFolder() {
  while (!made_.empty()) {
    rmdir(made_.back().first.c_str());
    made_.pop_back();
  }
}

bool is_temporary_name(std::string_view name) {
  if (!name.starts_with('.')) return false;
  const size_t end = name.rfind(kUnfinished);
  if (end == name.npos || end < kRandomDigits + 2) return false;
  const std::string_view digits = name.substr(end - kRandomDigits, kRandomDigits);
  return name[end - kRandomDigits - 1] == '.' && digits.find_first_not_of("0123456789abcdef") == digits.npos;
}

Result<void> remove_scratch(const std::string& path) {
  std::error_code error;
  fs::remove_all(path, error);
  return error ? Result<void>(failed("remove", path, error.value())) : Result<void>();
}

Result<void> rename_to_free_name(const std::string& from, const std::string& to, Naming naming) {
  bool done = naming == Naming::by_kernel && rename_by_kernel(from, to);
  if (!done && (naming == Naming::by_link || (naming == Naming::by_kernel && unsupported(errno)))) {
    done = rename_by_link(from, to);
  }
  if (!done && (naming == Naming::by_placeholder || unsupported(errno))) {
    done = rename_by_placeholder(from, to);
  }
  if (done) return {};
  if (errno == EEXIST) {
    return Error{ErrorCode::io, text("cannot write ", to, ": another program has just made it")};
  }
  return failed("write", to);
}

Result<void> rename_over(const std::string& from, const std::string& to) {
  return rename(from.c_str(), to.c_str()) == 0 ? Result<void>() : Result<void>(failed("write", to));
}

Result<void> write_new_file(const std::string& path, std::string_view content) {
  int descriptor = -1;
  const auto make = [&] {
    descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    return descriptor >= 0;
  };
  TemporaryName name;  // so that nothing is made any more while a signal removes the scratch folder
  if (!name.note(path, TemporaryName::Kind::file, make)) return failed("create", path);
  name.forget();
  bool good = true;
  while (good && !content.empty()) {
    const ssize_t count = write(descriptor, content.data(), content.size());
    if (count > 0) content.remove_prefix(static_cast<size_t>(count));
    good = count > 0 || errno == EINTR;
  }
  const int why = errno;
  if (close(descriptor) == 0 && good) return {};
  return failed("write", path, good ? errno : why);
}

Result<void> remove_file(const std::string& path) {
  if (unlink(path.c_str()) == 0 || errno == ENOENT) return {};
  return failed("remove", path);
}

Result<void> remove_empty_folder(const std::string& path) {
  if (rmdir(path.c_str()) == 0 || errno == ENOENT) return {};
  return failed("remove the folder", path);
}

Result<void> sync_folder(const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 && errno == EACCES) return {};  // may be written, not read
  if (descriptor < 0) return failed("open", folder);
  const bool done = synced(descriptor);
  const int why = errno;
  close(descriptor);
  return done ? Result<void>() : Result<void>(failed("write", folder, why));
}

Result<void> sync_tree(const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return failed("open", folder);
  const bool done = syncfs(descriptor) == 0;
  const int why = errno;
  close(descriptor);
  return done ? Result<void>() : Result<void>(failed("write", folder, why));
}

}  // namespace scarf
