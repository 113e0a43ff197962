// Lack of memory while a recording is read or written.
#pragma once

#include <memory>

#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"
#include "scarf/io/words.h"

namespace scarf {

// What an exception for lack of memory leaves behind in a reader or writer may be anything. So it becomes an
// error, and stays one: nothing is read or written half, or twice. Formats need not think of it.
std::unique_ptr<EventSource> guarded(std::unique_ptr<EventSource> source);
std::unique_ptr<FrameSource> guarded(std::unique_ptr<FrameSource> source);
std::unique_ptr<TriggerSource> guarded(std::unique_ptr<TriggerSource> source);
std::unique_ptr<WordSource> guarded(std::unique_ptr<WordSource> source);
std::unique_ptr<EventSink> guarded(std::unique_ptr<EventSink> sink);

}  // namespace scarf
