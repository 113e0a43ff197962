// Opening a recording that is not a file, or whose bytes are wanted, too.
#pragma once

#include <memory>
#include <string>

#include "io/base/byte_reader.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// As open_events, on any input; `name` is what error messages call it.
Result<std::unique_ptr<EventSource>> open_input(ByteReader input, const std::string& name,
                                                const ReadOptions& options = {});

/// As open_events. `seen` gets the bytes of the file as they are read, in order and each once. They are all
/// of its bytes when the source has ended; but of a format that a library reads by itself, and of a folder,
/// only the first or none.
Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options,
                                                 ByteReader::Seen seen);

}  // namespace scarf
