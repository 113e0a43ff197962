// Reader of rosbag2: a database, or a folder with metadata.yaml and the files that it names, in order.

#include <filesystem>
#include <sstream>
#include <utility>

#include "core/regular_file.h"
#include "core/text.h"
#include "io/known_formats.h"
#include "io/ros_source.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr std::string_view kName = "rosbag2";
constexpr std::string_view kTitle = "a ROS 2 bag (sqlite3)";
constexpr std::string_view kDatabase = "SQLite format 3\0"sv;
constexpr std::string_view kMetadata = "metadata.yaml";
constexpr size_t kMaxMetadata = size_t{64} << 20;  // bytes

Result<std::unique_ptr<RosBag>> open_part(const std::string& path) {
  auto bytes = ByteReader::open_regular(path);
  if (!bytes) return Error{bytes.error().code, text(path, ": ", bytes.error().message)};
  if (const auto filled = bytes->fill(kDatabase.size()); !filled) return filled.error();
  auto bag = is_mcap(bytes->available()) ? open_mcap(*std::move(bytes)) : open_rosbag2_database(path);
  if (!bag) return Error{bag.error().code, text(path, ": ", bag.error().message)};
  return bag;
}

// The files of a folder one after the other.
class Rosbag2Folder final : public RosBag {
 public:
  explicit Rosbag2Folder(std::vector<std::string> paths) : paths_(std::move(paths)) {
    for (const std::string& path : paths_) {
      std::error_code ignored;
      const auto size = fs::file_size(path, ignored);
      total_ += ignored ? 0 : size;
    }
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
      done_ += part_->bytes_read();
      part_.reset();
    }
  }

  uint64_t bytes_read() const override { return done_ + (part_ ? part_->bytes_read() : 0); }
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
      if (file.extension() == ".zstd") {
        return Error{ErrorCode::bad_input, text(file.string(),
                                                " is compressed as a whole: unpack it with zstd -d, and "
                                                "take .zstd out of ",
                                                kMetadata)};
      }
      paths.push_back((fs::path(folder) / file).string());
    } else {
      in_list = false;
    }
  }
  // Other programs have a metadata.yaml of their own.
  if (paths.empty())
    return Error{ErrorCode::unrecognised, text(kMetadata, " names no files (relative_file_paths)")};
  return paths;
}

Result<std::unique_ptr<RosBag>> open_bag(const Input& input) {
  if (const auto path = require_path(input, kTitle); !path) return path.error();
  if (!input.folder) return open_rosbag2_database(input.path);
  auto files = files_of(input.path);
  if (!files) return files.error();
  return std::unique_ptr<RosBag>(std::make_unique<Rosbag2Folder>(*std::move(files)));
}

bool recognise_rosbag2(const Beginning& beginning) {
  if (beginning.folder) {
    std::error_code ignored;
    return fs::exists(fs::path(beginning.path) / kMetadata, ignored);  // also if it is no file, to say so
  }
  const std::string_view start(reinterpret_cast<const char*>(beginning.bytes.data()), beginning.bytes.size());
  return start.starts_with(kDatabase);
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
                               .title = "ROS 2 bag (sqlite3), or its folder",
                               .options = kTakesStream,
#ifndef SCARF_HAS_SQLITE
                               .missing = "SQLite (Debian: libsqlite3-dev)",
#endif
                               .recognise = recognise_rosbag2,
                               .open = open_events_of_rosbag2,
                               .open_triggers = open_triggers_of_rosbag2};

}  // namespace scarf
