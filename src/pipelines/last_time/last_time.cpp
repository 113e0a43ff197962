// time_window and sae on a device: the last time of each pixel, and a brightness table over its age.
#include <algorithm>

#include "compiled_shaders/shaders.h"
#include "core/little_endian.h"
#include "core/sensor_check.h"
#include "core/tables.h"
#include "kernels/last_event.h"
#include "kernels/submission.h"
#include "kernels/tone.h"
#include "layout/words.h"
#include "pipelines/base/pipelines.h"
#include "scarf/core/representation.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

// The device holds times relative to the stream's first event; all are less than 2^48 away from it.
constexpr int64_t kNeverOnDevice = INT64_MIN;
constexpr int64_t kFarAway = int64_t{1}
                             << 60;  // the same as any later or earlier time, and overflows nothing

int64_t relative(int64_t t, int64_t t_first) {
  if (t > 0 && t_first < 0 && t > INT64_MAX + t_first) return kFarAway;
  if (t < 0 && t_first > 0 && t < INT64_MIN + t_first) return -kFarAway;
  return std::clamp(t - t_first, -kFarAway, kFarAway);
}

// How an age becomes an entry of the brightness table.
struct Ageing {
  uint32_t planes;  // of last times
  int64_t step;     // microseconds per entry
  int64_t reach;    // ages from here on take the last entry
  Levels levels;
};

struct LastTimeBinding : EventBinding {
  BoundKernel last_event, last_time;
};

class LastTimePipeline final : public ImagePipeline {
 public:
  static MadePipeline create(vulkan::Device& device, const Ageing& ageing, SensorSize sensor,
                             const GpuOptions& options) {
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (auto r = check_options(options); !r) return r.error();
    std::unique_ptr<LastTimePipeline> p(
        new LastTimePipeline(device, ageing, sensor, scarf::submission_events(options, device.limits())));
    PipelineBuilder builder(device);
    p->build(builder, ageing.levels);
    if (!builder.result()) return builder.result().error();
    p->bytes_ = builder.bytes();
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override { return bytes_; }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto binding = std::make_unique<LastTimeBinding>();
    PipelineBuilder b(device_);
    last_event_.bind(b, binding->last_event, events);
    b.bind(binding->last_time, store_, {&events, &last_event_.entries(), &times_});
    if (!b.result()) return b.result().error();
    return std::unique_ptr<EventBinding>(std::move(binding));
  }

  void record_reset(Commands& commands) override {
    last_event_.record_reset(commands);
    const layout::FillTimesPush push = {planes_ * pixels(), low_word(kNeverOnDevice),
                                        high_word(kNeverOnDevice)};
    commands.dispatch(bound_fill_, push.times, layout::kLinearGroup, push);
    commands.mark("reset");
  }

  Result<void> prepare_push(uint32_t count) override { return last_event_.make_room(count); }

  void record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts& facts) override {
    const auto& bound = static_cast<const LastTimeBinding&>(binding);
    layout::SurfacePush push = last_event_.record(commands, bound.last_event, first, count);
    push.t_first_low = low_word(facts.first.value_or(0));
    push.t_first_high = high_word(facts.first.value_or(0));
    commands.dispatch(bound.last_time, count, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("last_time");
  }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts& facts,
                                           std::optional<int64_t> now) override {
    record_age(commands, facts, now);
    tone_.record_u8(commands, tone_ages_, pixels());
    return image_answer<uint8_t>(tone_.picture(), sensor_);
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts& facts,
                                            std::optional<int64_t> now) override {
    record_age(commands, facts, now);
    tone_.record_float(commands, tone_ages_, pixels());
    return image_answer<float>(tone_.picture(), sensor_);
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands&, const StreamFacts& facts) override {
    return last_times<Image<int64_t>>(facts, [s = sensor_, n = planes_](std::vector<int64_t> last) {
      Image<int64_t> raw(s.width, s.height, static_cast<int32_t>(n));
      raw.pixels = std::move(last);
      return raw;
    });
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands&, const StreamFacts& facts) override {
    const int64_t newest = facts.newest.value_or(kNeverFired);
    return last_times<std::vector<uint8_t>>(facts, [newest](const std::vector<int64_t>& last) {
      std::vector<uint8_t> bytes;
      append_little_endian(bytes, newest);
      for (const int64_t t : last) append_little_endian(bytes, t);
      return bytes;
    });
  }

 private:
  LastTimePipeline(vulkan::Device& device, const Ageing& ageing, SensorSize sensor, uint32_t events)
      : device_(device),
        sensor_(sensor),
        submission_events_(events),
        planes_(ageing.planes),
        step_(static_cast<uint32_t>(ageing.step)),
        reach_(static_cast<uint32_t>(ageing.reach)),
        last_entry_(static_cast<uint32_t>(ageing.levels.u8.size() - 1)) {}

  uint32_t pixels() const { return static_cast<uint32_t>(sensor_.width) * sensor_.height; }

  void build(PipelineBuilder& b, const Levels& levels) {
    last_event_.build(b, sensor_, planes_);
    b.buffer(times_, "the last times", uint64_t{planes_} * pixels() * sizeof(int64_t));
    b.buffer(ages_, "the ages", pixels() * sizeof(uint32_t));
    tone_.build(b, levels, pixels());
    b.kernel(fill_, "last_time_fill", shaders::last_time_fill, 1, sizeof(layout::FillTimesPush));
    b.kernel(store_, "last_time", shaders::last_time,
             {vulkan::View::vectors, vulkan::View::words, vulkan::View::storage},
             sizeof(layout::SurfacePush));
    b.kernel(age_, "sae_age", shaders::sae_age, 2, sizeof(layout::SaeAgePush));
    b.bind(bound_fill_, fill_, {&times_});
    b.bind(bound_age_, age_, {&times_, &ages_});
    tone_.bind(b, tone_ages_, ages_);
  }

  void record_age(Commands& commands, const StreamFacts& facts, std::optional<int64_t> now) const {
    const int64_t t_first = facts.first.value_or(0);
    const int64_t shown = relative(now.value_or(facts.newest.value_or(t_first)), t_first);
    const layout::SaeAgePush push = {pixels(), planes_, low_word(shown), high_word(shown),
                                     step_,    reach_,  last_entry_};
    commands.dispatch(bound_age_, pixels(), layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("age");
  }

  // An answer made from the last times.
  template <class T, class Function>
  Answer<T> last_times(const StreamFacts& facts, Function function) const {
    const uint64_t count = uint64_t{planes_} * pixels();
    return {{{&times_, count * sizeof(int64_t)}},
            [count, t_first = facts.first.value_or(0), function](HostParts parts) -> Result<T> {
              const auto* relative_times = static_cast<const int64_t*>(parts[0]);
              std::vector<int64_t> last(relative_times, relative_times + count);
              for (int64_t& t : last) t = t == kNeverOnDevice ? kNeverFired : t + t_first;
              return function(std::move(last));
            }};
  }

  vulkan::Device& device_;
  const SensorSize sensor_;
  const uint32_t submission_events_;
  const uint32_t planes_, step_, reach_, last_entry_;
  uint64_t bytes_ = 0;
  LastEvent last_event_;
  Buffer times_, ages_;
  Tone tone_;
  Kernel fill_, store_, age_;
  BoundKernel bound_fill_, bound_age_;
  Tone::Source tone_ages_;
};

}  // namespace

MadePipeline make_time_window(vulkan::Device& device, const TimeWindowParameters& p, SensorSize sensor,
                              const GpuOptions& options) {
  if (p.counts) return make_time_window_counts(device, p, sensor, options);
  // Ages below the window are entry 0, white; all others entry 1, black.
  return LastTimePipeline::create(device, {1, p.window, p.window, {{255, 0}, {1, 0}}}, sensor, options);
}

MadePipeline make_sae(vulkan::Device& device, const SaeParameters& p, SensorSize sensor,
                      const GpuOptions& options) {
  const Ageing ageing = p.decay == SaeParameters::Decay::linear
                            ? Ageing{2, 1, p.tau, linear_table(p.tau)}
                            : Ageing{2, exponential_step(p.tau), 8 * p.tau, exponential_table(p.tau)};
  return LastTimePipeline::create(device, ageing, sensor, options);
}

}  // namespace scarf
