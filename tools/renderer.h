// How the frames of a recording are computed while it is played, and written in order.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarf/replay.h"
#include "tools/frame_writer.h"
#include "tools/instants.h"

namespace scarf::tools {

/// Takes events and frames as play() hands them out. What it writes does not depend on which one it is.
class Renderer {
 public:
  virtual ~Renderer() = default;

  /// Where the frames go; to be called once, before anything else. The writer outlives the renderer.
  void write_to(FrameWriter& writer) { writer_ = &writer; }

  virtual Result<void> push(std::span<const Event> events) = 0;
  /// Asks for a frame of the state after the events pushed so far.
  virtual Result<void> ask(const Frame& frame) = 0;
  /// Writes what is not written yet and completes the output.
  virtual Result<void> finish() = 0;
  virtual uint64_t frames() const = 0;  ///< asked for so far

 protected:
  FrameWriter& writer() { return *writer_; }

 private:
  FrameWriter* writer_ = nullptr;
};

/// A representation and what its tile is called where there are several.
struct Shown {
  std::unique_ptr<Representation> representation;
  std::string title;
};

/// Asks representations for their images, which stay on their way while later events are pushed. Several
/// become one picture, side by side.
std::unique_ptr<Renderer> make_live_renderer(std::vector<Shown> shown);

/// Computes the frames of a SCARF in groups, each at the same time: for recordings, whose frames nobody waits
/// for. Errors: those of make_gpu_replay.
Result<std::unique_ptr<Renderer>> make_replay_renderer(std::shared_ptr<GpuContext> context,
                                                       const Geometry& geometry, double accumulation);

}  // namespace scarf::tools
