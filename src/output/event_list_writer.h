// Files of the sparse events of every frame.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "io/files/output_files.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"
#include "session/instants.h"

namespace scarf {

class EventListWriter {
 public:
  virtual ~EventListWriter() = default;
  /// All events of a frame, in their order. Errors: io.
  virtual Result<void> write(const Frame& frame, std::span<const Event> events) = 0;
  /// Completes the file; without it there is none. Errors: io.
  virtual Result<void> finish() = 0;
};

/// Whether such a file can be made, by its name alone. Errors: illegal_parameter.
Result<void> check_event_list(const std::string& path);

/// By the name: .h5 and .hdf5 (see hdf5_writer.h), .npz (arrays x, y, p, t of all events, one frame after the
/// other; frame_offsets, one more than there are frames; times, stream_events). Errors: illegal_parameter for
/// other names, and where this build lacks the library; as OutputFile::create.
Result<std::unique_ptr<EventListWriter>> make_event_list_writer(const std::string& path, SensorSize sensor,
                                                                const OutputRule& rule);

}  // namespace scarf
