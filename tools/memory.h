// What a job takes of memory.
#pragma once

#include <string>

#include "scarf/representation.h"

namespace scarf::tools {

/// A line: memory of the device that the representation holds, if it is on one, and the most that the process
/// held so far. The memory of a CPU device is part of both.
std::string memory_line(const Representation& representation);

}  // namespace scarf::tools
