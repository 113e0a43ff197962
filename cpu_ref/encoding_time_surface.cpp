// Time surface of the last event per polarity. Source: Lagorce et al., "HOTS: A Hierarchy of Event-Based
// Time-Surfaces for Pattern Recognition", 2017.
#include <algorithm>

#include "cpu_ref/encodings.h"

namespace scarf {

Image<float> encode_as(const TimeSurfaceParameters& parameters, const EncoderInput& input) {
  auto image = input.image<float>();
  for (const Event& e : input.events) {
    // The newest event of a pixel has the largest weight.
    float& value = at(image, e.x, e.y, polarity_plane(e));
    value = std::max(value, weight_value(decay_weight(age(input.t_last, e.t), parameters.tau)));
  }
  return image;
}

}  // namespace scarf
