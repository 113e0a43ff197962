// Whether all of a video reached the disk, of which the encoder says nothing.
#pragma once

#include <string>

#include "scarf/core/result.h"

namespace scarf {

/// Looks whether the chunks of an AVI or MP4 file fill it from its first to its last byte, as those of one do
/// that was finished. Messages call it `shown`. Errors: io, with the reason of the disk where it still has
/// that.
Result<void> check_whole_video(const std::string& path, const std::string& shown);

}  // namespace scarf
