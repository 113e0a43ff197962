#include "simulate/view.h"

#include <algorithm>
#include <cmath>

namespace scarf::simulate {
namespace {

constexpr uint64_t kTextureSeed = 7;

Box intersection(Box a, Box b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

Box hull(Box a, Box b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// The part of a pixel that a shape covers whose outline is at that distance from the pixel's centre.
double coverage(double signed_distance) {
  return std::clamp(0.5 - signed_distance, 0.0, 1.0);
}

}  // namespace

View::View(SensorSize sensor, Scene scene)
    : sensor_(sensor), scene_(std::move(scene)), texture_(kTextureSeed) {}

Point View::centre(const Shape& shape, double t) const {
  const Point p = shape.motion.at(t);
  const Point camera = scene_.shake.at(t);
  return {p.x - camera.x, p.y - camera.y};
}

Box View::touched(const Shape& shape, Point centre) const {
  const auto pixel = [](double v, int32_t size) {
    return static_cast<int32_t>(std::clamp(std::floor(v), 0.0, static_cast<double>(size)));
  };
  return {pixel(centre.x - shape.reach.x - 1, sensor_.width),
          pixel(centre.y - shape.reach.y - 1, sensor_.height),
          pixel(centre.x + shape.reach.x + 2, sensor_.width),
          pixel(centre.y + shape.reach.y + 2, sensor_.height)};
}

std::vector<Box> View::changed(double t0, double t1) const {
  if (scene_.shake.at(t0) != scene_.shake.at(t1)) return {whole()};
  std::vector<Box> boxes;
  for (const Shape& shape : scene_.shapes) {
    const Point before = centre(shape, t0);
    const Point after = centre(shape, t1);
    if (before == after) continue;
    const Box box = hull(touched(shape, before), touched(shape, after));
    if (!box.empty()) boxes.push_back(box);
  }
  return boxes;
}

void View::render(Box box, double t, std::vector<uint16_t>& out) {
  const size_t width = box.x1 - box.x0;
  const auto index = [&](int32_t x, int32_t y) { return (y - box.y0) * width + (x - box.x0); };
  light_.assign(width * (box.y1 - box.y0), scene_.background.brightness);
  if (const double amplitude = scene_.background.texture; amplitude > 0) {
    const Point camera = scene_.shake.at(t);
    for (int32_t y = box.y0; y < box.y1; ++y) {
      for (int32_t x = box.x0; x < box.x1; ++x) {
        light_[index(x, y)] += amplitude * (2 * texture_.at(x + camera.x, y + camera.y) - 1);
      }
    }
  }
  for (const Shape& shape : scene_.shapes) {
    const Point c = centre(shape, t);
    const Box b = intersection(box, touched(shape, c));
    for (int32_t y = b.y0; y < b.y1; ++y) {
      for (int32_t x = b.x0; x < b.x1; ++x) {
        const Point p = {x + 0.5 - c.x, y + 0.5 - c.y};
        const double part = coverage(shape.signed_distance(p));
        if (part == 0) continue;
        double paint = shape.paint.brightness;
        if (shape.paint.texture > 0) paint += shape.paint.texture * (2 * texture_.at(p.x, p.y) - 1);
        double& light = light_[index(x, y)];
        light += part * (paint - light);
      }
    }
  }
  out.resize(light_.size());
  for (size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<uint16_t>(std::clamp(light_[i], 0.0, 1.0) * 65535 + 0.5);
  }
}

Image<uint8_t> View::edges(double t) const {
  Image<uint8_t> image(sensor_.width, sensor_.height);
  for (const Shape& shape : scene_.shapes) {
    const Point c = centre(shape, t);
    const Box b = touched(shape, c);
    for (int32_t y = b.y0; y < b.y1; ++y) {
      for (int32_t x = b.x0; x < b.x1; ++x) {
        const double distance = shape.signed_distance({x + 0.5 - c.x, y + 0.5 - c.y});
        uint8_t& pixel = image.pixels[static_cast<size_t>(y) * sensor_.width + x];
        // What lies below a shape is hidden.
        if (distance <= 0.5) pixel = distance > -0.5 ? 255 : 0;
      }
    }
  }
  return image;
}

}  // namespace scarf::simulate
