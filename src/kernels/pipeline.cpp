#include "kernels/pipeline.h"

#include <cstring>

#include "core/queries.h"

namespace scarf {

Result<void> Pipeline::prepare_push(uint32_t) {
  return {};
}

Result<void> run_alone(vulkan::Device& device, const std::function<void(vulkan::Commands&)>& record) {
  auto commands = vulkan::Commands::create(device, device.compute());
  if (!commands) return commands.error();
  if (auto r = commands->begin(); !r) return r;
  record(*commands);
  if (auto r = commands->submit(); !r) return r;
  return commands->wait();
}

Result<Answer<std::vector<Event>>> ImagePipeline::record_events(vulkan::Commands&, const StreamFacts&) {
  return no_events();
}

template <class T>
Answer<Image<T>> image_answer(const vulkan::Buffer& buffer, SensorSize sensor, int32_t planes) {
  const uint64_t bytes = uint64_t{sizeof(T)} * planes * sensor.width * sensor.height;
  return {{{&buffer, bytes}}, [sensor, planes, bytes](HostParts parts) -> Result<Image<T>> {
            Image<T> image(sensor.width, sensor.height, planes);
            std::memcpy(image.pixels.data(), parts[0], bytes);
            return image;
          }};
}

template Answer<Image<uint8_t>> image_answer(const vulkan::Buffer&, SensorSize, int32_t);
template Answer<Image<int32_t>> image_answer(const vulkan::Buffer&, SensorSize, int32_t);
template Answer<Image<float>> image_answer(const vulkan::Buffer&, SensorSize, int32_t);

}  // namespace scarf
