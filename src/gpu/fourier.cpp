#include "gpu/fourier.h"

#include <cmath>
#include <numbers>

#include "shaders/aed_sae_layout.h"
#include "shaders/shaders.h"

namespace scarf {
namespace {

std::vector<uint32_t> radices_of(uint32_t points) {
  std::vector<uint32_t> radices;
  const auto take = [&](uint32_t radix) {
    for (; points % radix == 0; points /= radix) radices.push_back(radix);
  };
  take(4);
  for (uint32_t radix = 2; points > 1; ++radix) take(radix);
  return radices;
}

// exp(-2 pi i n / points), real and imaginary parts in turn.
std::vector<double> roots_of(uint32_t points) {
  std::vector<double> roots;
  for (uint32_t n = 0; n < points; ++n) {
    const double angle = 2 * std::numbers::pi * n / points;
    roots.push_back(std::cos(angle));
    roots.push_back(-std::sin(angle));
  }
  return roots;
}

}  // namespace

void Fourier::build(PipelineBuilder& b, SensorSize size) {
  elements_ = static_cast<uint32_t>(size.width) * size.height;
  for (vulkan::Buffer& plane : planes_) {
    b.buffer(plane, "a plane of complex numbers", uint64_t{elements_} * 2 * sizeof(double));
  }
  b.kernel(kernel_, "fourier", shaders::fourier, 3, sizeof(layout::FourierPush));
  build_axis(b, columns_, static_cast<uint32_t>(size.height), static_cast<uint32_t>(size.width));
  build_axis(b, rows_, static_cast<uint32_t>(size.width), 1);
}

void Fourier::build_axis(PipelineBuilder& b, Axis& axis, uint32_t points, uint32_t stride) {
  axis.points = points;
  axis.stride = stride;
  axis.radices = radices_of(points);
  b.table<double>(axis.roots, "the roots of unity", roots_of(points));
  for (uint32_t turn : {0, 1}) {
    b.bind(axis.from[turn], kernel_, {&planes_[turn], &planes_[1 - turn], &axis.roots});
  }
}

uint32_t Fourier::record(vulkan::Commands& commands, uint32_t turn, bool inverse) const {
  for (const Axis* axis : {&columns_, &rows_}) {
    layout::FourierPush push{elements_, axis->points, axis->stride, 1, 1, inverse ? 1u : 0u};
    for (const uint32_t radix : axis->radices) {
      push.radix = radix;
      commands.dispatch(axis->from[turn], elements_, layout::kLinearGroup, push);
      commands.barrier();
      push.done *= radix;
      turn = 1 - turn;
    }
  }
  commands.mark("fourier");
  return turn;
}

}  // namespace scarf
