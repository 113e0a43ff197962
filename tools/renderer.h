// Pictures of one or several representations of a stream, side by side, on their way to a writer.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarf/representation.h"
#include "tools/frame_writer.h"
#include "tools/instants.h"

namespace scarf::tools {

/// A representation and the label of its tile.
struct Shown {
  std::unique_ptr<Representation> representation;
  std::string title;
};

/// Renders frames while later events are pushed: the last few images stay on their way.
class Renderer {
 public:
  Renderer(std::vector<Shown> shown, FrameWriter& writer) : shown_(std::move(shown)), writer_(writer) {}

  Result<void> push(std::span<const Event> events);
  /// Asks for the picture of a frame that is due.
  Result<void> ask(const Frame& frame);
  /// Writes what is on its way and completes the output.
  Result<void> finish();

  uint64_t frames() const { return frames_; }
  Representation& first() const { return *shown_.front().representation; }

 private:
  struct InFlight {
    Frame frame;
    std::vector<Pending<Image<uint8_t>>> images;
  };

  Result<void> write_oldest();

  const std::vector<Shown> shown_;
  FrameWriter& writer_;
  std::deque<InFlight> in_flight_;
  uint64_t frames_ = 0;
};

}  // namespace scarf::tools
