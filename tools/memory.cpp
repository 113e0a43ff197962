#include "tools/memory.h"

#include <sys/resource.h>

#include "core/text.h"
#include "scarf/gpu.h"

namespace scarf::tools {
namespace {

constexpr uint64_t kMebibyte = uint64_t{1} << 20;

}  // namespace

std::string memory_line(const Representation& representation) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const uint64_t process = static_cast<uint64_t>(usage.ru_maxrss) * 1024 / kMebibyte;  // ru_maxrss: KiB
  const auto* const on_device = dynamic_cast<const GpuRepresentation*>(&representation);
  const std::string device =
      on_device == nullptr ? "" : text("device ", on_device->memory_bytes() / kMebibyte, " MiB, ");
  return text("memory: ", device, "process at most ", process, " MiB\n");
}

}  // namespace scarf::tools
