#include "reprocess/input_state.h"

#include <filesystem>
#include <system_error>

#include "core/text.h"
#include "reprocess/input_digest.h"

namespace scarf::reprocess {
namespace {

namespace fs = std::filesystem;

bool equal(const InputState& a, const InputState& b) {
  return a.folder == b.folder && a.files == b.files;
}

// What makes the content another one; empty if nothing does, or only times of last change differ.
std::string difference(const InputState& before, const InputState& after) {
  for (const auto& [name, state] : before.files) {
    const auto found = after.files.find(name);
    const std::string what =
        scarf::difference(state, found == after.files.end() ? std::nullopt : std::optional(found->second));
    if (!what.empty()) return name.empty() ? what : text(name, ": ", what);
  }
  for (const auto& [name, state] : after.files) {
    if (!before.files.contains(name)) return text(name, " is new");
  }
  return {};
}

}  // namespace

uint64_t InputState::bytes() const {
  uint64_t sum = 0;
  for (const auto& [name, state] : files) sum += state.bytes;
  return sum;
}

std::optional<FileState> InputState::file() const {
  if (folder || files.empty()) return std::nullopt;
  return files.begin()->second;
}

Result<InputState> input_state(const std::string& path, const std::string& out) {
  InputState input;
  input.noted_ns = system_time_ns();
  std::error_code ignored;
  input.folder = fs::is_directory(path, ignored);
  if (!input.folder) {
    if (const auto state = file_state(path)) input.files.emplace("", *state);
    return input;
  }
  const auto names = files_below(path, out);
  if (!names) return names.error();
  for (const std::string& name : *names) {
    if (const auto state = file_state((fs::path(path) / name).string())) input.files.emplace(name, *state);
  }
  return input;
}

Result<InputIdentity> identify(const std::string& path, const std::string& out, const InputState& before,
                               BytesRead& read) {
  InputIdentity identity;
  const bool pipe = !before.folder && before.files.empty();
  const bool read_whole = pipe || (!before.folder && read.count == before.bytes());
  auto sha256 = read_whole ? Result<std::string>(read.digest.hex()) : input_digest(path, out);
  if (!sha256) return sha256.error();
  auto after = input_state(path, out);
  if (!after) return after.error();
  std::string what = difference(before, *after);
  if (what.empty() && !equal(before, *after)) {
    const auto again = input_digest(path, out);
    if (!again) return again.error();
    const auto last = input_state(path, out);
    if (!last) return last.error();
    if (*again != *sha256) what = "its content is another one";
    if (!equal(*after, *last)) what = "it goes on changing";
  }
  if (!what.empty()) {
    return Error{ErrorCode::bad_input,
                 text(path, " changed while it was read (", what, "); process it again when it is complete")};
  }
  identity.sha256 = *std::move(sha256);
  identity.bytes = pipe ? read.count : after->bytes();
  const auto file = after->file();
  if (file && settled(*file, after->noted_ns)) identity.state = file;
  return identity;
}

bool is_same_input(const std::string& path, const std::string& out, const InputState& now,
                   const InputIdentity& recorded) {
  if (now.bytes() != recorded.bytes) return false;
  const auto file = now.file();
  if (file && recorded.state) {
    FileState noted = *recorded.state;
    noted.device = file->device;  // is numbered anew by each mount
    if (noted == *file) return true;
  }
  const auto digest = input_digest(path, out);
  return digest && *digest == recorded.sha256;
}

}  // namespace scarf::reprocess
