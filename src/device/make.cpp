// Any representation on a device, behind the public interface.
#include "device/on_device.h"
#include "pipelines/base/pipelines.h"

namespace scarf {
namespace {

class DeviceRepresentation final : public OnDevice<GpuRepresentation> {
 public:
  DeviceRepresentation(Feed feed, ImagePipeline& pipeline, bool queries_change_state)
      : OnDevice(std::move(feed)),
        pipeline_(filtered_ != nullptr ? *filtered_ : pipeline),
        queries_change_state_(queries_change_state) {}

  SensorSize sensor() const override { return pipeline_.sensor(); }

  U8Picture u8_picture() const override {
    return {[&pipeline = pipeline_](Query& q, const StreamFacts& facts, std::optional<int64_t> now) {
              return pipeline.record_u8(q.commands, facts, now);
            },
            queries_change_state_};
  }

  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) override {
    const U8Picture picture = u8_picture();
    return stream_->query<Image<uint8_t>>(
        QueryKind::image, [&](Query& q, const StreamFacts& facts) { return picture.record(q, facts, now); },
        picture.changes_state);
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) override {
    return stream_->query<Image<float>>(
        QueryKind::image,
        [&](Query& q, const StreamFacts& facts) { return pipeline_.record_float(q.commands, facts, now); },
        queries_change_state_);
  }
  Pending<Image<int64_t>> raw_image() override {
    return stream_->query<Image<int64_t>>(
        QueryKind::state,
        [&](Query& q, const StreamFacts& facts) { return pipeline_.record_raw(q.commands, facts); },
        queries_change_state_);
  }
  Pending<std::vector<Event>> events() override {
    return stream_->query<std::vector<Event>>(QueryKind::events, [&](Query& q, const StreamFacts& facts) {
      return pipeline_.record_events(q.commands, facts);
    });
  }
  Pending<std::vector<uint8_t>> state() override {
    return stream_->query<std::vector<uint8_t>>(QueryKind::state, [&](Query& q, const StreamFacts& facts) {
      return pipeline_.record_state(q.commands, facts);
    });
  }

 private:
  ImagePipeline& pipeline_;  // of the stream
  const bool queries_change_state_;
};

// Makes the pipeline of each kind of parameters.
struct Maker {
  vulkan::Device& device;
  SensorSize sensor;
  const GpuOptions& options;

  MadePipeline operator()(const ScarfParameters&) const { return std::unique_ptr<ImagePipeline>(); }
  MadePipeline operator()(const TimeWindowParameters& p) const {
    return make_time_window(device, p, sensor, options);
  }
  MadePipeline operator()(const SaeParameters& p) const { return make_sae(device, p, sensor, options); }
  MadePipeline operator()(const ErosParameters& p) const { return make_eros(device, p, sensor, options); }
  MadePipeline operator()(const TosParameters& p) const { return make_tos(device, p, sensor, options); }
  MadePipeline operator()(const SitsParameters& p) const { return make_sits(device, p, sensor, options); }
  MadePipeline operator()(const ChainSaeParameters& p) const {
    return make_chain_sae(device, p, sensor, options);
  }
  MadePipeline operator()(const AedSaeParameters& p) const {
    return make_aed_sae(device, p, sensor, options);
  }
  MadePipeline operator()(const AaeParameters& p) const { return make_aae(device, p, sensor, options); }
};

// Whether pictures depend on the time of the newest event.
bool asks_for_newest(const Parameters& parameters) {
  return std::holds_alternative<TimeWindowParameters>(parameters) ||
         std::holds_alternative<SaeParameters>(parameters);
}

Result<std::unique_ptr<GpuRepresentation>> make(std::shared_ptr<GpuContext> context,
                                                const Parameters& parameters, SensorSize sensor,
                                                const GpuOptions& options,
                                                std::span<const FilterParameters> filters) {
  if (auto r = check_context(context); !r) return r.error();
  const auto checked = checked_parameters(parameters);
  if (!checked) return checked.error();
  if (const auto* window = std::get_if<TimeWindowParameters>(&*checked);
      window != nullptr && window->counts && !filters.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 "time_window with counts cannot stand behind filters on a device; filter the events with "
                 "make_reference_filter before the push, or leave out counts"};
  }
  if (const auto* p = std::get_if<ScarfParameters>(&*checked)) {
    const auto geometry = make_geometry(p->preset, sensor, p->grid);
    if (!geometry) return geometry.error();
    auto scarf = make_gpu_scarf(std::move(context), *geometry, p->accumulation, options, filters);
    if (!scarf) return scarf.error();
    return std::unique_ptr<GpuRepresentation>(std::move(*scarf));
  }
  auto pipeline = std::visit(Maker{context->vulkan(), sensor, options}, *checked);
  if (!pipeline) return pipeline.error();
  ImagePipeline& images = **pipeline;
  auto feed = Feed::create(std::move(context), std::move(*pipeline), &images, asks_for_newest(*checked),
                           options, filters);
  if (!feed) return feed.error();
  return std::unique_ptr<GpuRepresentation>(
      std::make_unique<DeviceRepresentation>(std::move(*feed), images, query_changes_state(*checked)));
}

}  // namespace

Result<std::unique_ptr<GpuRepresentation>> make_gpu_representation(
    std::shared_ptr<GpuContext> context, const Parameters& parameters, SensorSize sensor,
    const GpuOptions& options, std::span<const FilterParameters> filters) {
  return as_result([&] { return make(std::move(context), parameters, sensor, options, filters); });
}

}  // namespace scarf
