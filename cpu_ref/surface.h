// What the references of the representations share: the sensor, the lock, checked batches, and pictures from
// numbers per pixel. All of them take one event after the other, in the order in which they arrived.
#pragma once

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/batch_check.h"
#include "core/event_bytes.h"
#include "core/queries.h"
#include "scarf/representation.h"

namespace scarf {

class Surface : public Representation {
 public:
  explicit Surface(SensorSize sensor) : sensor_(sensor) {}

  SensorSize sensor() const final { return sensor_; }

  Result<PushReport> push(std::span<const Event> events) final {
    std::lock_guard lock(mutex_);
    const auto batch = check_batch(events, sensor_, t_first_);
    if (!batch) return batch.error();
    t_first_ = batch->t_first;
    for (const Event& e : events) {
      if (sensor_.contains(e)) update(e);
    }
    return PushReport{events.size(), batch->outside};
  }

  Result<void> reset() final {
    std::lock_guard lock(mutex_);
    t_first_.reset();
    clear();
    return {};
  }

  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) final {
    std::lock_guard lock(mutex_);
    return u8_picture(now);
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) final {
    std::lock_guard lock(mutex_);
    return float_picture(now);
  }
  Pending<Image<int64_t>> raw_image() final {
    std::lock_guard lock(mutex_);
    return raw_picture();
  }
  Pending<std::vector<Event>> events() final {
    std::lock_guard lock(mutex_);
    return kept_events();
  }
  Pending<std::vector<uint8_t>> state() final {
    std::lock_guard lock(mutex_);
    return state_bytes();
  }

 protected:
  // What a representation is. The lock is held while one of these runs; e lies inside the sensor.
  virtual void update(const Event& e) = 0;
  virtual void clear() = 0;
  virtual Image<uint8_t> u8_picture(std::optional<int64_t> now) = 0;
  virtual Image<float> float_picture(std::optional<int64_t> now) = 0;
  virtual Image<int64_t> raw_picture() = 0;
  virtual Result<std::vector<Event>> kept_events() const { return no_events(); }
  virtual std::vector<uint8_t> state_bytes() const = 0;

  size_t pixels() const { return static_cast<size_t>(sensor_.width) * sensor_.height; }
  size_t pixel(const Event& e) const { return static_cast<size_t>(e.y) * sensor_.width + e.x; }

  // The picture of a number per pixel (and plane) by `function`.
  template <class T, class Number, class Function>
  Image<T> picture(const std::vector<Number>& numbers, Function function) const {
    Image<T> image(sensor_.width, sensor_.height, static_cast<int32_t>(numbers.size() / pixels()));
    std::transform(numbers.begin(), numbers.end(), image.pixels.begin(), function);
    return image;
  }
  template <class Number>
  Image<int64_t> raw(const std::vector<Number>& numbers) const {
    return picture<int64_t>(numbers, [](Number number) { return static_cast<int64_t>(number); });
  }

 private:
  const SensorSize sensor_;
  std::mutex mutex_;
  std::optional<int64_t> t_first_;
};

// A surface whose pictures are values: 0 = black, 1 = white.
class ValueSurface : public Surface {
 public:
  using Surface::Surface;

 protected:
  virtual std::vector<double> values(std::optional<int64_t> now) = 0;

  // nearbyint rounds half to even in the default rounding mode.
  Image<uint8_t> u8_picture(std::optional<int64_t> now) override {
    return picture<uint8_t>(
        values(now), [](double v) { return static_cast<uint8_t>(std::min(255.0, std::nearbyint(255 * v))); });
  }
  Image<float> float_picture(std::optional<int64_t> now) override {
    return picture<float>(values(now), [](double v) { return static_cast<float>(v); });
  }
};

// Microseconds from t to `now`; 0 for times after `now`. Unsigned, because any two times may be apart by more
// than an int64_t holds.
inline uint64_t age_of(int64_t t, int64_t now) {
  return t < now ? static_cast<uint64_t>(now) - static_cast<uint64_t>(t) : 0;
}

template <class Number>
void append_all(std::vector<uint8_t>& bytes, const std::vector<Number>& numbers) {
  for (const Number number : numbers) append_little_endian(bytes, number);
}

}  // namespace scarf
