#include "tools/pictures.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "core/text.h"
#include "tools/files.h"

namespace scarf::tools {
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

}  // namespace

cv::Mat as_picture(const Image<uint8_t>& image) {
  return {image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.pixels.data())};
}

cv::Mat as_picture(const Image<float>& image) {
  return {image.height, image.width, CV_32FC1, const_cast<float*>(image.pixels.data())};
}

Result<void> write_picture(const std::string& path, const cv::Mat& picture) {
  std::vector<uint8_t> bytes;
  if (!cv::imencode(fs::path(path).extension().string(), picture, bytes)) {
    return Error{ErrorCode::io, text("OpenCV cannot encode ", path, "; install OpenCV with PNG and PGM")};
  }
  return write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string numbered_picture(std::string_view name, uint64_t index) {
  std::string digits = std::to_string(index);
  if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
  return text(name, "_", digits, kExtension);
}

Result<void> make_picture_folder(const std::string& path, const std::vector<std::string_view>& names) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return Error{ErrorCode::io, text("cannot make the folder ", path, ": ", error.message())};
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const std::string file = entry.path().filename().string();
    const bool numbered = std::any_of(names.begin(), names.end(),
                                      [&](std::string_view name) { return is_numbered(file, name); });
    if (numbered || file == kPictureList) old.push_back(entry.path());
  }
  for (const fs::path& file : old) {
    if (!error) fs::remove(file, error);
  }
  if (error) return Error{ErrorCode::io, text("cannot empty the folder ", path, ": ", error.message())};
  return {};
}

}  // namespace scarf::tools
