// Time surfaces of single events, averaged over cells. Source: Lagorce et al., "HOTS: A Hierarchy of
// Event-Based Time-Surfaces for Pattern Recognition", 2017.
#include <algorithm>
#include <optional>

#include "cpu_ref/encodings.h"

namespace scarf {

Image<float> encode_as(const HotsParameters& p, const EncoderInput& input) {
  std::vector<Event> events = input.events;
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });

  const int32_t side = 2 * p.radius + 1;
  Image<std::optional<int64_t>> last(input.sensor.width, input.sensor.height, 2);
  auto sums = input.image<int64_t>();
  Image<int64_t> counts(input.shape.width, input.shape.height);

  const auto add_surface = [&](const Event& e) {
    const int32_t column = e.x / p.cell;
    const int32_t row = e.y / p.cell;
    at(counts, column, row, 0) += 1;
    const PixelRange columns = neighbours(e.x, p.radius, {0, input.sensor.width});
    const PixelRange rows = neighbours(e.y, p.radius, {0, input.sensor.height});
    for (int32_t polarity = 0; polarity < 2; ++polarity) {
      for (int32_t y = rows.begin; y < rows.end; ++y) {
        for (int32_t x = columns.begin; x < columns.end; ++x) {
          const std::optional<int64_t> t = last.at(x, y, polarity);
          if (!t) continue;
          const int32_t plane = (polarity * side + y - e.y + p.radius) * side + x - e.x + p.radius;
          at(sums, column, row, plane) += decay_weight(age(e.t, *t), p.tau);
        }
      }
    }
  };

  // Events of the same time see each other, so their order does not matter.
  for (auto begin = events.begin(); begin != events.end();) {
    const auto end = std::find_if(begin, events.end(), [&](const Event& e) { return e.t != begin->t; });
    std::for_each(begin, end, [&](const Event& e) { at(last, e.x, e.y, polarity_plane(e)) = e.t; });
    std::for_each(begin, end, add_surface);
    begin = end;
  }
  return cell_means(sums, counts);
}

}  // namespace scarf
