// Histograms of averaged time surfaces. Source: Sironi et al., "HATS: Histograms of Averaged Time Surfaces
// for Robust Event-based Object Classification", CVPR 2018.
#include <algorithm>

#include "cpu_ref/encodings.h"

namespace scarf {
namespace {

// Times of the events of each polarity and pixel, ascending.
class Memory {
 public:
  explicit Memory(const EncoderInput& input) : times_(input.sensor.width, input.sensor.height, 2) {
    for (const Event& e : input.events) at(times_, e.x, e.y, polarity_plane(e)).push_back(e.t);
    for (auto& times : times_.pixels) std::sort(times.begin(), times.end());
  }

  // Sum over the events of a pixel that are older than t, but not by more than `window`.
  int64_t decayed_sum(int32_t x, int32_t y, int32_t polarity, int64_t t, const HatsParameters& p) const {
    const auto& times = times_.at(x, y, polarity);
    auto it = std::lower_bound(times.begin(), times.end(), t);
    int64_t sum = 0;
    while (it != times.begin() && age(t, *std::prev(it)) <= static_cast<uint64_t>(p.window)) {
      --it;
      sum += decay_weight(age(t, *it), p.tau);
    }
    return sum;
  }

 private:
  Image<std::vector<int64_t>> times_;
};

}  // namespace

Image<float> encode_as(const HatsParameters& p, const EncoderInput& input) {
  const Memory memory(input);
  const int32_t side = 2 * p.radius + 1;
  // A sum overflows beyond 2^39 pairs of events; counting those would take hours.
  auto sums = input.image<int64_t>();
  Image<int64_t> counts(input.shape.width, input.shape.height);
  for (const Event& e : input.events) {
    const int32_t column = e.x / p.cell;
    const int32_t row = e.y / p.cell;
    at(counts, column, row, 0) += 1;
    // Cells do not see each other's events. Beyond the sensor there are none.
    const auto cell = [&p](int32_t i, int32_t size) {
      return PixelRange{i * p.cell, std::min(size, (i + 1) * p.cell)};
    };
    const PixelRange columns = neighbours(e.x, p.radius, cell(column, input.sensor.width));
    const PixelRange rows = neighbours(e.y, p.radius, cell(row, input.sensor.height));
    for (int32_t y = rows.begin; y < rows.end; ++y) {
      for (int32_t x = columns.begin; x < columns.end; ++x) {
        const int32_t plane = (polarity_plane(e) * side + y - e.y + p.radius) * side + x - e.x + p.radius;
        at(sums, column, row, plane) += memory.decayed_sum(x, y, polarity_plane(e), e.t, p);
      }
    }
  }
  return cell_means(sums, counts);
}

}  // namespace scarf
