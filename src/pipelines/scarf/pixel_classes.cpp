#include "pipelines/scarf/pixel_classes.h"

namespace scarf {

PixelClasses pixel_classes(const GridAxis& axis) {
  PixelClasses classes;
  classes.of_patch.assign(axis.grid, 0);
  PatchRange previous;
  for (int32_t v = 0; v < axis.size; ++v) {
    const PatchRange range = axis.patches_holding(v);
    const bool none = range.last < range.first;
    if (!none && (v == 0 || !(range == previous))) {
      const uint32_t number = classes.count++;
      for (int32_t i = range.first; i <= range.last; ++i) {
        uint32_t& patch = classes.of_patch[i];
        patch = (patch == 0 ? number - 1 : patch & 0xFFFF) | number << 16;
      }
    }
    previous = range;
    classes.of_pixel.push_back(none ? 0 : classes.count - 1);
  }
  classes.of_pixel.push_back(0);
  return classes;
}

}  // namespace scarf
