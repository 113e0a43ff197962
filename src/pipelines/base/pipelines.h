// The pipelines of the representations other than SCARF.
#pragma once

#include <memory>

#include "kernels/pipeline.h"
#include "scarf/core/parameters.h"
#include "scarf/device/tuning.h"
#include "vulkan/device.h"

namespace scarf {

/// A pipeline, or why there is none: illegal_parameter for a sensor that the representation cannot be on,
/// device if the device lacks something that it needs, out_of_memory.
using MadePipeline = Result<std::unique_ptr<ImagePipeline>>;

MadePipeline make_time_window(vulkan::Device&, const TimeWindowParameters&, SensorSize, const GpuOptions&);
MadePipeline make_time_window_counts(vulkan::Device&, const TimeWindowParameters&, SensorSize,
                                     const GpuOptions&);
MadePipeline make_sae(vulkan::Device&, const SaeParameters&, SensorSize, const GpuOptions&);
MadePipeline make_eros(vulkan::Device&, const ErosParameters&, SensorSize, const GpuOptions&);
MadePipeline make_tos(vulkan::Device&, const TosParameters&, SensorSize, const GpuOptions&);
MadePipeline make_sits(vulkan::Device&, const SitsParameters&, SensorSize, const GpuOptions&);
MadePipeline make_chain_sae(vulkan::Device&, const ChainSaeParameters&, SensorSize, const GpuOptions&);
MadePipeline make_aed_sae(vulkan::Device&, const AedSaeParameters&, SensorSize, const GpuOptions&);
MadePipeline make_aae(vulkan::Device&, const AaeParameters&, SensorSize, const GpuOptions&);

}  // namespace scarf
