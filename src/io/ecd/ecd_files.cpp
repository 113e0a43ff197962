#include "io/ecd/ecd_files.h"

#include <filesystem>
#include <utility>

#include "core/text.h"

namespace scarf {
namespace {

constexpr std::string_view kEvents = "events.txt";

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

// What macOS puts beside each file of an archive.
bool is_litter(std::string_view name) {
  return name.starts_with("__MACOSX/");
}

bool is_named(std::string_view path, std::string_view name) {
  return path == name || (path.ends_with(name) && path[path.size() - name.size() - 1] == '/');
}

// Names that lead out of the recording are none of it.
bool leads_out(std::string_view name) {
  if (name.starts_with('/')) return true;
  for (const auto& part : std::filesystem::path(name)) {
    if (part == "..") return true;
  }
  return false;
}

}  // namespace

Result<EcdFiles> EcdFiles::find(const Input& input) {
  EcdFiles files;
  files.events_ = kEvents;
  files.watched_ = input.files;
  if (input.folder) {
    files.folder_ = input.path + "/";
    return files;
  }
  if (const auto r = require_path(input, "a zip archive"); !r) return r.error();
  auto archive = ZipArchive::open(input.path);
  if (!archive) return archive.error();
  std::vector<std::string> events;
  std::vector<std::string> texts;
  for (const auto& member : archive->members()) {
    if (is_litter(member.name)) continue;
    if (is_named(member.name, kEvents)) events.push_back(member.name);
    if (member.name.ends_with(".txt")) texts.push_back(member.name);
  }
  const auto& found = events.empty() ? texts : events;
  if (found.size() != 1) {
    return Error{
        events.empty() ? ErrorCode::unrecognised : ErrorCode::bad_input,
        text("the zip archive holds ", found.size(), events.empty() ? " text files" : " recordings",
             "; scarf reads one with one events.txt, or with one text file; unpack it and name a file")};
  }
  const size_t slash = found[0].rfind('/');
  files.folder_ = slash == std::string::npos ? "" : found[0].substr(0, slash + 1);
  files.events_ = found[0].substr(files.folder_.size());
  files.archive_ = *std::move(archive);
  return files;
}

const ZipArchive::Member* EcdFiles::member(std::string_view name) const {
  const std::string path = text(folder_, name);
  for (const auto& member : archive_->members()) {
    if (member.name == path) return &member;
  }
  return nullptr;
}

bool EcdFiles::named_events() const {
  return events_ == kEvents;
}

bool EcdFiles::has_images() const {
  if (archive_) return member(kImages) != nullptr;
  std::error_code ignored;
  return std::filesystem::is_regular_file(text(folder_, kImages), ignored);
}

Result<ByteReader> EcdFiles::open(std::string_view name) const {
  if (leads_out(name)) return bad(text("'", name, "' lies outside the recording"));
  if (!archive_) {
    auto file = watched_->open_regular(text(folder_, name));
    if (!file) return Error{file.error().code, text(name, ": ", file.error().message)};
    return file;
  }
  const auto* const found = member(name);
  if (found == nullptr) return bad(text("the zip archive has no ", folder_, name));
  return archive_->read(*found);
}

bool is_ecd_folder(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(text(path, "/", kEvents), ignored);
}

}  // namespace scarf
