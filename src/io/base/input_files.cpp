#include "io/base/input_files.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"

namespace scarf {

/// A checksum of bytes, however they are cut into pieces: many times as fast as reading them, and against
/// accidents only.
class BytesSeen {
 public:
  void add(std::span<const uint8_t> bytes) {
    count_ += bytes.size();
    if (held_ > 0) {
      const size_t taken = std::min(bytes.size(), kBlock - held_);
      std::copy_n(bytes.begin(), taken, rest_.begin() + static_cast<std::ptrdiff_t>(held_));
      held_ += taken;
      bytes = bytes.subspan(taken);
      if (held_ < kBlock) return;
      add_blocks(rest_);
      held_ = 0;
    }
    const size_t whole = bytes.size() / kBlock * kBlock;
    add_blocks(bytes.first(whole));
    held_ = bytes.size() - whole;
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(whole), held_, rest_.begin());
  }

  uint64_t count() const { return count_; }

  bool operator==(const BytesSeen& other) const {
    const auto held = static_cast<std::ptrdiff_t>(held_);
    return count_ == other.count_ && sums_ == other.sums_ && sums_of_sums_ == other.sums_of_sums_ &&
           std::equal(rest_.begin(), rest_.begin() + held, other.rest_.begin());
  }

 private:
  static constexpr size_t kLanes = 8;
  static constexpr size_t kBlock = kLanes * sizeof(uint64_t);

  // Fletcher's sums, in lanes that a processor adds side by side: the second one knows of places.
  void add_blocks(std::span<const uint8_t> bytes) {
    auto sums = sums_;  // copies, for the compiler to hold in registers
    auto sums_of_sums = sums_of_sums_;
    for (size_t at = 0; at < bytes.size(); at += kBlock) {
      for (size_t lane = 0; lane < kLanes; ++lane) {
        sums[lane] += load_little_endian<uint64_t>(bytes.data() + at + lane * sizeof(uint64_t));
        sums_of_sums[lane] += sums[lane];
      }
    }
    sums_ = sums;
    sums_of_sums_ = sums_of_sums;
  }

  uint64_t count_ = 0;
  std::array<uint64_t, kLanes> sums_{};
  std::array<uint64_t, kLanes> sums_of_sums_{};
  std::array<uint8_t, kBlock> rest_{};
  size_t held_ = 0;  // bytes of rest_
};

namespace {

// Whether the file still begins with the bytes that were read of it.
Result<bool> begins_with(const std::string& path, const BytesSeen& seen) {
  auto reader = ByteReader::open(path);
  if (!reader) return reader.error();
  BytesSeen again;
  while (again.count() < seen.count()) {
    if (const auto filled = reader->fill(1); !filled) return filled.error();
    const auto bytes = reader->available();
    if (bytes.empty()) break;
    const auto taken =
        bytes.first(static_cast<size_t>(std::min<uint64_t>(bytes.size(), seen.count() - again.count())));
    again.add(taken);
    reader->skip(taken.size());
  }
  return again == seen;
}

}  // namespace

Result<ByteReader> InputFiles::open(const std::string& path) {
  return watch(path, &ByteReader::open);
}

Result<ByteReader> InputFiles::open_regular(const std::string& path) {
  return watch(path, &ByteReader::open_regular);
}

Result<ByteReader> InputFiles::watch(const std::string& path, Opening opening) {
  // Before it is opened: what becomes of it in between is seen, too.
  const auto state = path == "-" ? std::nullopt : file_state(path);
  auto reader = opening(path);
  if (!reader || !state) return reader;
  const auto seen = std::make_shared<BytesSeen>();
  reader->observe([seen](std::span<const uint8_t> bytes) { seen->add(bytes); });
  const std::lock_guard lock(mutex_);
  files_.push_back({path, *state, seen});
  return reader;
}

void InputFiles::add(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (const auto state = file_state(path)) files_.push_back({path, *state, nullptr});
}

Result<void> InputFiles::unchanged() const {
  const std::lock_guard lock(mutex_);
  for (const Watched& file : files_) {
    const auto now = file_state(file.path);
    std::string what = difference(file.state, now);
    if (what.empty() && file.seen && now->changed_ns != file.state.changed_ns) {
      const auto same = begins_with(file.path, *file.seen);
      if (!same) return Error{same.error().code, text(file.path, ": ", same.error().message)};
      if (!*same) what = "its content is another one";
    }
    if (what.empty()) continue;
    return Error{ErrorCode::bad_input, text(file.path, " changed while it was read (", what,
                                            "); read it again when it is complete")};
  }
  return {};
}

}  // namespace scarf
