// Any representation on a device, behind the public interface.
#include "representations/make.h"

#include "gpu/on_device.h"

namespace scarf {
namespace {

class DeviceRepresentation final : public OnDevice<GpuRepresentation> {
 public:
  DeviceRepresentation(std::shared_ptr<Stream> stream, ImagePipeline& pipeline, bool queries_change_state)
      : OnDevice(std::move(stream)), pipeline_(pipeline), queries_change_state_(queries_change_state) {}

  SensorSize sensor() const override { return pipeline_.sensor(); }

  Pending<Image<uint8_t>> u8_image(std::optional<int64_t> now) override {
    return stream_->query<Image<uint8_t>>(
        QueryKind::image,
        [&](Query& q, const StreamTimes& times) { return pipeline_.record_u8(q.commands, times, now); },
        queries_change_state_);
  }
  Pending<Image<float>> float_image(std::optional<int64_t> now) override {
    return stream_->query<Image<float>>(
        QueryKind::image,
        [&](Query& q, const StreamTimes& times) { return pipeline_.record_float(q.commands, times, now); },
        queries_change_state_);
  }
  Pending<Image<int64_t>> raw_image() override {
    return stream_->query<Image<int64_t>>(
        QueryKind::state,
        [&](Query& q, const StreamTimes& times) { return pipeline_.record_raw(q.commands, times); },
        queries_change_state_);
  }
  Pending<std::vector<Event>> events() override {
    return stream_->query<std::vector<Event>>(
        QueryKind::events,
        [&](Query& q, const StreamTimes& times) { return pipeline_.record_events(q.commands, times); });
  }
  Pending<std::vector<uint8_t>> state() override {
    return stream_->query<std::vector<uint8_t>>(
        QueryKind::state,
        [&](Query& q, const StreamTimes& times) { return pipeline_.record_state(q.commands, times); });
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

bool queries_change_state(const Parameters& parameters) {
  if (const auto* aae = std::get_if<AaeParameters>(&parameters)) return !aae->keep;
  const auto* chain = std::get_if<ChainSaeParameters>(&parameters);
  return chain != nullptr && chain->rule == ChainSaeParameters::Rule::event_driven;
}

}  // namespace

Result<std::unique_ptr<GpuRepresentation>> make_gpu_representation(std::shared_ptr<GpuContext> context,
                                                                   const Parameters& parameters,
                                                                   SensorSize sensor,
                                                                   const GpuOptions& options) {
  const auto checked = checked_parameters(parameters);
  if (!checked) return checked.error();
  if (const auto* p = std::get_if<ScarfParameters>(&*checked)) {
    const auto geometry = make_geometry(p->preset, sensor, p->grid);
    if (!geometry) return geometry.error();
    auto scarf = make_gpu_scarf(std::move(context), *geometry, p->accumulation, options);
    if (!scarf) return scarf.error();
    return std::unique_ptr<GpuRepresentation>(std::move(*scarf));
  }
  auto pipeline = std::visit(Maker{context->vulkan(), sensor, options}, *checked);
  if (!pipeline) return pipeline.error();
  ImagePipeline& images = **pipeline;
  auto stream = Stream::create(std::move(context), std::move(*pipeline), options);
  if (!stream) return stream.error();
  return std::unique_ptr<GpuRepresentation>(
      std::make_unique<DeviceRepresentation>(std::move(*stream), images, queries_change_state(*checked)));
}

}  // namespace scarf
