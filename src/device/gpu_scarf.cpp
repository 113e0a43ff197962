// SCARF on a device behind the public interface: its queries.
#include <algorithm>
#include <cstring>

#include "core/queries.h"
#include "device/on_device.h"
#include "layout/packed_event.h"
#include "layout/ring_head.h"
#include "pipelines/encode/encoder.h"
#include "pipelines/scarf/pipeline.h"
#include "scarf/device/encoder.h"
#include "scarf/device/stream.h"

namespace scarf {
namespace {

Snapshot unpack_state(const Geometry& g, int64_t t_first, const uint32_t* heads, const uint64_t* laps,
                      const uint64_t* slots) {
  Snapshot s;
  s.geometry = g;
  s.totals.resize(g.patches());
  s.slots.resize(g.patches() * g.capacity);
  for (int64_t patch = 0; patch < g.patches(); ++patch) {
    s.totals[patch] = ring_total(heads[patch], laps[patch], g.capacity);
    const int32_t x = g.x.field_begin(static_cast<int32_t>(patch % g.x.grid));
    const int32_t y = g.y.field_begin(static_cast<int32_t>(patch / g.x.grid));
    const int64_t ring = patch * g.capacity;
    for (int64_t i = ring; i < ring + s.filled(patch); ++i) s.slots[i] = unpack(slots[i], x, y, t_first);
  }
  return s;
}

// Extracts the active events and encodes them, in one submission.
class DeviceEncoder final : public GpuEncoder {
 public:
  DeviceEncoder(vulkan::Device& device, std::shared_ptr<Stream> stream, const ScarfPipeline& pipeline)
      : device_(device), stream_(std::move(stream)), pipeline_(pipeline) {}

  ~DeviceEncoder() override {
    // Nothing may be destroyed while the device uses it.
    if (!device_.forked() && !stream_->finish()) device_.calls().DeviceWaitIdle(device_.handle());
  }

  Result<void> build(const EncodingParameters& parameters, const Geometry& geometry) {
    auto memory = pipeline_.make_extract_memory();
    if (!memory) return memory.error();
    memory_ = std::move(*memory);
    const uint64_t half = pipeline_.half_events();
    const DeviceEvents events = {&memory_->first, &memory_->second,
                                 &memory_->total, half,
                                 2 * half,        static_cast<uint64_t>(geometry.capacity)};
    auto encoder = Encoder::create(device_, parameters, geometry.sensor(), events.most_events);
    if (!encoder) return encoder.error();
    encoder_ = std::move(*encoder);
    auto bound = encoder_->bind(events);
    if (!bound) return bound.error();
    bound_ = std::move(*bound);
    return {};
  }

  Pending<Image<float>> encode() override {
    const auto record = [&](Query& q, const StreamFacts& facts) -> Result<Answer<Image<float>>> {
      pipeline_.record_extract(q.commands, *memory_, 0, pipeline_.plan().patches, /*active_only=*/true,
                               facts.first.value_or(0));
      encoder_->record(q.commands, *bound_);
      const EncodingShape shape = encoder_->shape();
      return image_answer<float>(encoder_->tensor(), {shape.width, shape.height}, shape.planes);
    };
    return stream_->query<Image<float>>(QueryKind::image, record);
  }

 private:
  vulkan::Device& device_;
  std::shared_ptr<Stream> stream_;
  const ScarfPipeline& pipeline_;  // of the stream
  std::unique_ptr<ExtractMemory> memory_;
  std::unique_ptr<Encoder> encoder_;
  std::unique_ptr<Encoder::Bound> bound_;
};

class DeviceScarf final : public OnDevice<GpuScarf> {
 public:
  DeviceScarf(Feed feed, ScarfPipeline& pipeline, const Geometry& geometry)
      : OnDevice(std::move(feed)), pipeline_(pipeline), geometry_(geometry) {}

  const Geometry& geometry() const override { return geometry_; }

  Result<std::unique_ptr<GpuEncoder>> make_encoder(const EncodingParameters& parameters) {
    if (auto r = stream_->device().check_process(); !r) return r.error();
    auto encoder = std::make_unique<DeviceEncoder>(stream_->device(), stream_, pipeline_);
    if (auto r = encoder->build(parameters, geometry_); !r) return r.error();
    return std::unique_ptr<GpuEncoder>(std::move(encoder));
  }

  U8Picture u8_picture() const override {
    return {[&pipeline = pipeline_, sensor = geometry_.sensor()](
                Query& q, const StreamFacts&, std::optional<int64_t>) -> Result<Answer<Image<uint8_t>>> {
      return image_answer<uint8_t>(pipeline.record_u8(q.commands, PolarityMode::merged), sensor);
    }};
  }

  Pending<Image<int32_t>> count_image(PolarityMode mode) override {
    return image<int32_t>(mode, &ScarfPipeline::record_counts);
  }
  Pending<Image<uint8_t>> u8_planes(PolarityMode mode) override {
    return as_result([&]() -> Pending<Image<uint8_t>> {
      if (auto r = check_dense_mode(mode); !r) return r.error();
      return image<uint8_t>(mode, &ScarfPipeline::record_u8);
    });
  }
  Pending<Image<float>> float_planes(PolarityMode mode) override {
    return as_result([&]() -> Pending<Image<float>> {
      if (auto r = check_dense_mode(mode); !r) return r.error();
      return image<float>(mode, &ScarfPipeline::record_float);
    });
  }
  Pending<std::vector<Event>> active_events(EventOrder order) override {
    return extract(0, geometry_.patches(), /*active_only=*/true, order);
  }
  Pending<std::vector<Event>> patch_events(int64_t patch, bool active_only) override {
    return as_result([&]() -> Pending<std::vector<Event>> {
      if (auto r = check_patch(geometry_, patch); !r) return r.error();
      return extract(patch, 1, active_only, EventOrder::by_patch);
    });
  }

  Pending<Snapshot> snapshot() override {
    return stream_->query<Snapshot>(
        QueryKind::state, [&](Query&, const StreamFacts& facts) -> Result<Answer<Snapshot>> {
          const int64_t t_first = facts.first.value_or(0);
          const auto read = [g = geometry_, t_first](HostParts parts) -> Result<Snapshot> {
            return unpack_state(g, t_first, static_cast<const uint32_t*>(parts[0]),
                                static_cast<const uint64_t*>(parts[1]),
                                static_cast<const uint64_t*>(parts[2]));
          };
          const vulkan::Buffer& heads = pipeline_.heads();
          const vulkan::Buffer& laps = pipeline_.laps();
          const vulkan::Buffer& slots = pipeline_.slots();
          const uint64_t state_bytes = geometry_.patches() * geometry_.capacity * sizeof(uint64_t);
          return Answer<Snapshot>{{{&heads, geometry_.patches() * sizeof(uint32_t)},
                                   {&laps, geometry_.patches() * sizeof(uint64_t)},
                                   {&slots, state_bytes}},
                                  read};
        });
  }

 private:
  template <class T>
  Pending<Image<T>> image(PolarityMode mode,
                          const vulkan::Buffer& (ScarfPipeline::*record)(vulkan::Commands&, PolarityMode)
                              const) {
    const auto recorded = [&](Query& q, const StreamFacts&) -> Result<Answer<Image<T>>> {
      const vulkan::Buffer& pixels = (pipeline_.*record)(q.commands, mode);
      return image_answer<T>(pixels, sensor(), mode == PolarityMode::separate ? 2 : 1);
    };
    return stream_->query<Image<T>>(QueryKind::image, recorded);
  }

  Pending<std::vector<Event>> extract(int64_t first, int64_t count, bool active_only, EventOrder order) {
    using Events = std::vector<Event>;
    const auto record = [&](Query& q, const StreamFacts& facts) -> Result<Answer<Events>> {
      if (!q.memory) {
        auto memory = pipeline_.make_extract_memory();
        if (!memory) return memory.error();
        q.memory = std::move(*memory);
      }
      const auto& memory = static_cast<const ExtractMemory&>(*q.memory);
      pipeline_.record_extract(q.commands, memory, static_cast<uint32_t>(first), static_cast<uint32_t>(count),
                               active_only, facts.first.value_or(0));
      const uint64_t half = pipeline_.half_events();
      return Answer<Events>{{}, [&memory, half, order](HostParts) -> Result<Events> {
                              const uint64_t total = *memory.total.mapped_as<uint32_t>();
                              const uint64_t in_first = std::min(total, half);
                              Events events(total);
                              std::copy_n(memory.first.mapped_as<Event>(), in_first, events.begin());
                              std::copy_n(memory.second.mapped_as<Event>(), total - in_first,
                                          events.begin() + static_cast<std::ptrdiff_t>(in_first));
                              return ordered(std::move(events), order);
                            }};
    };
    return stream_->query<Events>(QueryKind::events, record);
  }

  ScarfPipeline& pipeline_;  // of the stream
  const Geometry geometry_;
};

Result<std::unique_ptr<GpuScarf>> make(std::shared_ptr<GpuContext> context, const Geometry& geometry,
                                       double accumulation, const GpuOptions& options,
                                       std::span<const FilterParameters> filters) {
  if (auto r = check_context(context); !r) return r.error();
  const auto checked = checked_geometry(geometry);
  if (!checked) return checked.error();
  const auto levels = make_levels(accumulation, geometry.capacity);
  if (!levels) return levels.error();
  vulkan::Device& device = context->vulkan();
  const auto plan = make_plan(*checked, levels->u8, device.limits(), options);
  if (!plan) return plan.error();
  auto pipeline = ScarfPipeline::create(device, *checked, *levels, *plan);
  if (!pipeline) return pipeline.error();
  ScarfPipeline& scarf = **pipeline;
  auto feed = Feed::create(std::move(context), std::move(*pipeline), /*images=*/nullptr,
                           /*asks_for_newest=*/false, options, filters);
  if (!feed) return feed.error();
  return std::unique_ptr<GpuScarf>(std::make_unique<DeviceScarf>(std::move(*feed), scarf, *checked));
}

}  // namespace

Result<std::unique_ptr<GpuScarf>> make_gpu_scarf(std::shared_ptr<GpuContext> context,
                                                 const Geometry& geometry, double accumulation,
                                                 const GpuOptions& options,
                                                 std::span<const FilterParameters> filters) {
  return as_result([&] { return make(std::move(context), geometry, accumulation, options, filters); });
}

Result<std::unique_ptr<GpuEncoder>> make_gpu_encoder(GpuScarf& scarf, const EncodingParameters& parameters) {
  return as_result([&]() -> Result<std::unique_ptr<GpuEncoder>> {
    auto* const device = dynamic_cast<DeviceScarf*>(&scarf);
    if (device != nullptr) return device->make_encoder(parameters);
    return Error{ErrorCode::illegal_parameter,
                 "this GpuScarf was not made by make_gpu_scarf; encode its active_events() instead"};
  });
}

}  // namespace scarf
