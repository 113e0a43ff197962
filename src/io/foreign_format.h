// Files that are not read, known by their first bytes: so that the error can say what to do.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace scarf {

/// What the file seems to be, and what to do with it; empty if unknown.
std::string_view foreign_format(std::span<const uint8_t> bytes);
/// Whether the file holds events nevertheless: an AEDAT file.
bool foreign_recording(std::span<const uint8_t> bytes);

}  // namespace scarf
