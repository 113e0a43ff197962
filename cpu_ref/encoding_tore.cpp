// Time-ordered recent events. Source: Baldwin et al., "Time-Ordered Recent Event (TORE) Volumes for Event
// Cameras", 2021.
#include <algorithm>

#include "cpu_ref/encodings.h"

namespace scarf {

Image<float> encode_as(const ToreParameters& parameters, const EncoderInput& input) {
  // Newest first. Events of the same time have the same value, so their order does not matter.
  std::vector<Event> events = input.events;
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t > b.t; });

  auto image = input.image<float>();
  std::fill(image.pixels.begin(), image.pixels.end(), tore_value(kToreOldest));
  Image<int32_t> filled(input.sensor.width, input.sensor.height, 2);
  for (const Event& e : events) {
    int32_t& rank = at(filled, e.x, e.y, polarity_plane(e));
    if (rank == parameters.k) continue;
    at(image, e.x, e.y, polarity_plane(e) * parameters.k + rank) = tore_value(age(input.t_last, e.t));
    ++rank;
  }
  return image;
}

}  // namespace scarf
