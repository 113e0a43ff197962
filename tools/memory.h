// What a job takes of memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scarf::tools {

/// A line: memory of a device, if one is used, and the most that the process held so far. The memory of a CPU
/// device is part of both.
std::string memory_line(std::optional<uint64_t> device_bytes);

}  // namespace scarf::tools
