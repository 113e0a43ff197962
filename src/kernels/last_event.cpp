#include "kernels/last_event.h"

#include "compiled_shaders/shaders.h"
#include "kernels/pipeline.h"

namespace scarf {

void LastEvent::build(PipelineBuilder& builder, SensorSize sensor, uint32_t planes, uint32_t stamp) {
  device_ = &builder.device();
  stamp_ = stamp;
  sensor_ = sensor;
  planes_ = planes;
  builder.buffer(entries_, "the last event of each pixel",
                 uint64_t{planes} * sensor.width * sensor.height * sizeof(uint32_t));
  builder.kernel(kernel_, "last_event", shaders::last_event, vulkan::Bindings::vectors_and(1),
                 sizeof(layout::SurfacePush));
}

void LastEvent::bind(PipelineBuilder& builder, vulkan::BoundKernel& bound,
                     const vulkan::Buffer& events) const {
  builder.bind(bound, kernel_, {&events, &entries_});
}

void LastEvent::record_reset(vulkan::Commands& commands) {
  // Stamps go on, so that they are larger than all entries also if this work never gets to the device.
  commands.fill(entries_, 0);
}

Result<void> LastEvent::make_room(uint32_t count) {
  if (count <= UINT32_MAX - stamp_) return {};
  if (auto r = run_alone(*device_, [this](vulkan::Commands& c) { c.fill(entries_, 0); }); !r) return r;
  stamp_ = 1;
  return {};
}

layout::SurfacePush LastEvent::record(vulkan::Commands& commands, const vulkan::BoundKernel& bound,
                                      uint32_t first, uint32_t count) {
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
