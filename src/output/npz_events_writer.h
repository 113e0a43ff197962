// The sparse events of every frame as a NumPy archive.
#pragma once

#include <memory>
#include <string>

#include "output/event_list_writer.h"

namespace scarf {

/// Errors: as OutputFile::create; illegal_parameter if this build has no libzip.
Result<std::unique_ptr<EventListWriter>> create_npz_events(const std::string& path, const OutputRule& rule);

}  // namespace scarf
