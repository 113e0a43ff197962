// The greyscale frames of a recording of the Event-Camera Dataset.
#pragma once

#include <memory>
#include <optional>

#include "io/ecd/ecd_files.h"
#include "scarf/core/event.h"
#include "scarf/io/frames.h"

namespace scarf {

/// Errors: io; bad_input, if there are none.
Result<std::unique_ptr<FrameSource>> open_ecd_frames(EcdFiles files);

/// The size of the first image; nullopt if there is none. Errors: io; bad_input, for an image that no sensor
/// can have made.
Result<std::optional<SensorSize>> ecd_image_size(const EcdFiles& files);

}  // namespace scarf
