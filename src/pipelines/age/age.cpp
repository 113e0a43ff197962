// eros and tos on a device: the age of each pixel, which is how many events fell into its window since its
// own last event, and a brightness table over it.
#include "compiled_shaders/shaders.h"
#include "core/little_endian.h"
#include "core/sensor_check.h"
#include "core/tables.h"
#include "kernels/last_event.h"
#include "kernels/submission.h"
#include "kernels/tone.h"
#include "pipelines/base/pipelines.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

// Ages have 31 bits on the device and are cut to 65,534 before so many events could overrun them.
constexpr uint64_t kEventsBeforeCut = uint64_t{1} << 30;

struct AgeBinding : EventBinding {
  BoundKernel last_event, start, count;
};

class AgePipeline final : public ImagePipeline {
 public:
  static MadePipeline create(vulkan::Device& device, int32_t kernel, const Levels& levels, SensorSize sensor,
                             const GpuOptions& options) {
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (auto r = check_options(options); !r) return r.error();
    std::unique_ptr<AgePipeline> p(
        new AgePipeline(device, kernel, sensor, scarf::submission_events(options, device.limits())));
    PipelineBuilder builder(device);
    p->build(builder, levels);
    if (!builder.result()) return builder.result().error();
    p->bytes_ = builder.bytes();
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override { return bytes_; }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto binding = std::make_unique<AgeBinding>();
    PipelineBuilder b(device_);
    last_event_.bind(b, binding->last_event, events);
    b.bind(binding->start, start_, {&events, &last_event_.entries(), &ages_});
    b.bind(binding->count, count_, {&events, &last_event_.entries(), &ages_});
    if (!b.result()) return b.result().error();
    return std::unique_ptr<EventBinding>(std::move(binding));
  }

  void record_reset(Commands& commands) override {
    last_event_.record_reset(commands);
    commands.fill(ages_, layout::kAgeNever);
    commands.mark("reset");
  }

  Result<void> prepare_push(uint32_t count) override {
    if (auto r = last_event_.make_room(count); !r) return r;
    if (events_since_cut_ + count <= kEventsBeforeCut) return {};
    const layout::AgeLimitPush cut = {pixels(), layout::kAgeNever};
    const auto record = [&](Commands& c) { c.dispatch(bound_cut_, pixels(), layout::kLinearGroup, cut); };
    if (auto r = run_alone(device_, record); !r) return r;
    events_since_cut_ = 0;
    return {};
  }

  void record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts&) override {
    const auto& bound = static_cast<const AgeBinding&>(binding);
    events_since_cut_ += count;
    layout::SurfacePush push = last_event_.record(commands, bound.last_event, first, count);
    push.reach = reach_;
    commands.dispatch(bound.start, count, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("start");
    commands.dispatch(bound.count, count, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("count");
  }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts&,
                                           std::optional<int64_t>) override {
    record_shown(commands);
    tone_.record_u8(commands, tone_shown_, pixels());
    return image_answer<uint8_t>(tone_.picture(), sensor_);
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts&,
                                            std::optional<int64_t>) override {
    record_shown(commands);
    tone_.record_float(commands, tone_shown_, pixels());
    return image_answer<float>(tone_.picture(), sensor_);
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands& commands, const StreamFacts&) override {
    record_shown(commands);
    const auto read = [s = sensor_, n = pixels()](HostParts parts) -> Result<Image<int64_t>> {
      Image<int64_t> raw(s.width, s.height);
      const auto* ages = static_cast<const uint32_t*>(parts[0]);
      raw.pixels.assign(ages, ages + n);
      return raw;
    };
    return Answer<Image<int64_t>>{{{&shown_, pixels() * sizeof(uint32_t)}}, read};
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands& commands, const StreamFacts&) override {
    record_shown(commands);
    const auto read = [n = pixels()](HostParts parts) -> Result<std::vector<uint8_t>> {
      const auto* ages = static_cast<const uint32_t*>(parts[0]);
      std::vector<uint8_t> bytes;
      for (uint32_t i = 0; i < n; ++i) append_little_endian(bytes, static_cast<uint16_t>(ages[i]));
      return bytes;
    };
    return Answer<std::vector<uint8_t>>{{{&shown_, pixels() * sizeof(uint32_t)}}, read};
  }

 private:
  AgePipeline(vulkan::Device& device, int32_t kernel, SensorSize sensor, uint32_t events)
      : device_(device),
        sensor_(sensor),
        submission_events_(events),
        reach_(static_cast<uint32_t>(kernel / 2)) {}

  uint32_t pixels() const { return static_cast<uint32_t>(sensor_.width) * sensor_.height; }

  void build(PipelineBuilder& b, const Levels& levels) {
    last_event_.build(b, sensor_, 1);
    b.buffer(ages_, "the ages", pixels() * sizeof(uint32_t));
    b.buffer(shown_, "the ages as they are shown", pixels() * sizeof(uint32_t));
    tone_.build(b, levels, pixels());
    b.kernel(start_, "age_start", shaders::age_start,
             {vulkan::View::vectors, vulkan::View::words, vulkan::View::storage},
             sizeof(layout::SurfacePush));
    b.kernel(count_, "age_count", shaders::age_count,
             {vulkan::View::vectors, vulkan::View::words, vulkan::View::storage},
             sizeof(layout::SurfacePush));
    b.kernel(limit_, "age_limit", shaders::age_limit, 2, sizeof(layout::AgeLimitPush));
    b.bind(bound_cut_, limit_, {&ages_, &ages_});
    b.bind(bound_show_, limit_, {&ages_, &shown_});
    tone_.bind(b, tone_shown_, shown_);
  }

  void record_shown(Commands& commands) const {
    const layout::AgeLimitPush push = {pixels(), kNeverFiredAge};
    commands.dispatch(bound_show_, pixels(), layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("limit");
  }

  vulkan::Device& device_;
  const SensorSize sensor_;
  const uint32_t submission_events_;
  const uint32_t reach_;  // pixels of the window on each side of its centre
  uint64_t bytes_ = 0;
  uint64_t events_since_cut_ = 0;
  LastEvent last_event_;
  Buffer ages_, shown_;
  Tone tone_;
  Kernel start_, count_, limit_;
  BoundKernel bound_cut_, bound_show_;
  Tone::Source tone_shown_;
};

}  // namespace

MadePipeline make_eros(vulkan::Device& device, const ErosParameters& p, SensorSize sensor,
                       const GpuOptions& options) {
  return AgePipeline::create(device, p.kernel, eros_table(p.kernel, p.decay), sensor, options);
}

MadePipeline make_tos(vulkan::Device& device, const TosParameters& p, SensorSize sensor,
                      const GpuOptions& options) {
  return AgePipeline::create(device, p.kernel, tos_table(p.kernel, p.decay), sensor, options);
}

}  // namespace scarf
