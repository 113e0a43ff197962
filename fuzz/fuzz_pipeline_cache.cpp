// The file of compiled pipelines: what is taken for one is one, byte for byte; what was sealed comes back.
#include <algorithm>
#include <cstdlib>

#include "vulkan/pipeline_cache.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scarf::vulkan;
  const std::span<const uint8_t> content(data, size);
  if (const auto pipelines = unsealed_pipelines(content)) {
    const auto again = sealed_pipelines(*pipelines);
    if (!std::equal(again.begin(), again.end(), content.begin(), content.end())) std::abort();
  }
  const auto sealed = sealed_pipelines(content);
  const auto pipelines = unsealed_pipelines(sealed);
  if (!pipelines || !std::equal(pipelines->begin(), pipelines->end(), content.begin(), content.end())) {
    std::abort();
  }
  return 0;
}
