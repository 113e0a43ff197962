#include "kernels/fourier.h"

#include <cmath>
#include <numbers>

#include "compiled_shaders/shaders.h"
#include "shaders/kernels/fourier_layout.h"

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
  build_axis(b, columns_, static_cast<uint32_t>(size.height), static_cast<uint32_t>(size.width));
  build_axis(b, rows_, static_cast<uint32_t>(size.width), 1);
}

const vulkan::Kernel& Fourier::kernel_of(PipelineBuilder& b, uint32_t radix) {
  const size_t push = sizeof(layout::FourierPush);
  if (radix > kMostSmallRadix) {
    if (any_.pipeline() == VK_NULL_HANDLE) b.kernel(any_, "fourier", shaders::fourier, 3, push);
    return any_;
  }
  vulkan::Kernel& kernel = small_[radix];
  const uint32_t constants[] = {radix};
  if (kernel.pipeline() == VK_NULL_HANDLE)
    b.kernel(kernel, "fourier_small", shaders::fourier_small, 3, push, constants);
  return kernel;
}

void Fourier::build_axis(PipelineBuilder& b, Axis& axis, uint32_t points, uint32_t stride) {
  axis.points = points;
  axis.stride = stride;
  b.table<double>(axis.roots, "the roots of unity", roots_of(points));
  for (const uint32_t radix : radices_of(points)) {
    Axis::Pass& pass = axis.passes.emplace_back();
    pass.radix = radix;
    const vulkan::Kernel& kernel = kernel_of(b, radix);
    for (uint32_t turn : {0, 1}) {
      b.bind(pass.from[turn], kernel, {&planes_[turn], &planes_[1 - turn], &axis.roots});
    }
  }
}

uint32_t Fourier::record(vulkan::Commands& commands, uint32_t turn, bool inverse) const {
  for (const Axis* axis : {&columns_, &rows_}) {
    layout::FourierPush push{elements_, axis->points, axis->stride, 1, 1, inverse ? 1u : 0u};
    for (const Axis::Pass& pass : axis->passes) {
      push.radix = pass.radix;
      const uint32_t elements_per_invocation = pass.radix <= kMostSmallRadix ? pass.radix : 1;
      commands.dispatch(pass.from[turn], elements_ / elements_per_invocation, layout::kLinearGroup, push);
      commands.barrier();
      push.done *= pass.radix;
      turn = 1 - turn;
    }
  }
  commands.mark("fourier");
  return turn;
}

}  // namespace scarf
