#include "output/pictures.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <system_error>
#include <utility>

#include "core/text.h"
#include "io/files/new_file.h"
#include "io/files/write_file.h"
#include "output/opencv_picture.h"
#include "output/owned_files.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;

constexpr size_t kDigits = 6;  // at least
constexpr std::string_view kExtension = ".png";

bool is_numbered(std::string_view file, std::string_view name) {
  if (!file.starts_with(name) || !file.ends_with(kExtension)) return false;
  file.remove_prefix(name.size());
  if (!file.starts_with('_')) return false;
  const std::string_view digits = file.substr(1, file.size() - 1 - kExtension.size());
  return digits.size() >= kDigits && digits.find_first_not_of("0123456789") == digits.npos;
}

Error refused(std::string message) {
  return {ErrorCode::illegal_parameter, std::move(message)};
}

Result<std::string> encoded(const std::string& name, const PictureView& picture) {
  std::vector<uint8_t> bytes;
  if (!cv::imencode(fs::path(name).extension().string(), as_mat(picture), bytes)) {
    return Error{ErrorCode::io, text("OpenCV cannot encode ", name, "; install OpenCV with PNG and PGM")};
  }
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace

Result<void> write_picture(const std::string& path, const PictureView& picture, const OutputRule& rule) {
  const auto bytes = encoded(path, picture);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes, rule);
}

std::string numbered_picture(std::string_view name, uint64_t index) {
  std::string digits = std::to_string(index);
  if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
  return text(name, "_", digits, kExtension);
}

Result<void> PictureFolder::check(const std::string& path, const std::vector<std::string_view>& names,
                                  const OutputRule& rule) {
  if (path.empty()) return refused("the name of the output folder is empty");
  std::error_code error;
  if (fs::weakly_canonical(fs::absolute(path, error), error).relative_path().empty()) {
    return refused(text(path, " is the root of the file system; give another folder"));
  }
  struct stat folder {};
  if (stat(path.c_str(), &folder) != 0) {
    if (!fs::is_symlink(path, error)) return {};
    return refused(text(path, " is a symbolic link to nothing; give another name"));
  }
  if (!S_ISDIR(folder.st_mode)) return refused(text(path, " is no folder; give another name"));
  if (const auto input = rule.input_of(folder)) {
    return refused(text(path, " is, or is part of, the input ", *input, "; give another folder"));
  }
  const auto owned = OwnedFiles::read(path);
  if (!owned) return owned.error();
  std::vector<std::string> ours{std::string(kPictureList)};
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    std::string file = entry->path().filename().string();
    const bool numbered = std::any_of(names.begin(), names.end(),
                                      [&](std::string_view name) { return is_numbered(file, name); });
    if (numbered) ours.push_back(std::move(file));
  }
  if (error) return Error{ErrorCode::io, text("cannot list the folder ", path, ": ", error.message())};
  return owned->check(ours, rule.overwrite(), rule);
}

PictureFolder::PictureFolder(std::string path, std::vector<std::string_view> names, const OutputRule& rule,
                             MadeFolder parents, ScratchFolder scratch)
    : path_(std::move(path)),
      names_(std::move(names)),
      rule_(rule),
      parents_(std::move(parents)),
      scratch_(std::move(scratch)) {}

Result<PictureFolder> PictureFolder::create(const std::string& given,
                                            const std::vector<std::string_view>& names,
                                            const OutputRule& rule) {
  if (auto r = check(given, names, rule); !r) return r.error();
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(given, error), error);
  if (error) return Error{ErrorCode::io, text("cannot make the folder ", given, ": ", error.message())};
  // "a/b/" is the folder b.
  const std::string path = (whole.filename().empty() ? whole.parent_path() : whole).string();
  auto parents = MadeFolder::create(fs::path(path).parent_path().string());
  if (!parents) return parents.error();
  // In a folder that is there: it may be another disk than the one above it.
  auto scratch = ScratchFolder::create(fs::is_directory(whole, error) ? text(path, "/pictures") : path);
  if (!scratch) return scratch.error();
  return PictureFolder(path, names, rule, *std::move(parents), *std::move(scratch));
}

Result<void> PictureFolder::write(std::string_view name, uint64_t index, const PictureView& picture) {
  std::string file = numbered_picture(name, index);
  const auto bytes = encoded(file, picture);
  if (!bytes) return bytes.error();
  if (auto r = write_new_file(scratch_.file(file), *bytes); !r) return r;
  files_.push_back(std::move(file));
  return {};
}

Result<void> PictureFolder::finish(std::string_view list) {
  if (auto r = write_new_file(scratch_.file(kPictureList), list); !r) return r;
  files_.emplace_back(kPictureList);
  if (auto r = check(path_, names_, rule_); !r) return Error{ErrorCode::io, r.error().message};
  std::error_code ignored;
  if (fs::is_directory(path_, ignored)) {
    return OwnedFiles::replace(path_, std::string(kListName), scratch_, files_, rule_.overwrite(), rule_);
  }
  if (auto r = OwnedFiles::list(scratch_, files_); !r) return r;
  return scratch_.become(path_);
}

}  // namespace scarf
