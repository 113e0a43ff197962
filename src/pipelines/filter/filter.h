// Noise filters on the device, in front of a pipeline: what the filters reject never gets there.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/pipeline.h"
#include "kernels/pipeline_builder.h"
#include "kernels/tile_lists.h"
#include "scarf/core/filter.h"
#include "shaders/filter/filter_layout.h"

namespace scarf {

/// One filter. Each tile replays its list of events, so every decision is that of the sequential definition.
class DeviceFilter {
 public:
  /// Kernels bound to one buffer of events.
  struct Bound {
    TileLists::Bound lists;
    vulkan::BoundKernel decide;
  };

  /// Legal parameters only.
  void build(PipelineBuilder& builder, const FilterParameters& parameters, SensorSize sensor,
             uint32_t most_events);
  void bind(PipelineBuilder& builder, Bound& bound, const vulkan::Buffer& events) const;

  void record_reset(vulkan::Commands& commands) const;
  /// Writes those of events first .. first+count-1 that pass to filtered(), the first one's place being 0; at
  /// the places of the others are events outside the sensor. What was written before must be visible; the
  /// result is visible to what follows.
  void record(vulkan::Commands& commands, const Bound& bound, uint32_t first, uint32_t count,
              int64_t t_first) const;

  const vulkan::Buffer& filtered() const { return filtered_; }
  /// layout::kFilterReportWords words.
  const vulkan::Buffer& report() const { return report_; }

 private:
  SensorSize sensor_;
  uint32_t range_ = 0;  // 0: refractory
  uint32_t period_ = 0;
  uint32_t segment_events_ = 0;  // of a list, per dispatch
  TileLists lists_;
  vulkan::Buffer last_, filtered_, report_;
  vulkan::Kernel decide_, add_report_;
  vulkan::BoundKernel bound_report_;
};

/// A pipeline behind filters. Its queries are those of the pipeline; what the pipeline sees as the stream's
/// newest event is the newest one that passed, which only the device knows: a query whose answer depends on
/// it waits for the events pushed before.
class FilteredPipeline final : public ImagePipeline {
 public:
  /// `images` answers queries and is `inner` itself; null if the caller asks the pipeline within directly.
  /// `asks_for_newest`: its queries depend on StreamFacts::newest. None may depend on StreamFacts::largest,
  /// which is not known behind filters. `filters` are at least one.
  /// Errors: illegal_parameter as checked_filter; out_of_memory.
  static Result<std::unique_ptr<FilteredPipeline>> create(vulkan::Device& device,
                                                          std::unique_ptr<Pipeline> inner,
                                                          ImagePipeline* images, bool asks_for_newest,
                                                          std::span<const FilterParameters> filters);

  SensorSize sensor() const override { return inner_->sensor(); }
  uint32_t submission_events() const override { return inner_->submission_events(); }
  uint64_t memory_bytes() const override { return bytes_ + inner_->memory_bytes(); }
  Result<std::unique_ptr<EventBinding>> bind_events(const vulkan::Buffer& events) override;
  void record_reset(vulkan::Commands& commands) override;
  Result<void> prepare_push(uint32_t count) override { return inner_->prepare_push(count); }
  void recording_lost() override { inner_->recording_lost(); }
  void record_push(vulkan::Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts& facts) override;

  Result<Answer<Image<uint8_t>>> record_u8(vulkan::Commands& commands, const StreamFacts& facts,
                                           std::optional<int64_t> now) override;
  Result<Answer<Image<float>>> record_float(vulkan::Commands& commands, const StreamFacts& facts,
                                            std::optional<int64_t> now) override;
  Result<Answer<Image<int64_t>>> record_raw(vulkan::Commands& commands, const StreamFacts& facts) override;
  Result<Answer<std::vector<uint8_t>>> record_state(vulkan::Commands& commands,
                                                    const StreamFacts& facts) override;
  Result<Answer<std::vector<Event>>> record_events(vulkan::Commands& commands,
                                                   const StreamFacts& facts) override;

  /// What became of the events, in the order of the filters.
  Answer<std::vector<FilterReport>> reports(const StreamFacts& facts) const;

 private:
  FilteredPipeline(vulkan::Device& device, std::unique_ptr<Pipeline> inner, ImagePipeline* images,
                   bool asks_for_newest)
      : device_(device), inner_(std::move(inner)), images_(images), asks_for_newest_(asks_for_newest) {}
  void build(PipelineBuilder& builder, std::span<const FilterParameters> filters);
  StreamFacts known(const StreamFacts& facts) const { return {facts.first, {}, {}}; }
  Result<StreamFacts> passed(const StreamFacts& facts);

  vulkan::Device& device_;
  std::vector<std::unique_ptr<DeviceFilter>> filters_;  // outlive what is bound to them
  std::unique_ptr<Pipeline> inner_;
  ImagePipeline* images_;
  const bool asks_for_newest_;
  uint64_t bytes_ = 0;
  std::vector<DeviceFilter::Bound> behind_;  // of the second filter and those behind it
  std::unique_ptr<EventBinding> filtered_;   // of the inner pipeline
  vulkan::Commands asking_;
  vulkan::Buffer asked_;  // the last filter's report, for the host
};

}  // namespace scarf
