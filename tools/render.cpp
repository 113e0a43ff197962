// scarf render: pictures, tensors and sparse events of a recording.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "core/text.h"
#include "output/frame_request.h"
#include "output/frame_writer.h"
#include "output/product_request.h"
#include "output/products.h"
#include "output/renderer.h"
#include "scarf/reference/reference.h"
#include "session/device_words.h"
#include "session/play.h"
#include "session/progress.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/memory.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

const std::string kAllRepresentations = "all";  // each of representations(), with its defaults

constexpr int64_t kDefaultWindow = 33;   // milliseconds: one frame at 30 Hz
constexpr int64_t kMaxWindow = 100'000;  // milliseconds

struct RenderOptions {
  StreamRequest stream;
  std::string output;
  FrameRequest frames;
  std::optional<int64_t> window;
  ProductRequest products;
  bool decode_on_device = false;
};

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

Result<void> check(const RenderOptions& options, OutputKind kind) {
  if (auto r = check_frames(options.frames, options.output, kind); !r) return r;
  if (kind != OutputKind::image && options.decode_on_device) {
    return illegal(
        "--decode device leaves the times of events on the device, so only the end can be shown; give a .png "
        "or a .pgm, or leave it out");
  }
  if (options.window && std::filesystem::path(options.output).extension() == ".pgm") {
    return illegal("--compare-window is not offered for .pgm; use a .png, a folder or a video");
  }
  const bool mosaic = options.window || options.stream.representation == kAllRepresentations;
  if (options.products.floats && !is_array(kind)) {
    return illegal("--pixels float is offered for .npy and .h5; a picture has 8 bits");
  }
  if (!options.products.encoding.empty() && kind != OutputKind::hdf5) {
    return illegal("--encoding makes tensors, which go into an .h5; name one as the output");
  }
  if (mosaic && options.products.special()) {
    return illegal(
        "--pixels float, --encoding and --sparse are of one representation; leave out "
        "--compare-window and --representation all");
  }
  if (!options.products.sparse.empty() && options.stream.representation == "aae") {
    return illegal(
        "--sparse with aae would not show the events of the picture, since each query changes its "
        "state; use another representation");
  }
  return {};
}

// The representations that the options ask for, in the order of the tiles, and the name of who computes them.
struct Choice {
  std::vector<Shown> shown;
  std::string implementation;
};

Result<Choice> choose(const RenderOptions& options, SensorSize sensor) {
  Choice choice;
  for (const RepresentationInfo& info : representations()) {
    StreamRequest one = options.stream;
    if (one.representation == kAllRepresentations) one.representation = info.name;
    if (one.representation != info.name) continue;
    auto made = make_implementation(one, sensor);
    if (!made) return made.error();
    choice.shown.push_back({std::move(made->representation), info.title});
    choice.implementation = made->name;
  }
  if (options.window) {
    auto window =
        make_reference_representation(TimeWindowParameters{.window = *options.window * 1000}, sensor);
    if (!window) return window.error();
    choice.shown.push_back({*std::move(window), text("last ", *options.window, " ms")});
  }
  return choice;
}

Result<std::vector<std::unique_ptr<FrameProduct>>> make_products(const RenderOptions& options,
                                                                 OutputKind kind,
                                                                 const std::vector<Shown>& shown,
                                                                 const OutputRule& rule) {
  Representation& first = *shown.front().representation;
  std::vector<std::unique_ptr<FrameProduct>> products;
  if (!options.products.encoding.empty()) {
    const auto encoding = parse_encoding(options.products.encoding);
    if (!encoding) return encoding.error();
    auto tensors = tensor_product(first, *encoding, options.output, rule);
    if (!tensors) return tensors.error();
    products.push_back(*std::move(tensors));
  } else {
    auto writer = make_frame_writer(options.output, kind, options.frames.shown_fps(), rule);
    if (!writer) return writer.error();
    products.push_back(options.products.floats ? float_product(first, *std::move(writer))
                                               : picture_product(shown, *std::move(writer)));
  }
  if (!options.products.sparse.empty()) {
    auto writer = make_event_list_writer(options.products.sparse, first.sensor(), rule);
    if (!writer) return writer.error();
    products.push_back(event_product(first, *std::move(writer)));
  }
  return products;
}

// The end of a recording whose words the device decodes. Returns the number of events.
Result<uint64_t> render_words(const RenderOptions& options, const std::vector<Shown>& shown,
                              const TakeFrame& ask) {
  std::vector<Representation*> all;
  for (const Shown& s : shown) all.push_back(s.representation.get());
  auto words = DeviceWords::open(options.stream, all);
  if (!words) return words.error();
  BatchSizes batches = options.stream.batches;
  for (;;) {
    const auto pushed = words->push(2 * batches.next());
    if (!pushed) return pushed.error();
    if (*pushed == 0) break;
  }
  const auto report = words->report();
  if (!report) return report.error();
  const auto newest = words->newest();
  if (!newest) return newest.error();
  if (*newest) {
    if (auto r = ask({.t = **newest, .events = report->events}); !r) return r.error();
  }
  return report->events;
}

// Many frames of a file can be computed at the same time; those of a pipe are wanted one by one.
bool can_be_replayed(const RenderOptions& options, OutputKind kind) {
  std::error_code ignored;
  const StreamRequest& s = options.stream;
  const bool many = kind != OutputKind::image && options.frames.at.empty();
  const bool pictures = !options.products.special() && !options.window;
  return many && pictures && s.representation == "scarf" && !s.cpu && s.filters.empty() &&
         !options.decode_on_device && std::filesystem::is_regular_file(s.file, ignored);
}

Result<std::unique_ptr<Renderer>> make_replay(const RenderOptions& options, OutputKind kind,
                                              SensorSize sensor, std::string& implementation,
                                              const OutputRule& rule) {
  const auto grid = scarf_grid(options.stream, sensor);
  if (!grid) return grid.error();
  const auto context = GpuContext::create(options.stream.device);
  if (!context) return context.error();
  implementation = (*context)->device().name;
  return make_replay_renderer(*context, *grid, options.stream.accumulation, [&] {
    return make_frame_writer(options.output, kind, options.frames.shown_fps(), rule);
  });
}

Result<std::unique_ptr<Renderer>> make_live(const RenderOptions& options, OutputKind kind,
                                            const std::vector<Shown>& shown, const OutputRule& rule) {
  auto products = make_products(options, kind, shown, rule);
  if (!products) return products.error();
  return make_live_renderer(shown, *std::move(products));
}

Result<int> render(const RenderOptions& options, const OutputRule& rule) {
  const auto kind = output_kind(options.output);
  if (!kind) return kind.error();
  if (auto r = check(options, *kind); !r) return r.error();
  std::vector<std::string> more;
  if (!options.products.sparse.empty()) more.push_back(options.products.sparse);
  if (auto r = check_outputs(options.output, *kind, more, rule); !r) return r.error();
  const auto instants = make_instants(options.frames, *kind);
  if (!instants) return instants.error();
  auto recording = open_recording(options.stream);
  if (!recording) return recording.error();
  const bool replayed = can_be_replayed(options, *kind);
  auto choice = replayed ? Result<Choice>(Choice{}) : choose(options, recording->sensor);
  if (!choice) return choice.error();
  const auto renderer = replayed
                            ? make_replay(options, *kind, recording->sensor, choice->implementation, rule)
                            : make_live(options, *kind, choice->shown, rule);
  if (!renderer) return renderer.error();

  uint64_t frames = 0;
  uint64_t events = 0;
  double seconds = 0;
  {
    Progress progress(*recording->source);
    const auto push = [&](std::span<const Event> batch) -> Result<void> {
      progress.add(batch.size());
      return (*renderer)->push(batch);
    };
    const auto ask = [&](const Frame& frame) -> Result<void> {
      ++frames;
      return (*renderer)->ask(frame);
    };
    const auto played =
        options.decode_on_device
            ? render_words(options, choice->shown, ask)
            : play(*recording->source, {.batches = options.stream.batches, .instants = instants->get()},
                   {.events = push, .frame = ask});
    if (!played) return played.error();
    ReadReport report = recording->source->report();
    if (options.decode_on_device) report.events = *played;
    if (auto r = require_events(options.stream.file, report, options.stream.allow_empty); !r)
      return r.error();
    if (auto r = (*renderer)->finish(); !r) return r.error();
    events = *played;
    seconds = progress.seconds();
  }
  std::string filtered;
  if (!choice->shown.empty()) {
    auto lines = filter_lines(options.stream, *choice->shown.front().representation);
    if (!lines) return lines.error();
    filtered = *std::move(lines);
  }
  std::cout << text("rendered ", frames, " frames of ", events, " events in ", seconds, " s (",
                    static_cast<uint64_t>(static_cast<double>(events) / std::max(seconds, 1e-9)),
                    " events/s with reading and writing) on ", choice->implementation, "\n",
                    memory_line((*renderer)->device_bytes()), filtered);
  return 0;
}

}  // namespace

void add_render(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("render", "Pictures of a recording");
  auto options = std::make_shared<RenderOptions>();
  add_settings(*app, stream_settings(options->stream, {kAllRepresentations}));
  add_decode_option(*app, options->decode_on_device);
  add_output_option(
      *app, "-o,--output", options->output,
      "A folder of PNG frames with their list frames.csv; a video (.mp4, .avi); an array of "
      "frames (.npy with the list NAME.csv beside it, .h5); or one image of the end (.png, .pgm)")
      ->required();
  add_settings(*app,
               product_settings(options->products, "File for the sparse events of each frame (.h5, .npz)"));
  add_settings(*app, frame_settings(options->frames));
  app->add_option_function<int64_t>(
         "--compare-window", [options](int64_t milliseconds) { options->window = milliseconds; },
         "Beside each frame: the events of the last MS milliseconds, default 33")
      ->expected(0, 1)
      ->default_str(std::to_string(kDefaultWindow))
      ->check(CLI::Range(int64_t{1}, kMaxWindow));
  app->callback([&command, app, options] {
    command.run = [app, options] { return render(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
