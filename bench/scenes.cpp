#include "bench/scenes.h"

#include <cstdint>

namespace scarf::bench {
namespace {

constexpr int32_t kBars = 20;
constexpr size_t kEventsPerSecond = 25'000'000;

// xorshift64*: the same numbers with every compiler and library.
class Random {
 public:
  int32_t below(int32_t n) {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<int32_t>((state_ * 0x2545F4914F6CDD1Du >> 33) % static_cast<uint32_t>(n));
  }

 private:
  uint64_t state_ = 20260101;
};

// A pixel of one of the bars at event i: bar b moves b + 1 sensor widths per 100 s, and slants by its number.
int32_t bar_column(Random& random, SensorSize sensor, int32_t y, size_t i) {
  const int32_t bar = random.below(kBars);
  const int64_t start = int64_t{bar} * sensor.width / kBars;
  const auto travelled =
      static_cast<int64_t>(i) * (bar + 1) * sensor.width / static_cast<int64_t>(100 * kEventsPerSecond / 25);
  const int64_t slant = int64_t{y} * (bar % 7 - 3) / 8;
  const int64_t x = (start + travelled + slant + random.below(2)) % sensor.width;
  return static_cast<int32_t>(x < 0 ? x + sensor.width : x);
}

}  // namespace

std::string_view scene_name(Scene scene) {
  switch (scene) {
    case Scene::edges:
      return "edges";
    case Scene::uniform:
      return "uniform";
    case Scene::hot_spot:
      return "hot_spot";
    case Scene::one_tile:
      return "one_tile";
    case Scene::single_pixel:
      return "single_pixel";
  }
  return "unknown";
}

std::vector<Event> make_scene(Scene scene, SensorSize sensor, size_t count) {
  Random random;
  std::vector<Event> events(count);
  for (size_t i = 0; i < count; ++i) {
    int32_t x = random.below(sensor.width);
    int32_t y = random.below(sensor.height);
    const int32_t polarity = random.below(2);
    switch (scene) {
      case Scene::edges:
        if (i % 20 != 0) x = bar_column(random, sensor, y, i);
        break;
      case Scene::uniform:
        break;
      case Scene::hot_spot:
        if (i % 2 == 0) {
          x = sensor.width / 2 + random.below(8);
          y = sensor.height / 2 + random.below(8);
        }
        break;
      case Scene::one_tile:
        x = sensor.width / 2 + random.below(8);
        y = sensor.height / 2 + random.below(8);
        break;
      case Scene::single_pixel:
        x = sensor.width / 2;
        y = sensor.height / 2;
        break;
    }
    const auto t = static_cast<int64_t>(i * 1'000'000 / kEventsPerSecond);
    events[i] = {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), static_cast<uint8_t>(polarity), {}};
  }
  return events;
}

}  // namespace scarf::bench
