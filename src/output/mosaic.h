// Pictures beside each other, each under its label.
#pragma once

#include <string>
#include <vector>

#include "output/picture.h"

namespace scarf {

struct Tile {
  std::string label;
  PictureView picture;  ///< 8 bits; all of one size
};

/// The tiles row by row, as nearly square as their number allows; up to three stand in one row. Their pixels
/// are unchanged.
Image<uint8_t> mosaic(const std::vector<Tile>& tiles);

}  // namespace scarf
