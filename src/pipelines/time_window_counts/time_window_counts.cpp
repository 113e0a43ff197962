// time_window with counts on a device: a log of the window's events, counted when a picture is asked for.
#include <algorithm>
#include <cmath>

#include "compiled_shaders/shaders.h"
#include "core/event_bytes.h"
#include "core/sensor_check.h"
#include "kernels/event_log.h"
#include "kernels/submission.h"
#include "kernels/tone.h"
#include "layout/words.h"
#include "pipelines/base/pipelines.h"
#include "scarf/core/representation.h"
#include "shaders/time_window_counts/time_window_layout.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

constexpr int32_t kTableEnd = 65'535;  // larger counts are looked after by the host
constexpr uint32_t kFirstEvents = 1u << 16;

// The earliest time in the window that ends at t.
int64_t window_begin(int64_t t, int64_t window) {
  return t < INT64_MIN + (window - 1) ? INT64_MIN : t - (window - 1);
}

// Brightness of counts beyond the table, as in make_levels.
uint8_t level_u8(double accumulation, int64_t count) {
  return static_cast<uint8_t>(
      std::min(255.0, std::nearbyint((255.0 * accumulation) * static_cast<double>(count))));
}
float level_float(double accumulation, int64_t count) {
  return static_cast<float>(accumulation * static_cast<double>(count));
}

struct TimeWindowBinding : EventBinding {
  std::unique_ptr<EventLog::Input> input;
};

class TimeWindowCounts final : public ImagePipeline, private EventLogOwner {
 public:
  static MadePipeline create(vulkan::Device& device, const TimeWindowParameters& parameters,
                             SensorSize sensor, const GpuOptions& options) {
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (auto r = check_options(options); !r) return r.error();
    const auto levels = make_levels(parameters.accumulation, kTableEnd);
    if (!levels) return levels.error();
    std::unique_ptr<TimeWindowCounts> p(
        new TimeWindowCounts(device, parameters, sensor, scarf::submission_events(options, device.limits())));
    if (auto r = p->build(*levels); !r) return r.error();
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override { return bytes_ + log_->memory_bytes(); }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto binding = std::make_unique<TimeWindowBinding>();
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
    log_->record_append(commands, *static_cast<TimeWindowBinding&>(binding).input, first, count);
  }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts& facts,
                                           std::optional<int64_t> now) override {
    record_count(commands, facts, now);
    tone_.record_u8(commands, tone_counts_, pixels());
    return picture<uint8_t>([c = accumulation_](int64_t count) { return level_u8(c, count); });
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts& facts,
                                            std::optional<int64_t> now) override {
    record_count(commands, facts, now);
    tone_.record_float(commands, tone_counts_, pixels());
    return picture<float>([c = accumulation_](int64_t count) { return level_float(c, count); });
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands& commands, const StreamFacts& facts) override {
    record_count(commands, facts, {});
    return Answer<Image<int64_t>>{{counts_part()}, [s = sensor_](HostParts parts) -> Result<Image<int64_t>> {
                                    Image<int64_t> raw(s.width, s.height);
                                    const auto* counts = static_cast<const uint32_t*>(parts[0]);
                                    std::copy_n(counts, raw.pixels.size(), raw.pixels.begin());
                                    return raw;
                                  }};
  }

  Result<Answer<std::vector<Event>>> record_events(Commands&, const StreamFacts& facts) override {
    return listed<std::vector<Event>>(facts, [](std::vector<Event> events) { return events; });
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands&, const StreamFacts& facts) override {
    const int64_t t_max = facts.largest.value_or(kNeverFired);
    return listed<std::vector<uint8_t>>(facts, [t_max](const std::vector<Event>& events) {
      std::vector<uint8_t> bytes;
      append_little_endian(bytes, t_max);
      append_list(bytes, events);
      return bytes;
    });
  }

 private:
  TimeWindowCounts(vulkan::Device& device, const TimeWindowParameters& parameters, SensorSize sensor,
                   uint32_t events)
      : device_(device),
        sensor_(sensor),
        submission_events_(events),
        window_(parameters.window),
        accumulation_(parameters.accumulation) {}

  uint32_t pixels() const { return static_cast<uint32_t>(sensor_.width) * sensor_.height; }
  Part counts_part() const { return {&counts_, pixels() * sizeof(uint32_t)}; }

  Result<void> build(const Levels& levels) {
    PipelineBuilder b(device_);
    b.buffer(counts_, "the counts", pixels() * sizeof(uint32_t));
    b.kernel(count_, "time_window_count", shaders::time_window_count, 3, sizeof(layout::TimeWindowPush));
    tone_.build(b, levels, pixels());
    tone_.bind(b, tone_counts_, counts_);
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

  Result<void> bind_log(const EventLogMemory& memory) override {
    PipelineBuilder b(device_);
    BoundKernel bound;
    b.bind(bound, count_, {&memory.events, &log_->length(), &counts_});
    if (!b.result()) return b.result();
    bound_count_ = std::move(bound);
    return {};
  }

  // The largest time is asked of the log, because that of the stream may be of events yet to be recorded.
  Result<void> drop_old_events() override {
    const auto t_max = log_->largest_time();
    if (!t_max) return t_max.error();
    const int64_t since = window_begin(*t_max, window_);
    layout::EventLogPush push{};
    push.since_low = low_word(since);
    push.since_high = high_word(since);
    return log_->run([&](Commands& c) {
      log_->record_keep(c, EventLog::From::events, push);
      log_->record_copy_back(c);
    });
  }

  void record_count(Commands& commands, const StreamFacts& facts, std::optional<int64_t> now) {
    const int64_t t_max = facts.largest.value_or(INT64_MIN);
    const int64_t since = window_begin(std::max(t_max, now.value_or(t_max)), window_);
    const layout::TimeWindowPush push = {log_->bound(), static_cast<uint32_t>(sensor_.width), low_word(since),
                                         high_word(since)};
    commands.fill(counts_, 0);
    commands.barrier();
    commands.dispatch(bound_count_, push.events, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("count");
  }

  // The picture, and what `level` says where a count is beyond the table: if there can be such counts at all.
  template <class T, class Level>
  Answer<Image<T>> picture(Level level) {
    Answer<Image<T>> answer = image_answer<T>(tone_.picture(), sensor_);
    if (log_->bound() <= kTableEnd) return answer;
    answer.parts.push_back(counts_part());
    answer.read = [read = std::move(answer.read), level](HostParts parts) -> Result<Image<T>> {
      Result<Image<T>> image = read(parts);
      if (!image) return image;
      const auto* counts = static_cast<const uint32_t*>(parts[1]);
      for (size_t i = 0; i < image->pixels.size(); ++i) {
        if (counts[i] > kTableEnd) image->pixels[i] = level(counts[i]);
      }
      return image;
    };
    return answer;
  }

  // An answer made from the listed events.
  template <class T, class Function>
  Answer<T> listed(const StreamFacts& facts, Function function) {
    const int64_t since = window_begin(facts.largest.value_or(INT64_MIN), window_);
    return {{{&log_->events(), uint64_t{log_->bound()} * sizeof(Event)}, {&log_->length(), sizeof(uint32_t)}},
            [since, function, known = log_->length_reader()](HostParts parts) -> Result<T> {
              known(parts[1]);
              std::vector<Event> events = events_of(parts[0], parts[1]);
              std::erase_if(events, [since](const Event& e) { return e.t < since; });
              return function(std::move(events));
            }};
  }

  vulkan::Device& device_;
  const SensorSize sensor_;
  const uint32_t submission_events_;
  const int64_t window_;
  const double accumulation_;
  uint64_t bytes_ = 0;
  Buffer counts_;
  Kernel count_;
  Tone tone_;
  Tone::Source tone_counts_;
  std::unique_ptr<EventLog> log_;
  BoundKernel bound_count_;
};

}  // namespace

MadePipeline make_time_window_counts(vulkan::Device& device, const TimeWindowParameters& p, SensorSize sensor,
                                     const GpuOptions& options) {
  return TimeWindowCounts::create(device, p, sensor, options);
}

}  // namespace scarf
