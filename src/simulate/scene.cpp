#include "simulate/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarf::simulate {
namespace {

constexpr double kShakeHzX = 5;
constexpr double kShakeHzY = 7;

double length(Point p) {
  return std::sqrt(p.x * p.x + p.y * p.y);
}

// Two parabolas per cycle: a sine to the eye, and the same on every platform.
double wave(double cycles) {
  const double u = cycles - std::floor(cycles);
  return u < 0.5 ? 16 * u * (0.5 - u) : -16 * (u - 0.5) * (1 - u);
}
constexpr double kMaxWaveSlope = 8;

// Corners of a rectangle, tilted by the angle whose tangent is `slope`.
std::vector<Point> rectangle(double width, double height, double slope = 0) {
  const double c = 1 / std::sqrt(1 + slope * slope);
  const double s = slope * c;
  const double x = width / 2;
  const double y = height / 2;
  const auto turned = [&](double px, double py) { return Point{c * px - s * py, s * px + c * py}; };
  return {turned(-x, -y), turned(x, -y), turned(x, y), turned(-x, y)};
}

std::vector<Point> triangle(double radius) {
  return {{0, -radius}, {0.866 * radius, 0.5 * radius}, {-0.866 * radius, 0.5 * radius}};
}

std::vector<Point> star(double radius) {
  // Outer and inner corners of a five-pointed star on the unit circle.
  const std::vector<Point> unit = {{0, -1},          {0.235, -0.324}, {0.951, -0.309}, {0.380, 0.124},
                                   {0.588, 0.809},   {0, 0.4},        {-0.588, 0.809}, {-0.380, 0.124},
                                   {-0.951, -0.309}, {-0.235, -0.324}};
  std::vector<Point> corners;
  for (const Point& p : unit) corners.push_back({p.x * radius, p.y * radius});
  return corners;
}

// Places in parts of the sensor, sizes in pixels of the default sensor.
struct Canvas {
  SensorSize sensor;
  double duration;

  double scaled(double pixels) const { return pixels * std::min(sensor.width, sensor.height) / 260; }
  Point place(double x, double y) const { return {x * sensor.width, y * sensor.height}; }
  Motion move(Point from, Point to, double pass) const {
    return {place(from.x, from.y), place(to.x, to.y), pass, 0, duration};
  }
  Motion rest(double x, double y) const { return {place(x, y), place(x, y), 1, 0, 0}; }
};

Scene stop(SensorSize sensor, double duration) {
  const Canvas c = {sensor, duration};
  Motion stopping = c.move({0.14, 0.30}, {0.44, 0.42}, duration / 2);
  stopping.stop = duration / 2;
  Scene scene;
  scene.background = {0.35, 0.15};
  scene.shapes = {
      polygon(triangle(c.scaled(30)), {0.10, 0.05}, c.move({0.86, 0.20}, {0.76, 0.22}, 4)),
      polygon(rectangle(c.scaled(14), c.scaled(84), 0.3), {0.85, 0}, c.move({0.64, 0.38}, {0.92, 0.46}, 1)),
      polygon(rectangle(c.scaled(28), c.scaled(28), 0.5), {0.75, 0.2},
              c.move({0.16, 0.67}, {0.60, 0.67}, 0.7)),
      disc(c.scaled(38), {0.70, 0.25}, stopping),
      polygon(star(c.scaled(32)), {0.08, 0}, c.move({0.14, 0.84}, {0.86, 0.84}, 0.35)),
  };
  return scene;
}

Scene speeds(SensorSize sensor, double duration) {
  const Canvas c = {sensor, duration};
  Scene scene;
  scene.background = {0.30, 0};
  const double passes[] = {15, 5, 1.5, 0.5, 0.15};
  double y = 0.1;
  for (const double pass : passes) {
    scene.shapes.push_back(polygon(rectangle(0.035 * sensor.width, 0.15 * sensor.height), {0.85, 0},
                                   c.move({0.08, y}, {0.92, y}, pass)));
    y += 0.2;
  }
  return scene;
}

Scene shake(SensorSize sensor, double duration) {
  const Canvas c = {sensor, duration};
  Scene scene;
  scene.background = {0.40, 0.30};
  scene.shapes = {
      disc(c.scaled(45), {0.80, 0.15}, c.rest(0.28, 0.36)),
      polygon(star(c.scaled(50)), {0.08, 0.04}, c.rest(0.70, 0.35)),
      polygon(rectangle(c.scaled(170), c.scaled(18), -0.15), {0.90, 0}, c.rest(0.40, 0.78)),
      polygon(triangle(c.scaled(34)), {0.12, 0}, c.rest(0.82, 0.78)),
  };
  scene.shake = {c.scaled(6), duration / 2};
  return scene;
}

constexpr std::pair<std::string_view, SceneMaker> kScenes[] = {
    {"stop", stop}, {"speeds", speeds}, {"shake", shake}};

}  // namespace

Point Motion::at(double t) const {
  const double passes = (std::clamp(t, start, std::max(start, stop)) - start) / pass;
  const double whole = std::floor(passes);
  double part = passes - whole;
  if (std::fmod(whole, 2) == 1) part = 1 - part;
  return {from.x + (to.x - from.x) * part, from.y + (to.y - from.y) * part};
}

double Motion::speed() const {
  return length({to.x - from.x, to.y - from.y}) / pass;
}

double Shape::signed_distance(Point p) const {
  if (outline.empty()) return length(p) - reach.x;
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (const Edge& e : outline) {
    const Point to_p = {p.x - e.corner.x, p.y - e.corner.y};
    const double part = std::clamp((to_p.x * e.along.x + to_p.y * e.along.y) * e.inverse_square, 0.0, 1.0);
    const Point away = {to_p.x - e.along.x * part, to_p.y - e.along.y * part};
    nearest = std::min(nearest, away.x * away.x + away.y * away.y);
    // A ray to the right crosses the outline an odd number of times from inside. Both edges at a corner
    // compare the same numbers, so that a ray through it counts once.
    const bool passed = (p.y < e.corner.y) != (p.y < e.next_y);
    inside ^= passed && to_p.x < e.run_by_rise * to_p.y;
  }
  return inside ? -std::sqrt(nearest) : std::sqrt(nearest);
}

Point Shake::at(double t) const {
  if (t <= start) return {};
  return {amplitude * wave((t - start) * kShakeHzX), amplitude * wave((t - start) * kShakeHzY)};
}

double Shake::max_speed() const {
  return amplitude * kMaxWaveSlope * length({kShakeHzX, kShakeHzY});
}

double Scene::longest_step(double t, double distance) const {
  double fastest = 0;  // sum of the camera's speed and that of the fastest shape
  double next_change = std::numeric_limits<double>::infinity();
  for (const Shape& shape : shapes) {
    const Motion& m = shape.motion;
    if (t < m.start) {
      next_change = std::min(next_change, m.start);
    } else if (t < m.stop) {
      fastest = std::max(fastest, m.speed());
      next_change = std::min(next_change, m.stop);
    }
  }
  if (t < shake.start) {
    next_change = std::min(next_change, shake.start);
  } else {
    fastest += shake.max_speed();
  }
  return std::min(distance / fastest, next_change - t);
}

Shape disc(double radius, Paint paint, Motion motion) {
  return {motion, paint, {radius, radius}, {}};
}

Shape polygon(std::vector<Point> corners, Paint paint, Motion motion) {
  Shape shape = {motion, paint, {}, {}};
  for (size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i];
    const Point b = corners[(i + 1) % corners.size()];
    const Point along = {b.x - a.x, b.y - a.y};
    shape.outline.push_back({a, along, b.y, 1 / (along.x * along.x + along.y * along.y),
                             along.y == 0 ? 0 : along.x / along.y});  // a level edge is never passed
    shape.reach = {std::max(shape.reach.x, std::abs(a.x)), std::max(shape.reach.y, std::abs(a.y))};
  }
  return shape;
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const auto& [name, maker] : kScenes) all.push_back(name);
  return all;
}

SceneMaker scene_maker(std::string_view name) {
  for (const auto& [known, maker] : kScenes) {
    if (known == name) return maker;
  }
  return nullptr;
}

}  // namespace scarf::simulate
