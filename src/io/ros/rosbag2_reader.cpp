// Reader of rosbag2: a database, or a folder with metadata.yaml and the files that it names, in order.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/regular_file.h"
#include "core/text.h"
#include "io/base/decompressor.h"
#include "io/base/known_formats.h"
#include "io/ros/ros_source.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr std::string_view kName = "rosbag2";
constexpr std::string_view kTitle = "a ROS 2 bag (sqlite3)";
constexpr std::string_view kDatabase = "SQLite format 3\0"sv;
constexpr std::string_view kMetadata = "metadata.yaml";
// Added to a database's name: the file where SQLite keeps what is not in the database yet.
constexpr std::string_view kLog = "-wal";
constexpr size_t kMaxMetadata = size_t{64} << 20;  // bytes

// A file that lives as long as this, and whose name nobody can foresee.
class TemporaryFile {
 public:
  // Errors: io.
  static Result<TemporaryFile> create() {
    std::error_code failure;
    const fs::path folder = fs::temp_directory_path(failure);
    if (failure) {
      return Error{ErrorCode::io,
                   text("there is no folder for temporary files, to unpack the bag into (TMPDIR): ",
                        failure.message())};
    }
    std::string path = folder / "scarf-XXXXXX";
    const int fd = mkostemp(path.data(), O_CLOEXEC);
    if (fd < 0) return failed(path, "create");
    return TemporaryFile(std::move(path), fd);
  }
  TemporaryFile(TemporaryFile&& other) noexcept
      : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)) {}
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile() {
    if (fd_ < 0) return;
    close(fd_);
    unlink(path_.c_str());
  }

  const std::string& path() const { return path_; }

  // Errors: io.
  Result<void> append(std::span<const uint8_t> bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = write(fd_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return failed(path_, "write");
      bytes = bytes.subspan(static_cast<size_t>(count));
    }
    return {};
  }

 private:
  TemporaryFile(std::string path, int fd) : path_(std::move(path)), fd_(fd) {}
  static Error failed(const std::string& path, std::string_view what) {
    return {ErrorCode::io,
            text("cannot ", what, " ", path, " to unpack the bag into (TMPDIR names another folder): ",
                 std::generic_category().message(errno))};
  }

  std::string path_;
  int fd_;
};

// SQLite reads files only. The file has no name any more when it is open.
Result<std::unique_ptr<RosBag>> open_unpacked_database(ByteReader bytes) {
  auto file = TemporaryFile::create();
  if (!file) return file.error();
  for (;;) {
    if (const auto filled = bytes.fill(1); !filled) return filled.error();
    if (bytes.available().empty()) break;
    if (auto r = file->append(bytes.available()); !r) return r.error();
    bytes.skip(bytes.available().size());
  }
  return open_rosbag2_database(file->path());
}

Result<std::unique_ptr<RosBag>> open_bytes(ByteReader bytes, const std::string& path) {
  if (const auto filled = bytes.fill(kDatabase.size()); !filled) return filled.error();
  const bool packed = looks_like_zstd(bytes.available());
  if (packed) {
    auto unpacked = Decompressor::unpack_file(Compression::zstd, std::move(bytes));
    if (!unpacked) return unpacked.error();
    bytes = *std::move(unpacked);
    if (const auto filled = bytes.fill(kDatabase.size()); !filled) return filled.error();
  }
  if (is_mcap(bytes.available())) return open_mcap(std::move(bytes));
  return packed ? open_unpacked_database(std::move(bytes)) : open_rosbag2_database(path);
}

// `path`: of a database, an MCAP, or either of them compressed as a whole.
Result<std::unique_ptr<RosBag>> open_part(const std::string& path) {
  auto bytes = ByteReader::open_regular(path);
  if (!bytes) return Error{bytes.error().code, text(path, ": ", bytes.error().message)};
  auto bag = open_bytes(*std::move(bytes), path);
  if (!bag) return Error{bag.error().code, text(path, ": ", bag.error().message)};
  return bag;
}

uint64_t size_of(const std::string& path) {
  std::error_code failure;
  const auto size = fs::file_size(path, failure);
  return failure ? 0 : size;
}

// The files of a folder one after the other.
class Rosbag2Folder final : public RosBag {
 public:
  explicit Rosbag2Folder(std::vector<std::string> paths) : paths_(std::move(paths)) {
    for (const std::string& path : paths_) total_ += size_of(path);
  }

  Result<std::optional<RosMessage>> next() override {
    for (;;) {
      if (!part_) {
        if (next_ == paths_.size()) return std::optional<RosMessage>();
        auto part = open_part(paths_[next_]);
        if (!part) return part.error();
        part_ = *std::move(part);
        ++next_;
      }
      auto message = part_->next();
      if (!message || *message) return message;
      done_ += size_of(paths_[next_ - 1]);
      part_.reset();
    }
  }

  // Of a file that is compressed, more bytes are read than it has.
  uint64_t bytes_read() const override {
    return done_ + (part_ ? std::min(part_->bytes_read(), size_of(paths_[next_ - 1])) : 0);
  }
  uint64_t bytes_total() const override { return total_; }

 private:
  std::vector<std::string> paths_;
  size_t next_ = 0;
  std::unique_ptr<RosBag> part_;
  uint64_t done_ = 0;
  uint64_t total_ = 0;
};

std::string_view without_quotes(std::string_view word) {
  if (word.size() >= 2 && (word.front() == '"' || word.front() == '\'') && word.back() == word.front()) {
    word = word.substr(1, word.size() - 2);
  }
  return word;
}

// The metadata may name a file as it was before it was compressed, or unpacked.
std::string as_it_is(const std::string& path) {
  constexpr std::string_view kPacked = ".zstd";
  std::error_code ignored;
  if (fs::exists(path, ignored)) return path;
  const std::string other =
      path.ends_with(kPacked) ? path.substr(0, path.size() - kPacked.size()) : text(path, kPacked);
  return fs::exists(other, ignored) ? other : path;
}

// Of the metadata only the list relative_file_paths matters: lines "- name" behind it.
Result<std::vector<std::string>> files_of(const std::string& folder) {
  const auto content = read_whole((fs::path(folder) / kMetadata).string(), kMaxMetadata);
  if (!content) return Error{content.error().code, text(kMetadata, ": ", content.error().message)};
  std::istringstream metadata(*content);
  std::vector<std::string> paths;
  bool in_list = false;
  for (std::string line; std::getline(metadata, line);) {
    const size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    const std::string_view word =
        std::string_view(line).substr(begin, line.find_last_not_of(" \r") + 1 - begin);
    if (word == "relative_file_paths:") {
      in_list = true;
    } else if (in_list && word.starts_with("- ")) {
      // Files of a bag lie in its folder, wherever they were recorded.
      const fs::path file = fs::path(without_quotes(word.substr(2))).filename();
      paths.push_back(as_it_is((fs::path(folder) / file).string()));
    } else {
      in_list = false;
    }
  }
  if (metadata.bad()) return Error{ErrorCode::io, text("cannot read ", kMetadata, " to its end")};
  // Other programs have a metadata.yaml of their own.
  if (paths.empty())
    return Error{ErrorCode::unrecognised, text(kMetadata, " names no files (relative_file_paths)")};
  return paths;
}

Result<std::unique_ptr<RosBag>> open_bag(Input& input) {
  if (const auto path = require_path(input, kTitle); !path) return path.error();
  if (!input.folder) {
    input.files->add(text(input.path, kLog));
    return open_bytes(std::move(input.bytes), input.path);
  }
  input.files->add((fs::path(input.path) / kMetadata).string());
  auto files = files_of(input.path);
  if (!files) return files.error();
  for (const std::string& file : *files) {
    input.files->add(file);
    input.files->add(text(file, kLog));
  }
  return std::unique_ptr<RosBag>(std::make_unique<Rosbag2Folder>(*std::move(files)));
}

// Whether a compressed file is a bag. Of a pipe only its beginning can be looked at.
bool holds_bag(const Beginning& beginning) {
  auto packed = beginning.path.empty() ? Result<ByteReader>(ByteReader::over(beginning.bytes))
                                       : ByteReader::open(beginning.path);
  if (!packed) return false;
  auto bytes = Decompressor::unpack_file(Compression::zstd, *std::move(packed));
  if (!bytes || !bytes->fill(kDatabase.size())) return false;
  return starts_with(bytes->available(), kDatabase) || is_mcap(bytes->available());
}

bool recognise_rosbag2(const Beginning& beginning) {
  if (beginning.folder) {
    std::error_code ignored;
    return fs::exists(fs::path(beginning.path) / kMetadata, ignored);  // also if it is no file, to say so
  }
  if (looks_like_zstd(beginning.bytes)) return holds_bag(beginning);
  return starts_with(beginning.bytes, kDatabase);
}

Result<std::unique_ptr<EventSource>> open_events_of_rosbag2(Input input, const ReadOptions& options) {
  auto bag = open_bag(input);
  if (!bag) return bag.error();
  return ros_events(*std::move(bag), kName, input.name, options);
}

Result<std::unique_ptr<TriggerSource>> open_triggers_of_rosbag2(Input input, const ReadOptions& options) {
  auto bag = open_bag(input);
  if (!bag) return bag.error();
  return ros_triggers(*std::move(bag), input.name, options);
}

}  // namespace

const Format kRosbag2Format = {.name = kName,
                               .title = "ROS 2 bag (sqlite3), or its folder, compressed or not",
                               .options = kTakesStream,
                               .packed = true,
#ifndef SCARF_HAS_SQLITE
                               .missing = "SQLite (Debian: libsqlite3-dev)",
#endif
                               .recognise = recognise_rosbag2,
                               .open = open_events_of_rosbag2,
                               .open_triggers = open_triggers_of_rosbag2};

}  // namespace scarf
