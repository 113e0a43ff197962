// What every stream's options and every pipeline's size of work have in common.
#pragma once

#include <cstdint>

#include "scarf/device/tuning.h"
#include "vulkan/device.h"

namespace scarf {

/// Errors: illegal_parameter for options out of range.
Result<void> check_options(const GpuOptions& options);

/// Events per submission: what the options say, or what suits the device.
uint32_t submission_events(const GpuOptions& options, const vulkan::Limits& limits);

}  // namespace scarf
