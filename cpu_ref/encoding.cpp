// Encodings of sparse events: what they have in common.
#include "scarf/core/encoding.h"

#include <algorithm>

#include "core/sensor_check.h"
#include "core/text.h"
#include "cpu_ref/encodings.h"

namespace scarf {
namespace {

Result<EncoderInput> make_input(SensorSize sensor, EncodingShape shape, std::span<const Event> events) {
  EncoderInput input{sensor, shape, {}};
  for (const Event& e : events) {
    if (!sensor.contains(e)) continue;
    if (e.p > 1) {
      return Error{ErrorCode::refused_batch,
                   text("event ", &e - events.data(), " (t ", e.t, ", x ", e.x, ", y ", e.y, ", p ", int{e.p},
                        "): the polarity must be 0 or 1; nothing was encoded")};
    }
    const bool first = input.events.empty();
    input.t_first = first ? e.t : std::min(input.t_first, e.t);
    input.t_last = first ? e.t : std::max(input.t_last, e.t);
    input.events.push_back(e);
  }
  return input;
}

}  // namespace

Image<float> cell_means(const Image<int64_t>& sums, const Image<int64_t>& counts) {
  Image<float> means(sums.width, sums.height, sums.planes);
  for (size_t i = 0; i < sums.pixels.size(); ++i) {
    const int64_t count = counts.pixels[i % counts.pixels.size()];
    if (count == 0) continue;
    const double mean = static_cast<double>(sums.pixels[i]) / static_cast<double>(count);
    means.pixels[i] = static_cast<float>(std::ldexp(mean, -kWeightBits));
  }
  return means;
}

Result<Image<float>> encode(const EncodingParameters& parameters, SensorSize sensor,
                            std::span<const Event> events) {
  return as_result([&]() -> Result<Image<float>> {
    if (auto r = checked_encoding(parameters); !r) return r.error();
    if (auto r = check_sensor(sensor); !r) return r.error();
    const auto input = make_input(sensor, shape_of(parameters, sensor), events);
    if (!input) return input.error();
    return std::visit([&](const auto& p) { return encode_as(p, *input); }, parameters);
  });
}

}  // namespace scarf
