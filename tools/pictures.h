// Pictures as files.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scarf/image.h"
#include "scarf/result.h"

namespace scarf::tools {

/// The pixels of an image with one plane, not copied: the image must outlive the result.
cv::Mat as_picture(const Image<uint8_t>& image);
cv::Mat as_picture(const Image<float>& image);

/// Writes an image file of the kind that the name's extension says. Errors: io.
Result<void> write_picture(const std::string& path, const cv::Mat& picture);

/// "NAME_000012.png": sorted by name is sorted by index.
std::string numbered_picture(std::string_view name, uint64_t index);

/// Makes the folder if it is not there; else removes numbered pictures of these names from it, and the list
/// of them. Errors: io.
Result<void> make_picture_folder(const std::string& path, const std::vector<std::string_view>& names);

/// The list of the pictures in a folder.
inline constexpr std::string_view kPictureList = "frames.csv";

}  // namespace scarf::tools
