// What the simulated camera watches: shapes that move over a background. Everything is a function of time.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scarf/core/event.h"

namespace scarf::simulate {

/// Pixels; pixel (x, y) of the sensor is the square [x, x+1) x [y, y+1).
struct Point {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// To and fro between two points at constant speed; rests before `start` and stays where it is from `stop`
/// on. Times in seconds.
struct Motion {
  Point from;
  Point to;
  double pass = 1;  ///< time from one point to the other
  double start = 0;
  double stop = 0;

  Point at(double t) const;
  double speed() const;  ///< pixels per second while it moves
};

/// A surface: `brightness` (1 = white) plus a texture of that amplitude.
struct Paint {
  double brightness = 0.5;
  double texture = 0;
};

/// From a corner of a polygon to the next, with what every distance to it needs.
struct Edge {
  Point corner;
  Point along;  ///< to the next corner
  double next_y = 0;
  double inverse_square = 0;
  double run_by_rise = 0;
};

/// A disc, or a polygon if it has an outline.
struct Shape {
  Motion motion;
  Paint paint;
  Point reach;  ///< how far it extends to either side of its centre; for a disc the radius
  std::vector<Edge> outline;

  /// Distance of a point (relative to the centre) to the outline, negative inside.
  double signed_distance(Point p) const;
};

/// Shift of the camera: two waves of different frequency in x and y.
struct Shake {
  double amplitude = 0;  ///< pixels
  double start = 0;      ///< seconds

  Point at(double t) const;
  double max_speed() const;  ///< pixels per second
};

struct Scene {
  Paint background;
  std::vector<Shape> shapes;  ///< later ones hide earlier ones
  Shake shake;

  /// The longest step from t on, in seconds, in which nothing moves more than `distance` pixels, starts or
  /// stops; infinite at rest.
  double longest_step(double t, double distance) const;
};

Shape disc(double radius, Paint paint, Motion motion);
/// Corners in order, relative to the centre.
Shape polygon(std::vector<Point> corners, Paint paint, Motion motion);

/// The names and the scenes; nullptr if there is none of that name. Sizes and ways scale with the sensor.
using SceneMaker = Scene (*)(SensorSize sensor, double duration);
std::vector<std::string_view> names();
SceneMaker scene_maker(std::string_view name);

}  // namespace scarf::simulate
