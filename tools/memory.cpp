#include "tools/memory.h"

#include <sys/resource.h>

#include "core/text.h"

namespace scarf::tools {
namespace {

constexpr uint64_t kMebibyte = uint64_t{1} << 20;

}  // namespace

std::string memory_line(std::optional<uint64_t> device_bytes) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const uint64_t process = static_cast<uint64_t>(usage.ru_maxrss) * 1024 / kMebibyte;  // ru_maxrss: KiB
  const std::string device = device_bytes ? text("device ", *device_bytes / kMebibyte, " MiB, ") : "";
  return text("memory: ", device, "process at most ", process, " MiB\n");
}

}  // namespace scarf::tools
