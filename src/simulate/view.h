// Pictures of a scene at any time: what falls on each pixel, and where the outlines are.
#pragma once

#include <cstdint>
#include <vector>

#include "scarf/core/image.h"
#include "simulate/scene.h"
#include "simulate/texture.h"

namespace scarf::simulate {

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct Box {
  int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

class View {
 public:
  View(SensorSize sensor, Scene scene);

  const Scene& scene() const { return scene_; }
  Box whole() const { return {0, 0, sensor_.width, sensor_.height}; }

  /// Where intensities may differ between two times; boxes may overlap.
  std::vector<Box> changed(double t0, double t1) const;
  /// 16-bit intensities (65535 = white) of a box at time t, row-major, anti-aliased.
  void render(Box box, double t, std::vector<uint16_t>& out);
  /// 255 where the visible outline of a shape crosses a pixel.
  Image<uint8_t> edges(double t) const;

 private:
  // The pixels that a shape at `centre` may touch.
  Box touched(const Shape& shape, Point centre) const;
  Point centre(const Shape& shape, double t) const;

  SensorSize sensor_;
  Scene scene_;
  Texture texture_;
  std::vector<double> light_;  // of render(), kept for its memory
};

}  // namespace scarf::simulate
