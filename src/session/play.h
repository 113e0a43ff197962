// The one loop of the program: a recording in batches, cut where frames are due.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "scarf/io/recordings.h"
#include "session/batch_sizes.h"
#include "session/instants.h"

namespace scarf {

/// Where a played recording goes to. An error of either ends the play.
struct Audience {
  std::function<Result<void>(std::span<const Event>)> events;
  TakeFrame frame = [](const Frame&) { return Result<void>(); };
};

struct PlayOptions {
  BatchSizes batches = BatchSizes::fixed(kDefaultBatch);
  uint64_t max_events = std::numeric_limits<uint64_t>::max();  ///< the stream ends after this many
  Instants* instants = nullptr;                                ///< none: no frames
};

/// Hands all events to the audience in order, and each frame between the events where it is due.
/// Returns the number of events.
Result<uint64_t> play(EventSource& source, PlayOptions options, const Audience& audience);

}  // namespace scarf
