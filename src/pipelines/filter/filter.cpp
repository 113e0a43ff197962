#include "pipelines/filter/filter.h"

#include <algorithm>

#include "compiled_shaders/shaders.h"
#include "layout/words.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

constexpr uint64_t kReportBytes = layout::kFilterReportWords * sizeof(uint32_t);

// Trips of filter_support.comp and filter_refractory.comp per event of a list, entries included.
uint32_t trips_per_event(uint32_t range) {
  const uint32_t side = 2 * range + 1;
  return range == 0 ? 1 : 1 + 1 + side * (1 + side + 1);
}

// Small tiles give a GPU many invocations. A CPU needs few, and the table of tiles and chunks costs it most:
// large tiles and short chunks are cheapest there.
TileListsPlan lists_for(SensorSize sensor, uint32_t range, uint32_t most_events,
                        const vulkan::Limits& limits) {
  constexpr uint32_t kTileGpu = 16;
  constexpr uint32_t kTileCpu = 64;
  constexpr uint32_t kChunkEventsCpu = 32;
  TileListsPlan plan =
      make_tile_lists_plan(sensor, limits.cpu ? kTileCpu : kTileGpu, range, most_events, limits);
  if (limits.cpu) plan.chunk_events = std::min(plan.chunk_events, kChunkEventsCpu);
  return plan;
}

uint64_t number(const uint32_t* report, uint32_t word) {
  return report[word] | uint64_t{report[word + 1]} << 32;
}

struct FilterBinding : EventBinding {
  DeviceFilter::Bound first;
};

}  // namespace

void DeviceFilter::build(PipelineBuilder& b, const FilterParameters& parameters, SensorSize sensor,
                         uint32_t most_events) {
  const auto* support = std::get_if<SupportFilter>(&parameters);
  range_ = support != nullptr ? static_cast<uint32_t>(support->range) : 0;
  period_ = static_cast<uint32_t>(support != nullptr ? support->period
                                                     : std::get<RefractoryFilter>(parameters).period);
  sensor_ = sensor;
  const vulkan::Limits& limits = b.device().limits();
  segment_events_ = std::max(1u, (limits.loop_trips - 2) / trips_per_event(range_));
  lists_.build(b, lists_for(sensor, range_, most_events, limits));
  const uint64_t side = lists_.plan().tile + 2 * range_;
  const uint64_t times = support != nullptr ? 2 * side * side * lists_.plan().tiles()
                                            : static_cast<uint64_t>(sensor.width) * sensor.height;
  b.buffer(last_, "the last times of the filter", times * sizeof(int64_t));
  b.buffer(filtered_, "the filtered events", uint64_t{most_events} * sizeof(Event));
  b.buffer(report_, "the report of the filter", kReportBytes);
  if (support != nullptr)
    b.kernel(decide_, "filter_support", shaders::filter_support, vulkan::Bindings::vectors_and(5),
             sizeof(layout::FilterPush));
  else
    b.kernel(decide_, "filter_refractory", shaders::filter_refractory, vulkan::Bindings::vectors_and(5),
             sizeof(layout::FilterPush));
  b.kernel(add_report_, "filter_report", shaders::filter_report, vulkan::Bindings::vectors_and(1),
           sizeof(uint32_t));
  b.bind(bound_report_, add_report_, {&filtered_, &report_});
}

void DeviceFilter::bind(PipelineBuilder& b, Bound& bound, const Buffer& events) const {
  lists_.bind(b, bound.lists, events);
  b.bind(bound.decide, decide_, {&events, &lists_.begins(), &lists_.lists(), &last_, &filtered_, &report_});
}

void DeviceFilter::record_reset(Commands& commands) const {
  commands.fill(last_, layout::kFilterNever);
  commands.fill(report_, 0);
  commands.mark("reset");
}

void DeviceFilter::record(Commands& commands, const Bound& bound, uint32_t first, uint32_t count,
                          int64_t t_first) const {
  commands.fill(filtered_, uint64_t{count} * sizeof(Event), layout::kFilterOutside);
  const layout::TileListsPush lists = lists_.record(commands, bound.lists, first, count);
  layout::FilterPush push{};
  push.first_event = first;
  push.chunks = lists.chunks;
  push.tiles = lists_.plan().tiles();
  push.tiles_x = lists.tiles_x;
  push.tile = lists.tile;
  push.range = range_;
  push.width = static_cast<uint32_t>(sensor_.width);
  push.period = period_;
  push.t_first_low = low_word(t_first);
  push.t_first_high = high_word(t_first);
  // All events may be in one list.
  for (; push.begin < count; push.begin = push.end) {
    push.end = push.begin + std::min(segment_events_, count - push.begin);
    commands.dispatch(bound.decide, push.tiles, layout::kLinearGroup, push);
    commands.barrier();
  }
  commands.dispatch(bound_report_, 1, layout::kLinearGroup, uint32_t{0});
  commands.barrier();
  commands.mark("filter");
}

Result<std::unique_ptr<FilteredPipeline>> FilteredPipeline::create(
    vulkan::Device& device, std::unique_ptr<Pipeline> inner, ImagePipeline* images, bool asks_for_newest,
    std::span<const FilterParameters> filters) {
  for (const FilterParameters& filter : filters) {
    if (auto r = checked_filter(filter); !r) return r.error();
  }
  std::unique_ptr<FilteredPipeline> p(
      new FilteredPipeline(device, std::move(inner), images, asks_for_newest));
  PipelineBuilder builder(device);
  p->build(builder, filters);
  if (!builder.result()) return builder.result().error();
  p->bytes_ = builder.bytes();
  auto binding = p->inner_->bind_events(p->filters_.back()->filtered());
  if (!binding) return binding.error();
  p->filtered_ = std::move(*binding);
  auto commands = Commands::create(device, device.compute());
  if (!commands) return commands.error();
  p->asking_ = std::move(*commands);
  return p;
}

void FilteredPipeline::build(PipelineBuilder& b, std::span<const FilterParameters> filters) {
  for (const FilterParameters& filter : filters) {
    filters_.push_back(std::make_unique<DeviceFilter>());
    filters_.back()->build(b, filter, sensor(), submission_events());
  }
  behind_ = std::vector<DeviceFilter::Bound>(filters_.size() - 1);
  for (size_t i = 0; i < behind_.size(); ++i) filters_[i + 1]->bind(b, behind_[i], filters_[i]->filtered());
  b.readback(asked_, "the report of the filter", kReportBytes);
}

Result<std::unique_ptr<EventBinding>> FilteredPipeline::bind_events(const Buffer& events) {
  auto binding = std::make_unique<FilterBinding>();
  PipelineBuilder b(device_);
  filters_.front()->bind(b, binding->first, events);
  if (!b.result()) return b.result().error();
  return std::unique_ptr<EventBinding>(std::move(binding));
}

void FilteredPipeline::record_reset(Commands& commands) {
  for (const auto& filter : filters_) filter->record_reset(commands);
  inner_->record_reset(commands);
}

void FilteredPipeline::record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                                   const StreamFacts& facts) {
  const int64_t t_first = facts.first.value_or(0);
  filters_.front()->record(commands, static_cast<const FilterBinding&>(binding).first, first, count, t_first);
  for (size_t i = 0; i < behind_.size(); ++i) {
    filters_[i + 1]->record(commands, behind_[i], 0, count, t_first);
  }
  inner_->record_push(commands, *filtered_, 0, count, known(facts));
}

// The times of the events that passed, as far as they are asked for.
Result<StreamFacts> FilteredPipeline::passed(const StreamFacts& facts) {
  StreamFacts answer = known(facts);
  if (!asks_for_newest_) return answer;
  if (auto r = asking_.begin(); !r) return r.error();
  asking_.copy(filters_.back()->report(), 0, asked_, 0, kReportBytes);
  if (auto r = asking_.submit(); !r) return r.error();
  if (auto r = asking_.wait(); !r) return r.error();
  const auto* report = asked_.mapped_as<uint32_t>();
  if (number(report, layout::kFilterTotalPassed) != 0) {
    answer.newest = static_cast<int64_t>(number(report, layout::kFilterNewestTime));
  }
  return answer;
}

Result<Answer<Image<uint8_t>>> FilteredPipeline::record_u8(Commands& commands, const StreamFacts& facts,
                                                           std::optional<int64_t> now) {
  const auto known_facts = now ? known(facts) : passed(facts);
  if (!known_facts) return known_facts.error();
  return images_->record_u8(commands, *known_facts, now);
}

Result<Answer<Image<float>>> FilteredPipeline::record_float(Commands& commands, const StreamFacts& facts,
                                                            std::optional<int64_t> now) {
  const auto known_facts = now ? known(facts) : passed(facts);
  if (!known_facts) return known_facts.error();
  return images_->record_float(commands, *known_facts, now);
}

Result<Answer<Image<int64_t>>> FilteredPipeline::record_raw(Commands& commands, const StreamFacts& facts) {
  const auto known_facts = passed(facts);
  if (!known_facts) return known_facts.error();
  return images_->record_raw(commands, *known_facts);
}

Result<Answer<std::vector<uint8_t>>> FilteredPipeline::record_state(Commands& commands,
                                                                    const StreamFacts& facts) {
  const auto known_facts = passed(facts);
  if (!known_facts) return known_facts.error();
  return images_->record_state(commands, *known_facts);
}

Result<Answer<std::vector<Event>>> FilteredPipeline::record_events(Commands& commands,
                                                                   const StreamFacts& facts) {
  const auto known_facts = passed(facts);
  if (!known_facts) return known_facts.error();
  return images_->record_events(commands, *known_facts);
}

Answer<std::vector<FilterReport>> FilteredPipeline::reports(const StreamFacts& facts) const {
  Answer<std::vector<FilterReport>> answer;
  for (const auto& filter : filters_) answer.parts.push_back({&filter->report(), kReportBytes});
  answer.read = [outside = facts.outside](HostParts parts) -> Result<std::vector<FilterReport>> {
    std::vector<FilterReport> reports;
    for (const void* part : parts) {
      const auto* report = static_cast<const uint32_t*>(part);
      reports.push_back({number(report, layout::kFilterTotalPassed),
                         number(report, layout::kFilterTotalRejected), outside});
    }
    return reports;
  };
  return answer;
}

}  // namespace scarf
