// Opening a recording that is not a file.
#pragma once

#include <memory>
#include <string>

#include "io/byte_reader.h"
#include "scarf/io.h"

namespace scarf {

/// As open_events, on any input; `name` is what error messages call it.
Result<std::unique_ptr<EventSource>> open_input(ByteReader input, const std::string& name,
                                                const ReadOptions& options = {});

}  // namespace scarf
