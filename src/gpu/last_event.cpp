#include "gpu/last_event.h"

#include "shaders/shaders.h"

namespace scarf {

void LastEvent::build(PipelineBuilder& builder, SensorSize sensor, uint32_t planes) {
  sensor_ = sensor;
  planes_ = planes;
  builder.buffer(entries_, "the last event of each pixel",
                 uint64_t{planes} * sensor.width * sensor.height * sizeof(uint32_t));
  builder.kernel(kernel_, "last_event", shaders::last_event, 2, sizeof(layout::SurfacePush));
}

void LastEvent::bind(PipelineBuilder& builder, vulkan::BoundKernel& bound,
                     const vulkan::Buffer& events) const {
  builder.bind(bound, kernel_, {&events, &entries_});
}

void LastEvent::record_reset(vulkan::Commands& commands) {
  commands.fill(entries_, 0);
  stamp_ = 1;
}

layout::SurfacePush LastEvent::record(vulkan::Commands& commands, const vulkan::BoundKernel& bound,
                                      uint32_t first, uint32_t count) {
  if (count > UINT32_MAX - stamp_) {  // the stamps run out: those of earlier submissions are not needed
    record_reset(commands);
    commands.barrier();
  }
  layout::SurfacePush push{};
  push.first_event = first;
  push.events = count;
  push.width = static_cast<uint32_t>(sensor_.width);
  push.height = static_cast<uint32_t>(sensor_.height);
  push.planes = planes_;
  push.stamp = stamp_;
  stamp_ += count;
  commands.dispatch(bound, count, layout::kLinearGroup, push);
  commands.barrier();
  commands.mark("last_event");
  return push;
}

}  // namespace scarf
