#include "device/on_device.h"

namespace scarf {

Result<void> check_context(const std::shared_ptr<GpuContext>& context) {
  if (context == nullptr) return no_context();
  return context->vulkan().check_process();
}

Result<Feed> Feed::create(std::shared_ptr<GpuContext> context, std::unique_ptr<Pipeline> pipeline,
                          ImagePipeline* images, bool asks_for_newest, const GpuOptions& options,
                          std::span<const FilterParameters> filters) {
  Feed feed;
  if (!filters.empty()) {
    auto filtered =
        FilteredPipeline::create(context->vulkan(), std::move(pipeline), images, asks_for_newest, filters);
    if (!filtered) return filtered.error();
    feed.filtered = filtered->get();
    pipeline = std::move(*filtered);
  }
  auto stream = Stream::create(std::move(context), std::move(pipeline), options);
  if (!stream) return stream.error();
  feed.stream = std::move(*stream);
  return feed;
}

}  // namespace scarf
