// Pictures beside each other, each under its label.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace scarf::tools {

struct Tile {
  std::string label;
  cv::Mat picture;  ///< 8 bits, one channel; all of one size
};

/// The tiles row by row, as nearly square as their number allows; up to three stand in one row. Their pixels
/// are unchanged.
cv::Mat mosaic(const std::vector<Tile>& tiles);

}  // namespace scarf::tools
