#include "pipelines/scarf/pixel_classes.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/streams.h"

namespace scarf {
namespace {

TEST(PixelClasses, AreTheRunsOfPixelsOfTheSamePatches) {
  // Two patches of 2 pixels at 4..7 on an axis of 10 pixels, fields one pixel wider: 3..6 and 5..8.
  const PixelClasses classes = pixel_classes({10, 2, 4, 2, 1, 1});
  EXPECT_EQ(classes.of_pixel, (std::vector<uint32_t>{0, 0, 0, 1, 1, 2, 2, 3, 3, 0, 0}));
  EXPECT_EQ(classes.of_patch, (std::vector<uint32_t>{0 | 2u << 16, 1 | 3u << 16}));
  EXPECT_EQ(classes.count, 4u);
}

TEST(PixelClasses, SeparatePatchesWithoutPixelsBetween) {
  // Patches of 1 pixel at 0, 1, 2 without margins; the third is outside an axis of 2 pixels.
  const PixelClasses classes = pixel_classes({2, 1, 0, 3, 0, 0});
  EXPECT_EQ(classes.of_pixel, (std::vector<uint32_t>{1, 2, 0}));
  EXPECT_EQ(classes.of_patch, (std::vector<uint32_t>{0 | 1u << 16, 1 | 2u << 16, 0}));
}

TEST(PixelClasses, OfAPatchAreThoseOfItsPixelsForEveryGeometry) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 200; ++trial) {
    const GridAxis axis = test::random_geometry({20 + trial, 30}, random).x;
    const PixelClasses classes = pixel_classes(axis);
    for (int32_t i = 0; i < axis.grid; ++i) {
      const uint32_t before = classes.of_patch[i] & 0xFFFF;
      const uint32_t last = classes.of_patch[i] >> 16;
      for (int32_t v = 0; v < axis.size; ++v) {
        const PatchRange range = axis.patches_holding(v);
        const bool holds = i >= range.first && i <= range.last;
        EXPECT_EQ(holds, classes.of_pixel[v] > before && classes.of_pixel[v] <= last) << v << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace scarf
