// The readers of HDF5 files.
#pragma once

#include <memory>
#include <string>

#include "io/base/format.h"
#include "io/hdf5/family.h"
#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"

namespace scarf::hdf5 {

/// Whether the file has events in a layout of the family.
bool recognise(const std::string& path, Family family);

/// Errors: bad_input, illegal_parameter.
Result<std::unique_ptr<EventSource>> open(Input input, const ReadOptions& options, Family family);
/// The greyscale frames of an MVSEC file.
Result<std::unique_ptr<FrameSource>> open_mvsec_frames(Input input, const ReadOptions& options);

}  // namespace scarf::hdf5
