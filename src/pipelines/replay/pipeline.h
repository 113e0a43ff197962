// The stages of a replay on a device: their kernels, the buffers of the state between groups, and how a group
// is recorded.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "kernels/pipeline_builder.h"
#include "pipelines/replay/plan.h"
#include "scarf/core/image.h"
#include "shaders/replay/replay_layout.h"
#include "vulkan/commands.h"

namespace scarf {

/// What one group brings and takes away. Two groups in turn: the host has one while the device has the other.
struct ReplayGroup {
  vulkan::Buffer events;    ///< x | y << 16, all inside the sensor; written by the host
  vulkan::Buffer chunks;    ///< of cut_group(); written by the host
  vulkan::Buffer pictures;  ///< one after the other; read by the host
  // Where shaders do not use host memory: copies on the device.
  vulkan::Buffer device_events, device_chunks, device_pictures;
  vulkan::BoundKernel count, scan, rank, carry, change, frames;
};

class ReplayPipeline {
 public:
  static Result<std::unique_ptr<ReplayPipeline>> create(vulkan::Device& device, const Geometry& geometry,
                                                        ReplayPixels pixels, const Levels& levels,
                                                        const ReplayPlan& plan);

  Result<std::unique_ptr<ReplayGroup>> make_group();

  /// Empties the state.
  void record_reset(vulkan::Commands& commands) const;
  /// The group's first `events` events, cut into `chunks` (cut_group()'s, without the last entry), and its
  /// first `frames` pictures. The number of dispatches depends on neither.
  void record_group(vulkan::Commands& commands, const ReplayGroup& group, uint32_t events, uint32_t chunks,
                    uint32_t frames) const;

  /// The stages of record_group one by one, for tests.
  layout::ReplayPush push(uint32_t chunks) const;
  layout::ReplayFramesPush frames_push(uint32_t frames) const;
  void record_upload(vulkan::Commands& commands, const ReplayGroup& group, uint32_t events,
                     uint32_t chunks) const;
  void record_count(vulkan::Commands& commands, const ReplayGroup& group, uint32_t chunks) const;
  void record_scan(vulkan::Commands& commands, const ReplayGroup& group, uint32_t chunks) const;
  void record_rank(vulkan::Commands& commands, const ReplayGroup& group, uint32_t chunks) const;
  void record_clear(vulkan::Commands& commands, uint32_t frames) const;
  void record_carry(vulkan::Commands& commands, const ReplayGroup& group, uint32_t chunks) const;
  void record_change(vulkan::Commands& commands, const ReplayGroup& group, uint32_t chunks) const;
  void record_frames(vulkan::Commands& commands, const ReplayGroup& group, uint32_t frames) const;
  void record_read_back(vulkan::Commands& commands, const ReplayGroup& group, uint32_t frames) const;

  uint64_t memory_bytes() const { return bytes_; }
  const ReplayPlan& plan() const { return plan_; }
  const vulkan::Buffer& table() const { return table_; }
  const vulkan::Buffer& ranks() const { return ranks_; }
  const vulkan::Buffer& heads() const { return heads_; }
  const vulkan::Buffer& changes() const { return changes_; }
  const vulkan::Buffer& kept() const { return kept_; }
  const vulkan::Buffer& pixels() const { return pixels_; }
  const vulkan::Buffer& counts() const { return counts_; }

 private:
  ReplayPipeline(vulkan::Device& device, const Geometry& geometry, const ReplayPlan& plan)
      : device_(device), geometry_(geometry), plan_(plan) {}
  void build(PipelineBuilder& builder, ReplayPixels pixels, const Levels& levels);

  vulkan::Device& device_;
  const Geometry geometry_;
  const ReplayPlan plan_;
  uint64_t bytes_ = 0;
  layout::ReplayFramesPush first_levels_{};
  // Buffers before kernels before bindings: each is destroyed after what uses it.
  vulkan::Buffer ranges_, table_, ranks_, heads_, changes_, kept_, pixels_, counts_, levels_;
  vulkan::Kernel count_, integrate_, scan_, rank_, carry_, change_, frames_;
  vulkan::BoundKernel bound_integrate_;
};

}  // namespace scarf
