// aed_sae on a device: the last time of each pixel, a log of the events of the list, and how densely they
// lie.
#include <algorithm>
#include <bit>
#include <cmath>

#include "compiled_shaders/shaders.h"
#include "core/ceil_div.h"
#include "core/event_bytes.h"
#include "core/sensor_check.h"
#include "core/text.h"
#include "kernels/event_log.h"
#include "kernels/fourier.h"
#include "kernels/submission.h"
#include "layout/words.h"
#include "pipelines/base/pipelines.h"
#include "shaders/aed_sae/aed_sae_layout.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

constexpr uint32_t kFirstEvents = 1u << 16;
constexpr uint32_t kLeastGroupRuns = 64;
constexpr uint32_t kMostClearSteps = 1u << 18;

// The struct AedState of aed_sae_state.glsl.
struct AedState {
  uint32_t start, first_violation, cleared, next, front, padding;
  int64_t t_max;
};
static_assert(sizeof(AedState) == 32);

// The earliest time that is not too old at t.
int64_t list_begin(int64_t t, int64_t window) {
  return t < INT64_MIN + window ? INT64_MIN : t - window;
}

// A Gaussian of `length` samples around their centre, with the sum 1.
std::vector<double> gaussian(int32_t length) {
  if (length == 1) return {1};  // its sigma would be 0
  const double sigma = length / 2;
  std::vector<double> kernel;
  double sum = 0;
  for (int32_t i = 0; i < length; ++i) {
    const double distance = i - static_cast<double>(length - 1) / 2;
    kernel.push_back(std::exp(-distance * distance / (2 * sigma * sigma)));
    sum += kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

struct AedBinding : EventBinding {
  std::unique_ptr<EventLog::Input> input;
};

class AedPipeline final : public ImagePipeline, private EventLogOwner {
 public:
  static MadePipeline create(vulkan::Device& device, const AedSaeParameters& parameters, SensorSize sensor,
                             const GpuOptions& options) {
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (auto r = check_options(options); !r) return r.error();
    if (!device.limits().float64) {
      return Error{ErrorCode::device, text("device ", device.info().name,
                                           " has no doubles in shaders (shaderFloat64), which aed_sae needs; "
                                           "use another device")};
    }
    std::unique_ptr<AedPipeline> p(
        new AedPipeline(device, parameters, sensor, scarf::submission_events(options, device.limits())));
    if (auto r = p->build(); !r) return r.error();
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override {
    return bytes_ + sized_.run_largest.size() + sized_.group_largest.size() + sized_.prefix.size() +
           log_->memory_bytes();
  }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto binding = std::make_unique<AedBinding>();
    auto input = log_->bind_input(events);
    if (!input) return input.error();
    binding->input = std::move(*input);
    return std::unique_ptr<EventBinding>(std::move(binding));
  }

  void record_reset(Commands& commands) override {
    log_->record_reset(commands);
    commands.fill(last_event_, 0);
    stamp_ = 1;
    layout::AedPush push = push_of(layout::kAedAll, 0);
    push.begin = 1;
    record_clear(commands, push);
    commands.mark("reset");
  }

  Result<void> prepare_push(uint32_t count) override {
    if (auto r = log_->prepare(count); !r) return r;
    if (!runs_lost_) return {};
    const auto record = [this](Commands& commands) {
      record_runs(commands, push_of(layout::kAedAll, log_->bound()));
    };
    if (auto r = log_->run(record); !r) return r;
    runs_lost_ = false;
    return {};
  }

  void record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts&) override {
    log_->record_append(commands, *static_cast<AedBinding&>(binding).input, first, count);
    const layout::AedPush push = push_of(layout::kAedNew, count);
    commands.dispatch(sized_.begin, 1, layout::kLinearGroup, push);
    commands.barrier();
    record_runs(commands, push);
    commands.dispatch(sized_.check, push.runs, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("check");
    record_clears(commands, push);
    commands.mark("clears");
    record_last_times(commands, push);
    commands.mark("last_time");
  }

  // The stamps may not have been cleared.
  void recording_lost() override { stamp_ = UINT32_MAX; }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts&,
                                           std::optional<int64_t>) override {
    constexpr uint32_t kPixelsPerInvocation = 4;
    const layout::AedImagePush push = record_density(commands);
    record_tone(commands, bound_u8_, ceil_div(pixels(), kPixelsPerInvocation), push);
    return image_answer<uint8_t>(picture_, sensor_);
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts&,
                                            std::optional<int64_t>) override {
    const layout::AedImagePush push = record_density(commands);
    record_tone(commands, bound_float_, pixels(), push);
    return image_answer<float>(picture_, sensor_);
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands&, const StreamFacts&) override {
    return Answer<Image<int64_t>>{
        {last_times_part()}, [s = sensor_](HostParts parts) -> Result<Image<int64_t>> {
          Image<int64_t> raw(s.width, s.height);
          std::copy_n(static_cast<const int64_t*>(parts[0]), raw.pixels.size(), raw.pixels.begin());
          return raw;
        }};
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands&, const StreamFacts&) override {
    const Part events = {&log_->events(), uint64_t{log_->bound()} * sizeof(Event)};
    const auto read = [count = pixels(), window = window_,
                       known = log_->length_reader()](HostParts parts) -> Result<std::vector<uint8_t>> {
      known(parts[3]);
      const auto& state = *static_cast<const AedState*>(parts[0]);
      const auto* last_times = static_cast<const int64_t*>(parts[1]);
      std::vector<Event> listed = events_of(parts[2], parts[3]);
      listed.erase(listed.begin(), listed.begin() + state.start);
      const int64_t since = list_begin(state.t_max, window);
      std::erase_if(listed, [since](const Event& e) { return e.t < since; });
      std::vector<uint8_t> bytes;
      append_little_endian(bytes, state.t_max);
      for (uint32_t i = 0; i < count; ++i) append_little_endian(bytes, last_times[i]);
      append_list(bytes, listed);
      return bytes;
    };
    return Answer<std::vector<uint8_t>>{
        {{&state_, sizeof(AedState)}, last_times_part(), events, {&log_->length(), sizeof(uint32_t)}}, read};
  }

 private:
  // What depends on the log's memory.
  struct Sized {
    Buffer run_largest, group_largest, prefix;
    BoundKernel begin, runs, groups, prefixes, check, clears, last_event, last_time, list;
  };

  AedPipeline(vulkan::Device& device, const AedSaeParameters& parameters, SensorSize sensor, uint32_t events)
      : device_(device),
        sensor_(sensor),
        window_(parameters.window),
        lambda_(parameters.lambda),
        submission_events_(events) {}

  uint32_t pixels() const { return static_cast<uint32_t>(sensor_.width) * sensor_.height; }
  Part last_times_part() const { return {&last_times_, pixels() * sizeof(int64_t)}; }

  Result<void> build() {
    PipelineBuilder b(device_);
    build_buffers(b);
    build_kernels(b);
    b.bind(bound_clear_, clear_, {&state_, &last_times_});
    b.bind(bound_plane_, plane_, {&marks_, &fourier_.plane(0)});
    const uint32_t between = fourier_.passes() % 2;
    b.bind(bound_filter_, filter_, {&fourier_.plane(between), &gaussians_});
    b.bind(bound_dense_, dense_, {&fourier_.plane(0), &counts_});
    b.bind(bound_u8_, u8_, {&state_, &last_times_, &counts_, &picture_});
    b.bind(bound_float_, float_, {&state_, &last_times_, &counts_, &picture_});
    if (!b.result()) return b.result();
    bytes_ = b.bytes();
    EventLog::Shape shape;
    shape.sensor = sensor_;
    shape.first_events = kFirstEvents;
    shape.keep = layout::kKeepSince;
    shape.advice = "use a shorter window, or another device";
    auto log = EventLog::create(device_, shape, *this);
    if (!log) return log.error();
    log_ = std::move(*log);
    return bind_log(log_->memory());
  }

  void build_buffers(PipelineBuilder& b) {
    const std::vector<double> by_column = gaussian(sensor_.width);
    const std::vector<double> by_row = gaussian(sensor_.height);
    peak_ = *std::max_element(by_row.begin(), by_row.end()) *
            *std::max_element(by_column.begin(), by_column.end());
    std::vector<double> both = by_column;
    both.insert(both.end(), by_row.begin(), by_row.end());
    b.table<double>(gaussians_, "the Gaussians", both);
    b.buffer(state_, "the state of the list", sizeof(AedState));
    b.readback(state_read_, "the state of the list", sizeof(AedState));
    b.buffer(counts_, "the counts", 2 * sizeof(uint32_t));
    b.buffer(last_event_, "the last event of each pixel", pixels() * sizeof(uint32_t));
    b.buffer(last_times_, "the last times", pixels() * sizeof(int64_t));
    b.buffer(marks_, "the pixels of the list", pixels() * sizeof(uint32_t));
    b.buffer(picture_, "the image", pixels() * sizeof(float));
    fourier_.build(b, sensor_);
  }

  void build_kernels(PipelineBuilder& b) {
    const size_t push = sizeof(layout::AedPush);
    b.kernel(begin_, "aed_sae_begin", shaders::aed_sae_begin, 4, push);
    b.kernel(runs_, "aed_sae_runs", shaders::aed_sae_runs, 5, push);
    b.kernel(groups_, "aed_sae_groups", shaders::aed_sae_groups, 6, push);
    b.kernel(prefixes_, "aed_sae_prefix", shaders::aed_sae_prefix, 7, push);
    b.kernel(check_, "aed_sae_check", shaders::aed_sae_check, 5, push);
    b.kernel(clears_, "aed_sae_clears", shaders::aed_sae_clears, 5, push);
    b.kernel(clear_, "aed_sae_clear", shaders::aed_sae_clear, 2, push);
    b.kernel(last_event_kernel_, "aed_sae_last_event", shaders::aed_sae_last_event, 5, push);
    b.kernel(last_time_, "aed_sae_last_time", shaders::aed_sae_last_time, 6, push);
    const size_t image_push = sizeof(layout::AedImagePush);
    b.kernel(list_, "aed_sae_list", shaders::aed_sae_list, 5, image_push);
    b.kernel(plane_, "aed_sae_plane", shaders::aed_sae_plane, 2, image_push);
    b.kernel(filter_, "aed_sae_filter", shaders::aed_sae_filter, 2, image_push);
    b.kernel(dense_, "aed_sae_dense", shaders::aed_sae_dense, 2, image_push);
    b.kernel(u8_, "aed_sae_u8", shaders::aed_sae_u8, 4, image_push);
    b.kernel(float_, "aed_sae_float", shaders::aed_sae_float, 4, image_push);
  }

  Result<void> bind_log(const EventLogMemory& m) override {
    PipelineBuilder b(device_);
    Sized s;
    const uint64_t runs = ceil_div(m.capacity, layout::kAedRun) + uint64_t{2};
    b.buffer(s.run_largest, "the largest times of the runs", runs * sizeof(int64_t));
    b.buffer(s.group_largest, "the largest times of the groups",
             ceil_div(runs, kLeastGroupRuns) * sizeof(int64_t));
    b.buffer(s.prefix, "the largest times up to the runs", runs * sizeof(int64_t));
    const Buffer& length = log_->length();
    b.bind(s.begin, begin_, {&m.events, &length, &m.places, &state_});
    b.bind(s.runs, runs_, {&m.events, &length, &m.places, &state_, &s.run_largest});
    b.bind(s.groups, groups_, {&m.events, &length, &m.places, &state_, &s.run_largest, &s.group_largest});
    b.bind(s.prefixes, prefixes_,
           {&m.events, &length, &m.places, &state_, &s.run_largest, &s.group_largest, &s.prefix});
    b.bind(s.check, check_, {&m.events, &length, &m.places, &state_, &s.prefix});
    b.bind(s.clears, clears_, {&m.events, &length, &m.places, &state_, &s.prefix});
    b.bind(s.last_event, last_event_kernel_, {&m.events, &length, &m.places, &state_, &last_event_});
    b.bind(s.last_time, last_time_, {&m.events, &length, &m.places, &state_, &last_event_, &last_times_});
    b.bind(s.list, list_, {&m.events, &length, &state_, &marks_, &counts_});
    if (!b.result()) return b.result();
    sized_ = std::move(s);
    runs_lost_ = true;
    return {};
  }

  Result<void> drop_old_events() override {
    if (auto r = log_->run([&](Commands& c) { c.copy(state_, 0, state_read_, 0, sizeof(AedState)); }); !r)
      return r;
    const AedState& state = *state_read_.mapped_as<AedState>();
    const int64_t since = list_begin(state.t_max, window_);
    layout::EventLogPush push{};
    push.start = state.start;
    push.since_low = low_word(since);
    push.since_high = high_word(since);
    runs_lost_ = true;
    return log_->run([&](Commands& c) {
      log_->record_keep(c, EventLog::From::events, push);
      log_->record_copy_back(c);
      c.fill(state_, sizeof(uint32_t), 0);  // AedState::start
    });
  }

  layout::AedPush push_of(uint32_t range, uint32_t events) const {
    layout::AedPush push{};
    push.range = range;
    push.runs = ceil_div(events, layout::kAedRun) + 1;  // the first may be in use
    const auto root = static_cast<uint32_t>(std::sqrt(push.runs));
    push.group_runs = std::max(kLeastGroupRuns, root);
    push.events = events;
    push.window = static_cast<uint32_t>(window_);
    push.width = static_cast<uint32_t>(sensor_.width);
    push.pixels = pixels();
    return push;
  }

  void record_runs(Commands& commands, const layout::AedPush& push) const {
    const uint32_t groups = ceil_div(push.runs, push.group_runs);
    commands.dispatch(sized_.runs, push.runs, layout::kLinearGroup, push);
    commands.barrier();
    commands.dispatch(sized_.groups, groups, layout::kLinearGroup, push);
    commands.barrier();
    commands.dispatch(sized_.prefixes, groups, layout::kLinearGroup, push);
    commands.barrier();
  }

  // Where the list is cleared, and all that follows from it.
  void record_clears(Commands& commands, layout::AedPush push) const {
    constexpr uint32_t kSpareTrips = 1000;
    push.steps = std::min(device_.limits().loop_trips - kSpareTrips, kMostClearSteps);
    const uint64_t dispatches = ceil_div(2 * uint64_t{push.events}, push.steps);
    for (uint64_t i = 0; i < dispatches; ++i) {
      push.begin = i == 0 ? 1 : 0;
      commands.dispatch(sized_.clears, 1, layout::kLinearGroup, push);
      commands.barrier();
    }
    push.range = layout::kAedAfterClear;
    push.begin = 0;
    record_runs(commands, push);
    record_clear(commands, push);
    commands.barrier();
  }

  void record_clear(Commands& commands, const layout::AedPush& push) const {
    commands.dispatch(bound_clear_, ceil_div(pixels(), layout::kAedPixels), layout::kLinearGroup, push);
  }

  void record_last_times(Commands& commands, layout::AedPush push) {
    if (push.events >
        UINT32_MAX - stamp_) {  // the stamps run out: those of earlier submissions are not needed
      commands.fill(last_event_, 0);
      commands.barrier();
      stamp_ = 1;
    }
    push.stamp = stamp_;
    stamp_ += push.events;
    commands.dispatch(sized_.last_event, push.events, layout::kLinearGroup, push);
    commands.barrier();
    commands.dispatch(sized_.last_time, push.events, layout::kLinearGroup, push);
    commands.barrier();
  }

  // How many events are in the list, and how many pixels lie densely.
  layout::AedImagePush record_density(Commands& commands) {
    const auto scale = std::bit_cast<int64_t>(lambda_ * static_cast<double>(window_));
    const auto peak = std::bit_cast<int64_t>(peak_);
    layout::AedImagePush push{};
    push.events = log_->bound();
    push.window = static_cast<uint32_t>(window_);
    push.width = static_cast<uint32_t>(sensor_.width);
    push.height = static_cast<uint32_t>(sensor_.height);
    push.pixels = pixels();
    push.scale_low = low_word(scale);
    push.scale_high = high_word(scale);
    push.peak_low = low_word(peak);
    push.peak_high = high_word(peak);
    commands.fill(marks_, 0);
    commands.fill(counts_, 0);
    commands.barrier();
    commands.dispatch(sized_.list, ceil_div(push.events, layout::kAedRun), layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("list");
    record_filter(commands, push);
    commands.dispatch(bound_dense_, ceil_div(pixels(), layout::kAedPixels), layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("dense");
    return push;
  }

  // The marked pixels, filtered in the space of their frequencies.
  void record_filter(Commands& commands, const layout::AedImagePush& push) const {
    commands.dispatch(bound_plane_, pixels(), layout::kLinearGroup, push);
    commands.barrier();
    const uint32_t turn = fourier_.record(commands, 0, /*inverse=*/false);
    commands.dispatch(bound_filter_, pixels(), layout::kLinearGroup, push);
    commands.barrier();
    fourier_.record(commands, turn, /*inverse=*/true);
  }

  static void record_tone(Commands& commands, const BoundKernel& kernel, uint32_t invocations,
                          const layout::AedImagePush& push) {
    commands.dispatch(kernel, invocations, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("tone");
  }

  vulkan::Device& device_;
  const SensorSize sensor_;
  const int64_t window_;  // microseconds
  const double lambda_;
  const uint32_t submission_events_;
  uint64_t bytes_ = 0;
  double peak_ = 0;     // of the Gaussian
  uint32_t stamp_ = 1;  // of the next event
  bool runs_lost_ = false;
  Buffer state_, state_read_, counts_, last_event_, last_times_, marks_, picture_, gaussians_;
  Fourier fourier_;
  Kernel begin_, runs_, groups_, prefixes_, check_, clears_, clear_, last_event_kernel_, last_time_;
  Kernel list_, plane_, filter_, dense_, u8_, float_;
  BoundKernel bound_clear_, bound_plane_, bound_filter_, bound_dense_, bound_u8_, bound_float_;
  std::unique_ptr<EventLog> log_;
  Sized sized_;
};

}  // namespace

MadePipeline make_aed_sae(vulkan::Device& device, const AedSaeParameters& p, SensorSize sensor,
                          const GpuOptions& options) {
  return AedPipeline::create(device, p, sensor, options);
}

}  // namespace scarf
