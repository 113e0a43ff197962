#include "kernels/event_unpacker.h"

#include "compiled_shaders/shaders.h"

namespace scarf {

void EventUnpacker::build(PipelineBuilder& builder, uint32_t most_events) {
  builder.buffer(events_, "the unpacked events", uint64_t{most_events} * sizeof(Event));
  builder.kernel(unpack_, "unpack_events", shaders::unpack_events, 2, sizeof(layout::UnpackPush));
}

void EventUnpacker::bind(PipelineBuilder& builder, vulkan::BoundKernel& bound,
                         const vulkan::Buffer& packed) const {
  builder.bind(bound, unpack_, {&packed, &events_});
}

void EventUnpacker::record(vulkan::Commands& commands, const vulkan::BoundKernel& bound,
                           const layout::UnpackPush& part) const {
  commands.dispatch(bound, part.events, layout::kLinearGroup, part);
  commands.barrier();
  commands.mark("unpack");
}

}  // namespace scarf
