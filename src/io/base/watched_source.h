// Sources of events, frames and triggers whose end is an error if their files have changed since they were
// opened.
#pragma once

#include <memory>

#include "io/base/input_files.h"
#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"

namespace scarf {

std::unique_ptr<EventSource> watched(std::unique_ptr<EventSource> source,
                                     std::shared_ptr<const InputFiles> files);
std::unique_ptr<FrameSource> watched(std::unique_ptr<FrameSource> source,
                                     std::shared_ptr<const InputFiles> files);
std::unique_ptr<TriggerSource> watched(std::unique_ptr<TriggerSource> source,
                                       std::shared_ptr<const InputFiles> files);

/// The error of who reads files: that they have changed, if so, is the reason for any other.
Error reason(const InputFiles& files, Error error);

}  // namespace scarf
