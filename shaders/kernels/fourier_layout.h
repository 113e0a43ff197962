// Push constants of the discrete Fourier transform, shared by the shaders and the host.
#ifndef SCARF_SHADERS_FOURIER_LAYOUT_H
#define SCARF_SHADERS_FOURIER_LAYOUT_H
#include "../common/layout.h"

#ifdef __cplusplus
namespace scarf::layout {
using uint = uint32_t;
#endif

// fourier, fourier_small: one pass over all rows, or all columns, of a plane.
struct FourierPush {
  uint elements;    // of the plane
  uint points;      // of a line
  uint stride;      // from one element of a line to the next
  uint radix;       // lines are combined from `radix` interleaved parts
  uint done;        // product of the radices of earlier passes
  uint inverse;
};

#ifdef __cplusplus
}  // namespace scarf::layout
#endif
#endif
