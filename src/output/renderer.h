// How the frames of a recording are computed while it is played.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "output/frame_product.h"
#include "output/frame_writer.h"
#include "output/products.h"
#include "scarf/device/stream.h"

namespace scarf {

/// Takes events and frames as play() hands them out. What is written does not depend on which one it is.
class Renderer {
 public:
  virtual ~Renderer() = default;
  virtual Result<void> push(std::span<const Event> events) = 0;
  /// Asks for a frame of the state after the events pushed so far.
  virtual Result<void> ask(const Frame& frame) = 0;
  /// Writes what is not written yet and completes the output.
  virtual Result<void> finish() = 0;
  /// Memory of the device; nullopt on none.
  virtual std::optional<uint64_t> device_bytes() const = 0;
};

/// Representations that are asked for the products of each frame, which stay on their way while later events
/// are pushed. `shown` outlives the renderer.
std::unique_ptr<Renderer> make_live_renderer(const std::vector<Shown>& shown,
                                             std::vector<std::unique_ptr<FrameProduct>> products);

/// Computes the 8-bit pictures of a SCARF in groups, each at the same time: for recordings, whose frames
/// nobody waits for. `make_writer` is called when everything else is there. Errors: those of make_gpu_replay
/// and of `make_writer`.
using MakeWriter = std::function<Result<std::unique_ptr<FrameWriter>>()>;
Result<std::unique_ptr<Renderer>> make_replay_renderer(std::shared_ptr<GpuContext> context,
                                                       const Geometry& geometry, double accumulation,
                                                       const MakeWriter& make_writer);

}  // namespace scarf
