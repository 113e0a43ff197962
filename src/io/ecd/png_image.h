// PNG images, as recordings hold them. Decoding needs libpng.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "scarf/core/event.h"
#include "scarf/core/image.h"
#include "scarf/core/result.h"

namespace scarf {

/// The size that a PNG file says in its first bytes, unchecked; nullopt if it is none.
std::optional<SensorSize> png_size(std::span<const uint8_t> bytes);

/// One plane; colour becomes grey. Errors: bad_input, for broken images, for sizes that no sensor has, and if
/// this build has no libpng.
Result<Image<uint8_t>> decode_png(std::span<const uint8_t> bytes);

}  // namespace scarf
