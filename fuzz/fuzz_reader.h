// What every reader must hold for any bytes: no fault, and the same events and report however they are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarf/io/frames.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// Aborts, which libFuzzer reports, unless the condition holds.
void require(bool condition);

/// Reads `header` and `data` behind it at once and in small steps, and compares; then the frames and
/// triggers.
void check_reader(std::string_view header, std::span<const uint8_t> data, const ReadOptions& options = {});

/// The same of the events of a file or folder, for readers that need one.
void check_path(const std::string& path, const ReadOptions& options = {});

/// Reads all frames.
void read_frames(const Result<std::unique_ptr<FrameSource>>& source);

/// All triggers. None if damage ends them, since what a call had before it is not handed out.
std::vector<Trigger> read_triggers(const Result<std::unique_ptr<TriggerSource>>& source, size_t batch);

}  // namespace scarf
