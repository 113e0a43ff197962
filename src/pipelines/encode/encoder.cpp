#include "pipelines/encode/encoder.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "compiled_shaders/shaders.h"
#include "core/encoding_tables.h"
#include "core/sensor_check.h"
#include "core/text.h"
#include "kernels/scan.h"
#include "shaders/encode/encode_layout.h"

namespace scarf {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

namespace {

constexpr uint64_t kWord = sizeof(uint32_t);
constexpr size_t kPush = sizeof(layout::EncodePush);

static_assert(layout::kEncodeWeightBits == kWeightBits && layout::kEncodeToreOldest == kToreOldest);

// What all encodings have: the span of times, and the tensor.
class EncoderBase : public Encoder {
 public:
  EncoderBase(vulkan::Device& device, EncodingShape shape, SensorSize sensor)
      : device_(device), shape_(shape), sensor_(sensor) {}

  Result<void> finish_build(uint64_t most_events) {
    PipelineBuilder b(device_);
    b.buffer(tensor_, "the tensor", values() * sizeof(float));
    b.buffer(span_, "the span of times", layout::kSpanWords * kWord);
    b.kernel(span_kernel_, "encode_span", shaders::encode_span, 4, kPush);
    build(b, most_events);
    bytes_ = b.bytes();
    return b.result();
  }

  Result<std::unique_ptr<Bound>> bind(const DeviceEvents& events) const override {
    auto bound = std::make_unique<Bound>();
    bound->events = events;
    if (events.second == nullptr) bound->events.second = events.first;
    PipelineBuilder b(device_);
    const DeviceEvents& e = bound->events;
    b.bind(bound->span, span_kernel_, {e.first, e.second, e.total, &span_});
    bind_stages(b, *bound);
    if (!b.result()) return b.result().error();
    return bound;
  }

  void record(Commands& commands, const Bound& bound) const override {
    layout::EncodePush push = event_push(bound);
    commands.fill(span_, 0);
    clear(commands);
    commands.barrier();
    for (push.mode = 0; push.mode < 2; ++push.mode) over_events(commands, bound.span, push);
    commands.mark("span");
    record_stages(commands, bound);
    commands.mark("encode");
  }

  const Buffer& tensor() const override { return tensor_; }
  EncodingShape shape() const override { return shape_; }
  uint64_t memory_bytes() const override { return bytes_; }

 protected:
  virtual void build(PipelineBuilder& b, uint64_t most_events) = 0;
  virtual void bind_stages(PipelineBuilder& b, Bound& bound) const = 0;
  /// Makes ready what the stages add to.
  virtual void clear(Commands& commands) const = 0;
  virtual void record_stages(Commands& commands, const Bound& bound) const = 0;

  uint64_t area() const { return static_cast<uint64_t>(sensor_.width) * sensor_.height; }
  uint64_t values() const { return area() * shape_.planes; }

  layout::EncodePush event_push(const Bound& bound) const {
    layout::EncodePush push{};
    push.most_events = static_cast<uint32_t>(bound.events.most_events);
    push.first_events = static_cast<uint32_t>(bound.events.first_events);
    push.width = static_cast<uint32_t>(sensor_.width);
    push.height = static_cast<uint32_t>(sensor_.height);
    push.values = static_cast<uint32_t>(values());
    return push;
  }
  static void over_events(Commands& commands, const BoundKernel& kernel, const layout::EncodePush& push) {
    commands.dispatch(kernel, push.most_events, layout::kLinearGroup, push);
    commands.barrier();
  }
  static void over_values(Commands& commands, const BoundKernel& kernel, const layout::EncodePush& push) {
    commands.dispatch(kernel, push.values, layout::kLinearGroup, push);
    commands.barrier();
  }

  vulkan::Device& device_;
  const EncodingShape shape_;
  const SensorSize sensor_;
  Buffer tensor_, span_;

 private:
  uint64_t bytes_ = 0;
  Kernel span_kernel_;
};

// Sums of weights, or counts and weights, that become floats in the end.
class SumEncoder final : public EncoderBase {
 public:
  // bins: of a voxel grid; 0: the event image.
  SumEncoder(vulkan::Device& device, EncodingShape shape, SensorSize sensor, uint32_t bins)
      : EncoderBase(device, shape, sensor), bins_(bins) {}

 private:
  uint32_t words_per_sum() const { return bins_ != 0 ? 2 : 1; }

  void build(PipelineBuilder& b, uint64_t) override {
    b.buffer(sums_, "the sums of the encoding", values() * words_per_sum() * kWord);
    if (bins_ != 0)
      b.kernel(add_, "encode_voxel", shaders::encode_voxel, 5, kPush);
    else
      b.kernel(add_, "encode_event_image", shaders::encode_event_image, 5, kPush);
    b.kernel(float_, "encode_float", shaders::encode_float, 2, kPush);
    b.bind(bound_float_, float_, {&sums_, &tensor_});
  }

  void bind_stages(PipelineBuilder& b, Bound& bound) const override {
    const DeviceEvents& e = bound.events;
    b.bind(bound.stages[0], add_, {e.first, e.second, e.total, &span_, &sums_});
  }

  void clear(Commands& commands) const override { commands.fill(sums_, 0); }

  void record_stages(Commands& commands, const Bound& bound) const override {
    layout::EncodePush push = event_push(bound);
    push.planes = bins_;
    push.mode = static_cast<uint32_t>(shape_.planes) == 2 * bins_ ? 1 : 0;
    over_events(commands, bound.stages[0], push);
    push.mode = words_per_sum();
    over_values(commands, bound_float_, push);
  }

  const uint32_t bins_;
  Buffer sums_;
  Kernel add_, float_;
  BoundKernel bound_float_;
};

class TimeSurfaceEncoder final : public EncoderBase {
 public:
  TimeSurfaceEncoder(vulkan::Device& device, EncodingShape shape, SensorSize sensor, int64_t tau)
      : EncoderBase(device, shape, sensor), tau_(tau) {}

  // Ages from here on have the value 0: exp(-18) * 2^24 is less than half.
  static int64_t table_entries(int64_t tau) { return 18 * tau + 1; }

 private:
  void build(PipelineBuilder& b, uint64_t) override {
    std::vector<float> decays(table_entries(tau_));
    for (size_t age = 0; age < decays.size(); ++age) {
      const int64_t weight = decay_weight(age, tau_);
      if (weight == 0) break;
      decays[age] = static_cast<float>(weight) / static_cast<float>(kWeightOne);  // exact
    }
    last_entry_ = static_cast<uint32_t>(decays.size() - 1);
    b.table<float>(decays_, "the table of decays", decays);
    b.buffer(ages_, "the ages", values() * 2 * kWord);
    b.kernel(newest_, "encode_newest", shaders::encode_newest, 5, kPush);
    b.kernel(decay_, "encode_decay", shaders::encode_decay, 3, kPush);
    b.bind(bound_decay_, decay_, {&ages_, &decays_, &tensor_});
  }

  void bind_stages(PipelineBuilder& b, Bound& bound) const override {
    const DeviceEvents& e = bound.events;
    b.bind(bound.stages[0], newest_, {e.first, e.second, e.total, &span_, &ages_});
  }

  void clear(Commands& commands) const override { commands.fill(ages_, 0); }

  void record_stages(Commands& commands, const Bound& bound) const override {
    layout::EncodePush push = event_push(bound);
    for (push.mode = 0; push.mode < 2; ++push.mode) over_events(commands, bound.stages[0], push);
    push.end = last_entry_;
    over_values(commands, bound_decay_, push);
  }

  const int64_t tau_;
  uint32_t last_entry_ = 0;
  Buffer decays_, ages_;
  Kernel newest_, decay_;
  BoundKernel bound_decay_;
};

class ToreEncoder final : public EncoderBase {
 public:
  ToreEncoder(vulkan::Device& device, EncodingShape shape, SensorSize sensor, uint32_t k)
      : EncoderBase(device, shape, sensor), k_(k) {}

 private:
  uint64_t lists() const { return 2 * area(); }

  void build(PipelineBuilder& b, uint64_t most_events) override {
    b.buffer(cursors_, "the lists of events per pixel", lists() * kWord);
    b.buffer(places_, "the events by pixel", std::max<uint64_t>(1, most_events) * 4 * kWord);
    b.table<float>(values_by_age_, "the table of TORE", tore_table());
    b.kernel(count_, "encode_tore_count", shaders::encode_tore_count, 4, kPush);
    b.kernel(place_, "encode_tore_place", shaders::encode_tore_place, 5, kPush);
    b.kernel(rank_, "encode_tore_rank", shaders::encode_tore_rank, 8, kPush);
    sum_.build(b, lists());
    sum_.bind(b, sum_cursors_, cursors_);
  }

  void bind_stages(PipelineBuilder& b, Bound& bound) const override {
    const DeviceEvents& e = bound.events;
    b.bind(bound.stages[0], count_, {e.first, e.second, e.total, &cursors_});
    b.bind(bound.stages[1], place_, {e.first, e.second, e.total, &cursors_, &places_});
    b.bind(bound.stages[2], rank_,
           {e.first, e.second, e.total, &span_, &cursors_, &places_, &values_by_age_, &tensor_});
  }

  void clear(Commands& commands) const override {
    commands.fill(cursors_, 0);
    commands.fill(tensor_, std::bit_cast<uint32_t>(tore_value(kToreOldest)));
  }

  void record_stages(Commands& commands, const Bound& bound) const override {
    layout::EncodePush push = event_push(bound);
    push.planes = k_;
    over_events(commands, bound.stages[0], push);
    sum_.record(commands, sum_cursors_, static_cast<uint32_t>(lists()));
    over_events(commands, bound.stages[1], push);
    // A pixel may have all the events, as far as is known.
    const uint64_t known = bound.events.most_per_pixel;
    const auto longest = static_cast<uint32_t>(known != 0 ? std::min(known, bound.events.most_events)
                                                          : bound.events.most_events);
    const uint32_t part = device_.limits().loop_trips - 1;
    for (push.begin = 0; push.begin < longest; push.begin = push.end) {
      push.end = push.begin + std::min(part, longest - push.begin);
      over_events(commands, bound.stages[2], push);
    }
  }

  const uint32_t k_;
  Buffer cursors_, places_, values_by_age_;
  Kernel count_, place_, rank_;
  PrefixSum sum_;
  PrefixSum::Source sum_cursors_;
};

// Makes the encoder of each kind of parameters.
struct Maker {
  using Made = Result<std::unique_ptr<EncoderBase>>;
  vulkan::Device& device;
  EncodingShape shape;
  SensorSize sensor;

  Made operator()(const VoxelGridParameters& p) const {
    return {std::make_unique<SumEncoder>(device, shape, sensor, static_cast<uint32_t>(p.bins))};
  }
  Made operator()(const EventImageParameters&) const {
    return {std::make_unique<SumEncoder>(device, shape, sensor, 0)};
  }
  Made operator()(const ToreParameters& p) const {
    return {std::make_unique<ToreEncoder>(device, shape, sensor, static_cast<uint32_t>(p.k))};
  }
  Made operator()(const TimeSurfaceParameters& p) const {
    const uint64_t most = device.limits().storage_range / sizeof(float);
    const auto entries = static_cast<uint64_t>(TimeSurfaceEncoder::table_entries(p.tau));
    if (entries > most) {
      return Error{ErrorCode::illegal_parameter, text("encoding time_surface: tau is ", p.tau,
                                                      ", legal on this device is 1 to ", (most - 1) / 18)};
    }
    return {std::make_unique<TimeSurfaceEncoder>(device, shape, sensor, p.tau)};
  }
  Made operator()(const HatsParameters&) const { return cpu_only("hats"); }
  Made operator()(const HotsParameters&) const { return cpu_only("hots"); }

  static Error cpu_only(const char* name) {
    return {ErrorCode::illegal_parameter, text("encoding ", name, " is on the CPU only: use scarf::encode")};
  }
};

}  // namespace

Result<std::unique_ptr<Encoder>> Encoder::create(vulkan::Device& device, const EncodingParameters& parameters,
                                                 SensorSize sensor, uint64_t most_events) {
  const auto checked = checked_encoding(parameters);
  if (!checked) return checked.error();
  if (auto r = check_sensor(sensor); !r) return r.error();
  auto encoder = std::visit(Maker{device, shape_of(*checked, sensor), sensor}, *checked);
  if (!encoder) return encoder.error();
  if (auto r = (*encoder)->finish_build(most_events); !r) return r.error();
  return std::unique_ptr<Encoder>(std::move(*encoder));
}

}  // namespace scarf
