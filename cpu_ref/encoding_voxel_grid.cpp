// Voxel grids. Sources: Zhu et al., "Unsupervised Event-based Learning of Optical Flow, Depth, and
// Egomotion", CVPR 2019; Rebecq et al., "High Speed and High Dynamic Range Video with an Event Camera"
// (rpg_e2vid), 2019; Zhu et al., "EventGAN", 2021.
#include <algorithm>

#include "cpu_ref/encodings.h"

namespace scarf {

Image<float> encode_as(const VoxelGridParameters& parameters, const EncoderInput& input) {
  const bool per_polarity = parameters.convention == VoxelGridParameters::Convention::eventgan;
  const TimeSpan span(input.t_first, input.t_last);
  auto sums = input.image<int64_t>();
  for (const Event& e : input.events) {
    // Place on the axis of bins: (B-1)(t-t_first)/length; all events at one time belong to bin 0. Fits 48
    // bits.
    const uint64_t place = (parameters.bins - 1) * span.since_first(e.t);
    const uint64_t length = std::max<uint64_t>(1, span.length());
    const auto bin = static_cast<int32_t>(place / length);
    const int64_t right = rounded_weight(place % length, length);
    const int64_t left = kWeightOne - right;

    const int32_t plane = bin + (per_polarity ? polarity_plane(e) * parameters.bins : 0);
    const int64_t sign = per_polarity || e.p == 1 ? 1 : -1;
    at(sums, e.x, e.y, plane) += sign * left;
    // Behind the last bin there is none; there place is its number exactly, and right is 0.
    if (right > 0) at(sums, e.x, e.y, plane + 1) += sign * right;
  }
  auto image = input.image<float>();
  std::transform(sums.pixels.begin(), sums.pixels.end(), image.pixels.begin(), weight_value);
  return image;
}

}  // namespace scarf
