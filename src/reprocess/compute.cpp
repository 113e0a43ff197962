#include "reprocess/compute.h"

#include <utility>

#include "core/text.h"
#include "output/renderer.h"
#include "scarf/digest/digest.h"
#include "session/play.h"
#include "session/read_ahead.h"

namespace scarf::reprocess {
namespace {

// For pictures that are asked for because asking changes the state.
class NoWriter final : public FrameWriter {
 public:
  Result<void> write(const Frame& /*frame*/, const PictureView& /*picture*/) override { return {}; }
  Result<void> finish() override { return {}; }
};

Result<bool> pictures_matter(const Options& options) {
  if (options.stream.representation == "scarf") return false;
  const auto parameters = parameters_of(options.stream);
  if (!parameters) return parameters.error();
  return query_changes_state(*parameters);
}

FrameRequest with_side_file(FrameRequest frames, const std::string& recording) {
  if (!frames.at_times.empty()) frames.at_times = side_file(frames.at_times, recording);
  return frames;
}

bool has_sequence(const Options& options) {
  if (!options.products.sparse.empty()) return true;
  for (const std::string& output : options.outputs) {
    const auto kind = output_kind("recording" + output);
    if (kind && *kind != OutputKind::image) return true;
  }
  return false;
}

}  // namespace

std::string Machine::name() const {
  return context ? context->device().name : "CPU reference";
}

Result<Computed> compute(OpenRecording recording, const std::string& path, const Options& options,
                         const Machine& machine, const MakeProducts& make_products, Meter& meter) {
  const auto matter = pictures_matter(options);
  if (!matter) return matter.error();
  std::unique_ptr<Instants> instants;
  if (has_sequence(options) && (make_products || *matter)) {
    auto made = make_instants(with_side_file(options.frames, path), OutputKind::folder);
    if (!made) return made.error();
    instants = *std::move(made);
  }
  auto implementation = machine.context ? make_gpu(machine.context, options.stream, recording.sensor)
                                        : make_reference(options.stream, recording.sensor);
  if (!implementation) return implementation.error();

  Computed computed;
  computed.format = recording.source->format();
  computed.sensor = recording.sensor;
  std::vector<Shown> shown;
  shown.push_back({std::move(implementation->representation), ""});
  std::vector<std::unique_ptr<FrameProduct>> products;
  if (make_products) {
    auto made = make_products(shown);
    if (!made) return made.error();
    products = *std::move(made);
  } else {
    products.push_back(picture_product(shown, std::make_unique<NoWriter>()));
  }
  const auto renderer = make_live_renderer(shown, std::move(products));
  EventDigest events;
  {
    ReadAhead source(std::move(recording.source), [&](std::span<const Event> batch) {
      for (const Event& e : batch) events.add(e);
    });
    const auto push = [&](std::span<const Event> batch) -> Result<void> {
      computed.last_time = batch.back().t;
      meter.bytes = source.bytes_read();
      meter.events += batch.size();
      return renderer->push(batch);
    };
    const auto ask = [&](const Frame& frame) {
      ++computed.frames;
      return renderer->ask(frame);
    };
    const auto played = play(source, {.batches = machine.batches, .instants = instants.get()},
                             {.events = push, .frame = ask});
    if (!played) return played.error();
    computed.report = source.report();
    if (auto r = require_events(path, computed.report, options.stream.allow_empty); !r) return r.error();
    if (auto r = renderer->finish(); !r) return r.error();
  }

  Representation& representation = *shown.front().representation;
  const auto state = representation.state().wait();
  if (!state) return state.error();
  auto image = representation.u8_image().wait();
  if (!image) return image.error();
  auto filters = representation.filter_reports().wait();
  if (!filters) return filters.error();
  Digest of_state;
  of_state.add(*state);
  computed.digests = {of_state.hex(), image_digest(*image), events.hex()};
  computed.image = *std::move(image);
  computed.filters = *std::move(filters);
  return computed;
}

}  // namespace scarf::reprocess
