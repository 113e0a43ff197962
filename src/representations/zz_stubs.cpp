// TEMPORARY: lets the library link while pipelines are being written. To be deleted by the lead.
#include "representations/make.h"
namespace scarf {
#define STUB(name, type)                                                                              \
  __attribute__((weak)) MadePipeline name(vulkan::Device&, const type&, SensorSize, const GpuOptions&) { \
    return Error{ErrorCode::device, "not there yet"};                                                 \
  }
STUB(make_time_window_counts, TimeWindowParameters)
STUB(make_sits, SitsParameters)
STUB(make_aed_sae, AedSaeParameters)
STUB(make_aae, AaeParameters)
}  // namespace scarf
