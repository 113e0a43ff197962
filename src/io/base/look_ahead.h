// The beginning of a recording that recognition looks at.
#pragma once

#include <array>
#include <cstddef>

namespace scarf {

/// Bytes, in steps: a slow pipe is recognised by its first lines.
inline constexpr std::array<size_t, 3> kLookAhead = {256, 4096, 65'536};

}  // namespace scarf
