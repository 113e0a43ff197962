// What the references of the representations share: the sensor, the lock, checked batches, and pictures from
// numbers per pixel. All of them take one event after the other, in the order in which they arrived.
#pragma once

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/batch_check.h"
#include "core/event_bytes.h"
#include "core/queries.h"
#include "scarf/core/representation.h"

namespace scarf {

class Surface : public Representation {
 public:
  explicit Surface(SensorSize sensor) : sensor_(sensor) {}

  SensorSize sensor() const final { return sensor_; }

  Result<PushReport> push(std::span<const Event> events) final {
    return locked([&]() -> Result<PushReport> {
      if (incomplete_) return incomplete();
      const auto batch = check_batch(events, sensor_, t_first_);
      if (!batch) return batch.error();
      incomplete_ = true;  // until all events are in: there may be no memory for one
      t_first_ = batch->t_first;
      for (const Event& e : events) {
        if (sensor_.contains(e)) update(e);
      }
      incomplete_ = false;
      return PushReport{events.size(), batch->outside};
    });
  }

  Result<void> reset() final {
    return locked([&]() -> Result<void> {
      incomplete_ = true;
      t_first_.reset();
      clear();
      incomplete_ = false;
      return {};
    });
  }

  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) final {
    return query([&]() -> Pending<Image<uint8_t>> { return u8_picture(now); });
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) final {
    return query([&]() -> Pending<Image<float>> { return float_picture(now); });
  }
  Pending<Image<int64_t>> raw_image() final {
    return query([&]() -> Pending<Image<int64_t>> { return raw_picture(); });
  }
  Pending<std::vector<Event>> events() final {
    return query([&]() -> Pending<std::vector<Event>> { return kept_events(); });
  }
  Pending<std::vector<uint8_t>> state() final {
    return query([&]() -> Pending<std::vector<uint8_t>> { return state_bytes(); });
  }

 protected:
  // What a representation is. The lock is held while one of these runs; e lies inside the sensor. A picture
  // that runs out of memory has changed nothing.
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
  template <class Call>
  std::invoke_result_t<Call&> locked(Call call) {
    return as_result([&] {
      std::lock_guard lock(mutex_);
      return call();
    });
  }
  template <class Call>
  std::invoke_result_t<Call&> query(Call call) {
    return locked([&]() -> std::invoke_result_t<Call&> {
      if (incomplete_) return incomplete();
      return call();
    });
  }
  static Error incomplete() {
    return {ErrorCode::out_of_memory, "the state is incomplete, since a push ran out of memory; reset it"};
  }

  const SensorSize sensor_;
  std::mutex mutex_;
  std::optional<int64_t> t_first_;
  bool incomplete_ = false;  // until reset
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
