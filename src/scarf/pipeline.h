// The stages of SCARF on a device: their kernels, the buffers of one stream's state, and how the work is
// recorded. Knows nothing of threads, staging or waiting.
#pragma once

#include <cstdint>
#include <memory>

#include "scarf/image.h"
#include "scarf/plan.h"
#include "scarf/scarf.h"
#include "shaders/layout.h"
#include "vulkan/commands.h"

namespace scarf {

/// Where extracted events go: host-readable, with room for as many as there are slots.
struct ExtractTarget {
  vulkan::Buffer total;   ///< one word: how many events
  vulkan::Buffer first;   ///< events 0 .. half_events-1
  vulkan::Buffer second;  ///< the rest
  vulkan::BoundKernel scan;
  vulkan::BoundKernel write;
};

/// The stages that read one staging buffer.
struct PushKernels {
  vulkan::BoundKernel count;
  vulkan::BoundKernel place;
};

class ScarfPipeline {
 public:
  static Result<std::unique_ptr<ScarfPipeline>> create(vulkan::Device& device, const Geometry& geometry,
                                                       const Levels& levels, const Plan& plan);

  /// Binds a buffer of events (16 bytes each) to the push stages.
  Result<PushKernels> bind_events(const vulkan::Buffer& events) const;
  Result<std::unique_ptr<ExtractTarget>> make_extract_target() const;

  /// Empties the state.
  void record_reset(vulkan::Commands& commands) const;
  /// count, integrate and prune (where they pay), scan, place: events first .. first+count-1 of the bound
  /// buffer; at most Plan::submission_events.
  void record_push(vulkan::Commands& commands, const PushKernels& kernels, uint32_t first, uint32_t count,
                   int64_t t_first) const;
  /// The stages of record_push one by one, and what render and extract are given, for tests.
  layout::PatchPush patch_push(uint32_t first, uint32_t count) const;
  layout::BatchPush batch_push(uint32_t first, uint32_t count, int64_t t_first) const;
  void record_count(vulkan::Commands& commands, const PushKernels& kernels,
                    const layout::BatchPush& push) const;
  void record_scan(vulkan::Commands& commands, const layout::BatchPush& push) const;
  void record_prune(vulkan::Commands& commands, const layout::BatchPush& push) const;
  void record_place(vulkan::Commands& commands, const PushKernels& kernels,
                    const layout::BatchPush& push) const;
  /// Images of the state, each in the buffer that is returned: counts (render, unless they are kept anyway),
  /// and brightness (tone). PolarityMode::difference is for counts only.
  const vulkan::Buffer& record_counts(vulkan::Commands& commands, PolarityMode mode) const;
  const vulkan::Buffer& record_u8(vulkan::Commands& commands, PolarityMode mode) const;
  const vulkan::Buffer& record_float(vulkan::Commands& commands, PolarityMode mode) const;
  /// extract_count, extract_scan, extract_write: the events of patches first .. first+count-1.
  void record_extract(vulkan::Commands& commands, const ExtractTarget& target, uint32_t first, uint32_t count,
                      bool active_only, int64_t t_first) const;

  uint64_t half_events() const;
  const vulkan::Buffer& table() const { return table_; }
  const vulkan::Buffer& alive() const { return alive_; }
  const vulkan::Buffer& heads() const { return heads_; }
  const vulkan::Buffer& totals() const { return totals_; }
  const vulkan::Buffer& slots() const { return slots_; }
  const vulkan::Buffer& picture() const { return picture_; }
  const Plan& plan() const { return plan_; }
  uint64_t memory_bytes() const;

 private:
  ScarfPipeline() = default;
  Result<void> create_buffers(vulkan::Device& device, const Levels& levels);
  Result<void> create_kernels(vulkan::Device& device);
  const vulkan::Buffer& record_tone(vulkan::Commands& commands, PolarityMode mode,
                                    const vulkan::BoundKernel (&tone)[2],
                                    uint32_t pixels_per_invocation) const;

  vulkan::Device* device_ = nullptr;
  Geometry geometry_;
  Plan plan_;
  layout::TonePush first_levels_{};
  // Buffers before kernels before bindings: each is destroyed after what uses it.
  vulkan::Buffer ranges_, table_, alive_, heads_, totals_, slots_, counts_, polarity_counts_, levels_u8_,
      levels_float_, picture_, cursors_;
  vulkan::Kernel clear_, count_, integrate_, scan_, prune_, place_, render_, tone_u8_, tone_float_,
      extract_count_, extract_scan_, extract_write_;
  vulkan::BoundKernel bound_clear_, bound_integrate_, bound_scan_, bound_prune_, bound_render_,
      bound_extract_count_;
  vulkan::BoundKernel bound_tone_u8_[2], bound_tone_float_[2];  // of counts_, of polarity_counts_
};

}  // namespace scarf
