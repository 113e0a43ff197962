// The stages of SCARF on a device: their kernels, the buffers of one stream's state, and how the work is
// recorded.
#pragma once

#include <cstdint>
#include <memory>

#include "kernels/pipeline.h"
#include "kernels/tone.h"
#include "layout/ring_head.h"
#include "pipelines/scarf/plan.h"
#include "scarf/core/patch_state.h"
#include "shaders/common/layout.h"

namespace scarf {

/// Where extracted events go: host-readable, with room for as many as there are slots.
struct ExtractMemory : QueryMemory {
  vulkan::Buffer total;   ///< one word: how many events
  vulkan::Buffer first;   ///< events 0 .. half_events-1
  vulkan::Buffer second;  ///< the rest
  vulkan::BoundKernel scan;
  vulkan::BoundKernel write;

  uint64_t memory_bytes() const override { return total.size() + first.size() + second.size(); }
};

/// The stages that read one staging buffer.
struct PushKernels : EventBinding {
  vulkan::BoundKernel count;
  vulkan::BoundKernel place;
  vulkan::BoundKernel append;
};

class ScarfPipeline : public Pipeline {
 public:
  static Result<std::unique_ptr<ScarfPipeline>> create(vulkan::Device& device, const Geometry& geometry,
                                                       const Levels& levels, const Plan& plan);

  SensorSize sensor() const override { return geometry_.sensor(); }
  uint32_t submission_events() const override { return plan_.submission_events; }
  Result<std::unique_ptr<EventBinding>> bind_events(const vulkan::Buffer& events) override;
  void record_reset(vulkan::Commands& commands) override;
  /// count, sum, scan, prune (where it pays), place; or append.
  void record_push(vulkan::Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts& facts) override;
  /// Heads may not have been settled.
  void recording_lost() override { unsettled_laps_ = kMostHeadLaps; }
  uint64_t memory_bytes() const override { return bytes_; }

  Result<std::unique_ptr<ExtractMemory>> make_extract_memory() const;
  /// The stages of record_push one by one, and what render and extract are given, for tests.
  layout::PatchPush patch_push(uint32_t first, uint32_t count) const;
  layout::PaintPush paint_push() const;
  layout::BatchPush batch_push(uint32_t first, uint32_t count, int64_t t_first) const;
  void record_count(vulkan::Commands& commands, const PushKernels& kernels,
                    const layout::BatchPush& push) const;
  void record_sum(vulkan::Commands& commands, const layout::BatchPush& push) const;
  void record_scan(vulkan::Commands& commands, const layout::BatchPush& push);
  void record_prune(vulkan::Commands& commands, const layout::BatchPush& push) const;
  void record_place(vulkan::Commands& commands, const PushKernels& kernels,
                    const layout::BatchPush& push) const;
  layout::AppendPush append_push(uint32_t first, uint32_t count, int64_t t_first) const;
  void record_append(vulkan::Commands& commands, const PushKernels& kernels, const layout::AppendPush& push);
  void record_settle(vulkan::Commands& commands);
  /// Images of the state, each in the buffer that is returned: counts (render) and brightness (paint; or
  /// render and tone). PolarityMode::difference is for counts only.
  const vulkan::Buffer& record_counts(vulkan::Commands& commands, PolarityMode mode) const;
  const vulkan::Buffer& record_u8(vulkan::Commands& commands, PolarityMode mode) const;
  const vulkan::Buffer& record_float(vulkan::Commands& commands, PolarityMode mode) const;
  /// extract_count, extract_scan, extract_write: the events of patches first .. first+count-1.
  void record_extract(vulkan::Commands& commands, const ExtractMemory& memory, uint32_t first, uint32_t count,
                      bool active_only, int64_t t_first) const;

  uint64_t half_events() const;
  uint64_t position_bytes() const;
  const vulkan::Buffer& class_counts() const { return class_counts_; }
  const vulkan::Buffer& positions() const { return positions_; }
  const vulkan::Buffer& painted_heads() const { return painted_heads_; }
  const vulkan::Buffer& table() const { return table_; }
  const vulkan::Buffer& alive() const { return alive_; }
  const vulkan::Buffer& heads() const { return heads_; }
  const vulkan::Buffer& laps() const { return laps_; }
  const vulkan::Buffer& slots() const { return slots_; }
  const vulkan::Buffer& picture() const { return tone_.picture(); }
  const Plan& plan() const { return plan_; }

 private:
  ScarfPipeline(vulkan::Device& device, const Geometry& geometry, const Plan& plan)
      : device_(device), geometry_(geometry), plan_(plan) {}
  void build(PipelineBuilder& builder, const Levels& levels);
  /// Before events are appended, at most kMostAppendEvents: makes room in the heads for their laps.
  void count_laps(vulkan::Commands& commands, uint32_t events);
  uint64_t pixels(PolarityMode mode) const;

  vulkan::Device& device_;
  const Geometry geometry_;
  const Plan plan_;
  uint64_t bytes_ = 0;
  uint64_t unsettled_laps_ = 0;  // at most so many in the head of a patch
  // Buffers before kernels before bindings: each is destroyed after what uses it.
  vulkan::Buffer ranges_, pixel_classes_, patch_classes_, class_counts_, table_, alive_, heads_, laps_,
      painted_heads_, slots_, counts_, painted_, positions_, cursors_;
  Tone tone_;
  vulkan::Kernel clear_, settle_, count_, sum_, scan_, prune_, place_, append_, render_, paint_,
      extract_count_, extract_scan_, extract_write_;
  vulkan::BoundKernel bound_clear_, bound_settle_, bound_sum_, bound_scan_, bound_prune_, bound_render_,
      bound_paint_, bound_extract_count_;
  Tone::Source bound_tone_;
};

}  // namespace scarf
