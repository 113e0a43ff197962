// Pictures as OpenCV has them.
#pragma once

#include <opencv2/core.hpp>

#include "output/picture.h"

namespace scarf {

/// The same pixels, not copied.
inline cv::Mat as_mat(const PictureView& picture) {
  return std::visit(
      [&](const auto pixels) {
        using T = typename decltype(pixels)::value_type;
        return cv::Mat(picture.size.height, picture.size.width, cv::DataType<T>::type,
                       const_cast<T*>(pixels.data()));
      },
      picture.pixels);
}

}  // namespace scarf
