// Counts and last times. Source: Zhu et al., "EV-FlowNet: Self-Supervised Optical Flow Estimation for
// Event-based Cameras", RSS 2018.
#include <algorithm>

#include "cpu_ref/encodings.h"

namespace scarf {

Image<float> encode_as(const EventImageParameters&, const EncoderInput& input) {
  const TimeSpan span(input.t_first, input.t_last);
  Image<int64_t> counts(input.sensor.width, input.sensor.height, 2);
  auto image = input.image<float>();
  for (const Event& e : input.events) {
    const int32_t plane = polarity_plane(e);
    at(counts, e.x, e.y, plane) += 1;
    // Where all events have the same time, each is the last event.
    const int64_t weight =
        span.length() == 0 ? kWeightOne : rounded_weight(span.since_first(e.t), span.length());
    float& last = at(image, e.x, e.y, 2 + plane);
    last = std::max(last, weight_value(weight));
  }
  std::transform(counts.pixels.begin(), counts.pixels.end(), image.pixels.begin(),
                 [](int64_t count) { return static_cast<float>(count); });
  return image;
}

}  // namespace scarf
