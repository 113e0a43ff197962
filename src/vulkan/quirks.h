// Driver workarounds, each a named value with its symptom and the test that shows it.
#pragma once

#include <cstdint>

#include "vulkan/table.h"

namespace scarf::vulkan {

struct Quirks {
  /// llvmpipe (seen up to Mesa 22.3): an invocation silently leaves every loop once its loops have run 65,535
  /// trips in total, each entry of a loop counting one more. Results are wrong without any error.
  /// Trips that a shader may take in one invocation, entries included. Test:
  /// Plan.StaysWithinTheLoopBudgetForEveryGeometryAndBatch.
  uint32_t loop_trips = UINT32_MAX;

  /// llvmpipe reads words through a texel buffer in a few instructions for all lanes, and those of a storage
  /// buffer in a loop over the lanes. Elsewhere storage buffers are as fast, and texel buffers may be small:
  /// Vulkan promises 65,536 elements. Both kinds of views run in the tests; see docs/architecture/testing.md.
  bool texel_views = false;

  /// llvmpipe: the lanes of a subgroup are lanes of one register, and each instruction is done for all of
  /// them before the next. So a lane finds in memory what another lane of its subgroup stored a step before,
  /// which Vulkan does not promise without a barrier. Test: Stages.EqualTheirTwins, in every
  /// LP_NATIVE_VECTOR_WIDTH.
  bool lanes_in_step = false;
};

Quirks quirks_of(VkDriverId driver);

}  // namespace scarf::vulkan
