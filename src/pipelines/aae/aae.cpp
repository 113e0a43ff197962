// aae on a device: a log of events that a query sorts by block, walks backwards in each block, and cuts.
#include <algorithm>
#include <cmath>

#include "compiled_shaders/shaders.h"
#include "core/ceil_div.h"
#include "core/event_bytes.h"
#include "core/sensor_check.h"
#include "core/text.h"
#include "kernels/event_log.h"
#include "kernels/submission.h"
#include "kernels/tone.h"
#include "pipelines/aae/block_sort.h"
#include "pipelines/base/pipelines.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

constexpr uint32_t kFirstEvents = 1u << 16;
constexpr double kBrightness = 0.4;  // of one drawn event
constexpr uint64_t kWalkBytes = 32;  // the struct Walk of aae_walk.glsl

Levels make_brightness() {
  Levels levels;
  for (uint32_t draws = 0; draws <= layout::kLongestQueue; ++draws) {
    const double value = kBrightness * draws;
    levels.u8.push_back(static_cast<uint8_t>(std::min(255.0, std::nearbyint(255 * value))));
    levels.f32.push_back(static_cast<float>(value));
  }
  return levels;
}

// The queues one after the other, from a log in which each is in order.
struct Queues {
  std::vector<Event> events;
  std::vector<uint32_t> lengths;
};

Queues queues_of(const std::vector<Event>& log, const BlockGrid& grid) {
  std::vector<uint64_t> begin(grid.blocks() + uint64_t{1});
  for (const Event& e : log) begin[grid.block_of(e) + 1] += 1;
  for (size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Event> sorted(log.size());
  std::vector<uint64_t> next = begin;
  for (const Event& e : log) sorted[next[grid.block_of(e)]++] = e;
  Queues queues;
  for (uint32_t block = 0; block < grid.blocks(); ++block) {
    const uint64_t length = std::min<uint64_t>(begin[block + 1] - begin[block], layout::kLongestQueue);
    queues.lengths.push_back(static_cast<uint32_t>(length));
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(begin[block + 1]);
    queues.events.insert(queues.events.end(), end - static_cast<std::ptrdiff_t>(length), end);
  }
  return queues;
}

std::vector<uint8_t> state_of(const Queues& queues) {
  std::vector<uint8_t> bytes;
  append_little_endian(bytes, static_cast<uint32_t>(queues.lengths.size()));
  auto event = queues.events.begin();
  for (const uint32_t length : queues.lengths) {
    append_little_endian(bytes, length);
    for (uint32_t i = 0; i < length; ++i) append_event(bytes, *event++);
  }
  return bytes;
}

struct AaeBinding : EventBinding {
  std::unique_ptr<EventLog::Input> input;
};

class AaePipeline final : public ImagePipeline, private EventLogOwner {
 public:
  static MadePipeline create(vulkan::Device& device, const AaeParameters& parameters, SensorSize sensor,
                             const GpuOptions& options) {
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (auto r = check_options(options); !r) return r.error();
    if (!device.limits().float64) {
      return Error{ErrorCode::device, text("device ", device.info().name,
                                           " has no doubles in shaders (shaderFloat64), which aae needs; "
                                           "use another device")};
    }
    std::unique_ptr<AaePipeline> p(
        new AaePipeline(device, parameters, sensor, scarf::submission_events(options, device.limits())));
    if (auto r = p->build(); !r) return r.error();
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override { return bytes_ + sized_.sort.table.size() + log_->memory_bytes(); }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto binding = std::make_unique<AaeBinding>();
    auto input = log_->bind_input(events);
    if (!input) return input.error();
    binding->input = std::move(*input);
    return std::unique_ptr<EventBinding>(std::move(binding));
  }

  void record_reset(Commands& commands) override {
    log_->record_reset(commands);
    commands.mark("reset");
  }

  Result<void> prepare_push(uint32_t count) override { return log_->prepare(count); }

  void record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts&) override {
    log_->record_append(commands, *static_cast<AaeBinding&>(binding).input, first, count);
  }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts&,
                                           std::optional<int64_t>) override {
    record_draws(commands);
    tone_.record_u8(commands, tone_draws_, pixels());
    return with_length(image_answer<uint8_t>(tone_.picture(), sensor_));
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts&,
                                            std::optional<int64_t>) override {
    record_draws(commands);
    tone_.record_float(commands, tone_draws_, pixels());
    return with_length(image_answer<float>(tone_.picture(), sensor_));
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands& commands, const StreamFacts&) override {
    record_draws(commands);
    const Part part = {&draws_, pixels() * sizeof(uint32_t)};
    return with_length<Image<int64_t>>({{part}, [s = sensor_](HostParts parts) -> Result<Image<int64_t>> {
                                          Image<int64_t> raw(s.width, s.height);
                                          const auto* draws = static_cast<const uint32_t*>(parts[0]);
                                          std::copy_n(draws, raw.pixels.size(), raw.pixels.begin());
                                          return raw;
                                        }});
  }

  Result<Answer<std::vector<Event>>> record_events(Commands&, const StreamFacts&) override {
    return queues<std::vector<Event>>([](Queues queues) { return std::move(queues.events); });
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands&, const StreamFacts&) override {
    return queues<std::vector<uint8_t>>([](const Queues& queues) { return state_of(queues); });
  }

 private:
  // What depends on the log's memory.
  struct Sized {
    BlockSort::Memory sort;
    BoundKernel ranges, start, walk, forward, backward, cut;
  };

  AaePipeline(vulkan::Device& device, const AaeParameters& parameters, SensorSize sensor, uint32_t events)
      : device_(device),
        parameters_(parameters),
        sensor_(sensor),
        grid_(block_grid(parameters, sensor)),
        submission_events_(events) {}

  uint32_t pixels() const { return static_cast<uint32_t>(sensor_.width) * sensor_.height; }

  Result<void> build() {
    PipelineBuilder b(device_);
    const uint64_t blocks = grid_.blocks();
    b.buffer(ranges_, "the ranges of the blocks", blocks * 2 * sizeof(uint32_t));
    b.buffer(walks_, "the walks of the blocks", blocks * kWalkBytes);
    b.buffer(keep_from_, "the cuts of the blocks", blocks * sizeof(uint32_t));
    b.buffer(draws_, "the draws", pixels() * sizeof(uint32_t));
    sort_.build(b, grid_, device_.limits().storage_range / sizeof(Event));
    const size_t push = sizeof(layout::AaePush);
    b.kernel(ranges_kernel_, "aae_ranges", shaders::aae_ranges, 3, push);
    b.kernel(start_, "aae_start", shaders::aae_start, 3, push);
    b.kernel(cut_, "aae_cut", shaders::aae_cut, 3, push);
    if (parameters_.esvo2) {
      b.kernel(forward_, "aae_forward", shaders::aae_forward, 2, push);
      b.kernel(backward_, "aae_backward", shaders::aae_backward, 3, push);
    } else {
      b.kernel(walk_, "aae_walk", shaders::aae_walk, 3, push);
    }
    tone_.build(b, make_brightness(), pixels());
    tone_.bind(b, tone_draws_, draws_);
    if (!b.result()) return b.result();
    bytes_ = b.bytes();
    EventLog::Shape shape;
    shape.sensor = sensor_;
    shape.first_events = kFirstEvents;
    shape.keep = layout::kKeepNewest;
    shape.keep_from = &keep_from_;
    shape.block = grid_.block;
    shape.block_columns = grid_.columns;
    shape.advice = "ask for pictures more often, without keep, or use another device";
    auto log = EventLog::create(device_, shape, *this);
    if (!log) return log.error();
    log_ = std::move(*log);
    return bind_log(log_->memory());
  }

  Result<void> bind_log(const EventLogMemory& memory) override {
    PipelineBuilder b(device_);
    Sized sized;
    sort_.bind(b, sized.sort, *log_, memory);
    const Buffer& sorted = sort_.sorted() == EventLog::From::scratch ? memory.scratch : memory.events;
    b.bind(sized.ranges, ranges_kernel_, {&sorted, &log_->length(), &ranges_});
    b.bind(sized.start, start_, {&sorted, &walks_, &ranges_});
    b.bind(sized.cut, cut_, {&sorted, &walks_, &keep_from_});
    if (parameters_.esvo2) {
      b.bind(sized.forward, forward_, {&sorted, &walks_});
      b.bind(sized.backward, backward_, {&sorted, &walks_, &draws_});
    } else {
      b.bind(sized.walk, walk_, {&sorted, &walks_, &draws_});
    }
    if (!b.result()) return b.result();
    sized_ = std::move(sized);
    return {};
  }

  Result<void> drop_old_events() override {
    return log_->run([this](Commands& commands) {
      const layout::AaePush push = record_queues(commands);
      record_cut(commands, push, layout::kCutToLongest);
    });
  }

  // Sorts the log and finds the queue of each block.
  layout::AaePush record_queues(Commands& commands) {
    layout::AaePush push{};
    push.events = log_->bound();
    push.blocks = grid_.blocks();
    push.block_width = static_cast<uint32_t>(grid_.block.width);
    push.block_height = static_cast<uint32_t>(grid_.block.height);
    push.block_columns = grid_.columns;
    push.width = static_cast<uint32_t>(sensor_.width);
    if (push.events == 0) return push;
    commands.fill(ranges_, 0);
    sort_.record(commands, sized_.sort, push.events);
    commands.dispatch(sized_.ranges, push.events, layout::kLinearGroup, push);
    commands.barrier();
    dispatch_blocks(commands, sized_.start, push, 1);
    commands.mark("ranges");
    return push;
  }

  // Each pixel's draws; the queues are cut.
  void record_draws(Commands& commands) {
    commands.fill(draws_, 0);
    commands.barrier();
    const layout::AaePush push = record_queues(commands);
    if (push.events == 0) return;
    const uint32_t times = ceil_div(std::min(push.events, layout::kLongestQueue), layout::kWalkSteps);
    if (parameters_.esvo2) {
      dispatch_blocks(commands, sized_.forward, push, times);
      dispatch_blocks(commands, sized_.backward, push, times);
    } else {
      dispatch_blocks(commands, sized_.walk, push, times);
    }
    commands.mark("walk");
    if (!parameters_.keep)
      record_cut(commands, push, parameters_.esvo2 ? layout::kCutAll : layout::kCutToPassed);
  }

  static void dispatch_blocks(Commands& commands, const BoundKernel& kernel, const layout::AaePush& push,
                              uint32_t times) {
    for (uint32_t i = 0; i < times; ++i) {
      commands.dispatch(kernel, push.blocks, layout::kLinearGroup, push);
      commands.barrier();
    }
  }

  // The log becomes the events that stay, in order within each block.
  void record_cut(Commands& commands, layout::AaePush push, uint32_t cut) {
    push.cut = cut;
    dispatch_blocks(commands, sized_.cut, push, 1);
    log_->record_keep(commands, sort_.sorted());
    if (sort_.sorted() == EventLog::From::events) log_->record_copy_back(commands);
    commands.mark("cut");
  }

  // The answer also tells the log how long it is.
  template <class T>
  Answer<T> with_length(Answer<T> answer) {
    answer.parts.push_back({&log_->length(), sizeof(uint32_t)});
    answer.read = [read = std::move(answer.read), known = log_->length_reader(),
                   length = answer.parts.size() - 1](HostParts parts) {
      known(parts[length]);
      return read(parts);
    };
    return answer;
  }

  template <class T, class Function>
  Answer<T> queues(Function function) {
    return with_length<T>(
        {{{&log_->events(), uint64_t{log_->bound()} * sizeof(Event)}, {&log_->length(), sizeof(uint32_t)}},
         [grid = grid_, function](HostParts parts) -> Result<T> {
           return function(queues_of(events_of(parts[0], parts[1]), grid));
         }});
  }

  vulkan::Device& device_;
  const AaeParameters parameters_;
  const SensorSize sensor_;
  const BlockGrid grid_;
  const uint32_t submission_events_;
  uint64_t bytes_ = 0;
  Buffer ranges_, walks_, keep_from_, draws_;
  BlockSort sort_;
  Kernel ranges_kernel_, start_, walk_, forward_, backward_, cut_;
  Tone tone_;
  Tone::Source tone_draws_;
  std::unique_ptr<EventLog> log_;
  Sized sized_;
};

}  // namespace

MadePipeline make_aae(vulkan::Device& device, const AaeParameters& p, SensorSize sensor,
                      const GpuOptions& options) {
  return AaePipeline::create(device, p, sensor, options);
}

}  // namespace scarf
