// The encodings, one file each, and the arithmetic that they share. Weights are integers in units of 2^-24.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/encoding_tables.h"
#include "scarf/core/encoding.h"

namespace scarf {

/// Plane order: ON before OFF, as networks have it.
inline int32_t polarity_plane(const Event& e) {
  return e.p == 1 ? 0 : 1;
}

/// t - earlier, for any two times in order.
inline uint64_t age(int64_t t, int64_t earlier) {
  return static_cast<uint64_t>(t) - static_cast<uint64_t>(earlier);
}

/// The time from the first to the last event, in units of 2^unit microseconds. `unit` is the smallest one
/// that makes the length less than 2^40: then every step of rounded_weight fits 64 bits. It is 0 up to 12
/// days.
class TimeSpan {
 public:
  TimeSpan(int64_t first, int64_t last)
      : first_(first),
        unit_(std::max(0, static_cast<int>(std::bit_width(age(last, first))) - 40)),
        length_(since_first(last)) {}

  uint64_t since_first(int64_t t) const { return age(t, first_) >> unit_; }
  uint64_t length() const { return length_; }

 private:
  int64_t first_;
  int unit_;
  uint64_t length_;
};

/// numerator / denominator as a weight, rounded half to even. 0 <= numerator <= denominator < 2^40.
inline int64_t rounded_weight(uint64_t numerator, uint64_t denominator) {
  const uint64_t scaled = numerator << kWeightBits;
  const uint64_t quotient = scaled / denominator;
  const uint64_t twice = 2 * (scaled % denominator);
  const bool up = twice > denominator || (twice == denominator && quotient % 2 == 1);
  return static_cast<int64_t>(quotient + (up ? 1 : 0));
}

/// A sum of weights as a number: one rounding, to the nearest float, half to even; the scale is exact.
inline float weight_value(int64_t sum) {
  return std::ldexp(static_cast<float>(sum), -kWeightBits);
}

/// Sums of weights over the numbers of events of the cells (one plane, for all planes of sums); 0 where a
/// cell has none. Divided in double.
Image<float> cell_means(const Image<int64_t>& sums, const Image<int64_t>& counts);

/// Where the encodings write: planes of integers or floats, addressed as (x, y, plane).
template <class T>
T& at(Image<T>& image, int32_t x, int32_t y, int32_t plane) {
  return image.pixels[(static_cast<size_t>(plane) * image.height + y) * image.width + x];
}

/// The pixels begin .. end - 1 of one axis.
struct PixelRange {
  int32_t begin = 0;
  int32_t end = 0;
};

/// The pixels of `range` that are at most `radius` away.
inline PixelRange neighbours(int32_t pixel, int32_t radius, PixelRange range) {
  return {std::max(range.begin, pixel - radius), std::min(range.end, pixel + radius + 1)};
}

/// Events inside the sensor, in any order, with the smallest and the largest time.
struct EncoderInput {
  SensorSize sensor;
  EncodingShape shape;
  std::vector<Event> events;
  int64_t t_first = 0;
  int64_t t_last = 0;

  template <class T>
  Image<T> image() const {
    return Image<T>(shape.width, shape.height, shape.planes);
  }
};

Image<float> encode_as(const VoxelGridParameters& parameters, const EncoderInput& input);
Image<float> encode_as(const ToreParameters& parameters, const EncoderInput& input);
Image<float> encode_as(const EventImageParameters& parameters, const EncoderInput& input);
Image<float> encode_as(const TimeSurfaceParameters& parameters, const EncoderInput& input);
Image<float> encode_as(const HatsParameters& parameters, const EncoderInput& input);
Image<float> encode_as(const HotsParameters& parameters, const EncoderInput& input);

}  // namespace scarf
