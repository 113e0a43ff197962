// One pixel of an event camera: an event whenever its log intensity has changed by a threshold.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace scarf::simulate {

/// Log intensities are integers in units of 2^-20, so that crossings are exact.
inline constexpr int32_t kLogUnit = 1 << 20;

/// Log intensity of each 16-bit intensity, in kLogUnit.
std::vector<int32_t> log_table();

/// Times in microseconds and log intensity at the two ends of a step, linear in between.
struct Segment {
  int64_t t0, t1;
  int32_t log0, log1;

  /// Log intensity at t0 <= t <= t1.
  int32_t at(int64_t t) const { return static_cast<int32_t>(log0 + (t - t0) * (log1 - log0) / (t1 - t0)); }
  /// The first whole microsecond at which `level` is reached, which lies between log0 and log1.
  int64_t reaches(int32_t level) const {
    const int64_t rise = std::int64_t{log1} - log0;
    const int64_t part = (t1 - t0) * (std::int64_t{level} - log0);
    return t0 + (rise > 0 ? part + rise - 1 : -part - rise - 1) / (rise > 0 ? rise : -rise);
  }
};

class Pixel {
 public:
  Pixel(int32_t log, int32_t on_threshold, int32_t off_threshold)
      : reference_(log), on_(on_threshold), off_(off_threshold) {}

  /// Follows the intensity over a step and calls emit(t, polarity) for each event, t0 < t <= t1. Steps in
  /// which the intensity is constant may be left out.
  template <class Emit>
  void follow(const Segment& s, int64_t refractory, Emit emit);

  /// An event that has nothing to do with the intensity; whether the pixel was ready to make it.
  bool fire(int64_t t, int64_t refractory) {
    if (t <= blind_until_) return false;
    if (refractory > 0) blind_until_ = t + refractory;
    return true;
  }

 private:
  static constexpr int64_t kReady = std::numeric_limits<int64_t>::min();

  int64_t blind_until_ = kReady;
  int32_t reference_;  // log intensity at the last event, or at the end of the refractory time after it
  int32_t on_, off_;
};

template <class Emit>
void Pixel::follow(const Segment& s, int64_t refractory, Emit emit) {
  while (true) {
    if (blind_until_ != kReady) {
      if (blind_until_ >= s.t1) return;
      // A pixel is held in reset while it is blind: it compares with what it sees when it wakes up. Where
      // that was before this step, the intensity has been constant since.
      reference_ = blind_until_ <= s.t0 ? s.log0 : s.at(blind_until_);
      blind_until_ = kReady;
    }
    int32_t level = 0;
    if (s.log1 - reference_ >= on_) {
      level = reference_ + on_;
    } else if (reference_ - s.log1 >= off_) {
      level = reference_ - off_;
    } else {
      return;
    }
    const int64_t t = s.reaches(level);
    emit(t, level > reference_);
    reference_ = level;
    if (refractory > 0) blind_until_ = t + refractory;
  }
}

}  // namespace scarf::simulate
