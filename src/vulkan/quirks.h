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
};

Quirks quirks_of(VkDriverId driver);

}  // namespace scarf::vulkan
