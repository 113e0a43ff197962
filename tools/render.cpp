// scarf render: pictures of a recording, as a folder of images, a video or one image.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "core/text.h"
#include "scarf/reference.h"
#include "tools/commands.h"
#include "tools/frame_options.h"
#include "tools/frame_writer.h"
#include "tools/options.h"
#include "tools/play.h"
#include "tools/progress.h"
#include "tools/renderer.h"

namespace scarf::tools {
namespace {

constexpr int64_t kDefaultWindow = 33;   // milliseconds: one frame at 30 Hz
constexpr int64_t kMaxWindow = 100'000;  // milliseconds

struct RenderOptions {
  StreamOptions stream;
  std::string output;
  FrameOptions frames;
  std::optional<int64_t> window;
};

Result<void> check(const RenderOptions& options, OutputKind kind) {
  if (auto r = check_frames(options.frames, options.output, kind); !r) return r;
  if (options.window && std::filesystem::path(options.output).extension() == ".pgm") {
    return Error{ErrorCode::illegal_parameter,
                 "--compare-window is not offered for .pgm; use a .png, a folder or a video"};
  }
  return {};
}

// What the options ask for, in the order of the tiles, and the name of who computes it.
struct Choice {
  std::vector<Shown> shown;
  std::string implementation;
};

Result<Choice> choose(const RenderOptions& options, SensorSize sensor) {
  Choice choice;
  for (const RepresentationInfo& info : representations()) {
    StreamOptions one = options.stream;
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

Result<int> render(const RenderOptions& options) {
  const auto kind = output_kind(options.output);
  if (!kind) return kind.error();
  if (auto r = check(options, *kind); !r) return r.error();
  const auto instants = make_instants(options.frames, *kind);
  if (!instants) return instants.error();
  auto recording = open_recording(options.stream);
  if (!recording) return recording.error();
  auto choice = choose(options, recording->sensor);
  if (!choice) return choice.error();
  const auto writer = make_frame_writer(options.output, *kind, options.frames.shown_fps());
  if (!writer) return writer.error();

  Renderer renderer(std::move(choice->shown), **writer);
  uint64_t events = 0;
  double seconds = 0;
  {
    Progress progress(*recording->source);
    const auto push = [&](std::span<const Event> batch) -> Result<void> {
      progress.add(batch.size());
      return renderer.push(batch);
    };
    const auto played =
        play(*recording->source, {.batches = options.stream.batches, .instants = instants->get()},
             {.events = push, .frame = [&](const Frame& frame) { return renderer.ask(frame); }});
    if (!played) return played.error();
    if (auto r = renderer.finish(); !r) return r.error();
    events = *played;
    seconds = progress.seconds();
  }
  const auto filtered = filter_lines(options.stream, renderer.first());
  if (!filtered) return filtered.error();
  std::cout << text("rendered ", renderer.frames(), " frames of ", events, " events in ", seconds, " s (",
                    static_cast<uint64_t>(static_cast<double>(events) / std::max(seconds, 1e-9)),
                    " events/s with reading and writing) on ", choice->implementation, "\n", *filtered);
  return 0;
}

}  // namespace

void add_render(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("render", "Pictures of a recording");
  auto options = std::make_shared<RenderOptions>();
  add_stream_options(*app, options->stream, {kAllRepresentations});
  app->add_option("-o,--output", options->output,
                  "A folder of PNG frames, a video (.mp4, .avi), or one image of the end (.png, .pgm)")
      ->required();
  add_frame_options(*app, options->frames, "Most frames that one gap in the recording may make due");
  app->add_option_function<int64_t>(
         "--compare-window", [options](int64_t milliseconds) { options->window = milliseconds; },
         "Beside each frame: the events of the last MS milliseconds, default 33")
      ->expected(0, 1)
      ->default_str(std::to_string(kDefaultWindow))
      ->check(CLI::Range(int64_t{1}, kMaxWindow));
  app->callback([&command, options] { command.run = [options] { return render(*options); }; });
}

}  // namespace scarf::tools
