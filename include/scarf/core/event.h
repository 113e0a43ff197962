// Events: what a camera sends, and what every representation stores and hands back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace scarf {

/// One brightness change of one pixel. 16 bytes, so that arrays of events can be shared with a GPU as they
/// are.
struct Event {
  int64_t t = 0;   ///< time in microseconds; any origin, small back-steps are legal
  uint16_t x = 0;  ///< pixel column, 0 = left
  uint16_t y = 0;  ///< pixel row, 0 = top
  uint8_t p = 0;   ///< polarity: 1 = brighter (ON), 0 = darker (OFF); nothing else is legal
  uint8_t padding[3] = {0, 0, 0};

  friend bool operator==(const Event& a, const Event& b) {
    return a.t == b.t && a.x == b.x && a.y == b.y && a.p == b.p;
  }
};
static_assert(sizeof(Event) == 16 && std::is_trivially_copyable_v<Event>);
static_assert(offsetof(Event, x) == 8 && offsetof(Event, p) == 12);  // the shaders read these offsets

/// Size of a sensor in pixels.
struct SensorSize {
  int32_t width = 0;
  int32_t height = 0;

  bool contains(const Event& e) const { return e.x < width && e.y < height; }
  friend bool operator==(const SensorSize&, const SensorSize&) = default;
};

}  // namespace scarf
