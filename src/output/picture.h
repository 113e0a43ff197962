// A picture on its way to a file: pixels that somebody else owns.
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "scarf/core/event.h"
#include "scarf/core/image.h"

namespace scarf {

/// One channel of 8 bits or of floats, row-major without gaps. What it was made of must outlive it.
struct PictureView {
  SensorSize size;
  std::variant<std::span<const uint8_t>, std::span<const float>> pixels;

  PictureView(SensorSize s, std::span<const uint8_t> p) : size(s), pixels(p) {}
  /// The first plane of an image.
  template <class T>
  PictureView(const Image<T>& image)  // NOLINT(google-explicit-constructor): every image is a picture
      : size{image.width, image.height},
        pixels(std::span<const T>(image.pixels).first(static_cast<size_t>(image.width) * image.height)) {}

  bool floats() const { return std::holds_alternative<std::span<const float>>(pixels); }
};

}  // namespace scarf
