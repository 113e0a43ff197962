#include "vulkan/quirks.h"

namespace scarf::vulkan {

Quirks quirks_of(VkDriverId driver) {
  Quirks quirks;
  if (driver == VK_DRIVER_ID_MESA_LLVMPIPE) {
    quirks.loop_trips = 60'000;  // rather than 65,535: the compiler may add a loop of its own
    quirks.texel_views = true;
    quirks.lanes_in_step = true;
  }
  return quirks;
}

}  // namespace scarf::vulkan
