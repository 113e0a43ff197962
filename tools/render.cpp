// scarf render: pictures of a recording, as a folder of images, a video or one image.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "core/text.h"
#include "scarf/reference.h"
#include "tools/commands.h"
#include "tools/frame_writer.h"
#include "tools/options.h"
#include "tools/play.h"
#include "tools/progress.h"
#include "tools/renderer.h"

namespace scarf::tools {
namespace {

constexpr int64_t kDefaultWindow = 33;   // milliseconds: one frame at 30 Hz
constexpr int64_t kMaxWindow = 100'000;  // milliseconds
constexpr double kMinVideoFps = 0.1;
constexpr double kMaxVideoFps = 1000;

struct RenderOptions {
  StreamOptions stream;
  std::string output;
  std::optional<FrameRate> rate;
  std::optional<uint64_t> every;
  std::string at;
  std::string times_file;
  uint64_t max_frames = 100'000;
  std::optional<double> video_fps;
  std::optional<int64_t> window;
};

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

Result<void> check(const RenderOptions& options, OutputKind kind) {
  const bool timed = options.rate || options.every || !options.times_file.empty();
  if (kind == OutputKind::image && timed) {
    return illegal(text(options.output,
                        " is one image, which shows the end; leave out --rate, --every and "
                        "--at-times, or give a folder or a video"));
  }
  if (kind == OutputKind::video && !options.at.empty()) {
    return illegal("--at end is one picture; give a .png, a .pgm or a folder instead of a video");
  }
  if (options.video_fps && kind != OutputKind::video) {
    return illegal(
        "--video-fps is used by videos only; leave it out, or give an output that ends in .mp4 or .avi");
  }
  if (options.video_fps && !(*options.video_fps >= kMinVideoFps && *options.video_fps <= kMaxVideoFps)) {
    return illegal(
        text("--video-fps is ", *options.video_fps, ", legal is ", kMinVideoFps, " to ", kMaxVideoFps));
  }
  if (options.window && std::filesystem::path(options.output).extension() == ".pgm") {
    return illegal("--compare-window is not offered for .pgm; use a .png, a folder or a video");
  }
  return {};
}

Result<std::unique_ptr<Instants>> make_instants(const RenderOptions& options, OutputKind kind) {
  if (options.every) return frames_every(*options.every);
  if (!options.at.empty() || kind == OutputKind::image) return frame_at_end();
  if (options.times_file.empty())
    return frames_at_rate(options.rate.value_or(FrameRate{}), options.max_frames);
  auto times = read_times(options.times_file);
  if (!times) return times.error();
  return frames_at_times(*std::move(times));
}

// Who computes the frames, and its name for people.
struct Choice {
  std::unique_ptr<Renderer> renderer;
  std::string implementation;
  Representation* first = nullptr;  ///< the one that the filters are in front of, if there are filters
};

// Frames of a file can be computed at the same time, those of a pipe are wanted one by one.
bool can_be_replayed(const RenderOptions& options) {
  std::error_code ignored;
  const StreamOptions& s = options.stream;
  return s.representation == "scarf" && !s.cpu && s.filters.empty() && !options.window &&
         std::filesystem::is_regular_file(s.file, ignored);
}

Result<Choice> choose_replay(const RenderOptions& options, SensorSize sensor) {
  const auto grid = scarf_grid(options.stream, sensor);
  if (!grid) return grid.error();
  const auto context = GpuContext::create(options.stream.device);
  if (!context) return context.error();
  auto renderer = make_replay_renderer(*context, *grid, options.stream.accumulation);
  if (!renderer) return renderer.error();
  return Choice{*std::move(renderer), (*context)->device().name};
}

// The representations that the options ask for, in the order of the tiles.
Result<Choice> choose_live(const RenderOptions& options, SensorSize sensor) {
  Choice choice;
  std::vector<Shown> shown;
  for (const RepresentationInfo& info : representations()) {
    StreamOptions one = options.stream;
    if (one.representation == kAllRepresentations) one.representation = info.name;
    if (one.representation != info.name) continue;
    auto made = make_implementation(one, sensor);
    if (!made) return made.error();
    shown.push_back({std::move(made->representation), info.title});
    choice.implementation = made->name;
  }
  if (options.window) {
    auto window =
        make_reference_representation(TimeWindowParameters{.window = *options.window * 1000}, sensor);
    if (!window) return window.error();
    shown.push_back({*std::move(window), text("last ", *options.window, " ms")});
  }
  choice.first = shown.front().representation.get();
  choice.renderer = make_live_renderer(std::move(shown));
  return choice;
}

Result<int> render(const RenderOptions& options) {
  const auto kind = output_kind(options.output);
  if (!kind) return kind.error();
  if (auto r = check(options, *kind); !r) return r.error();
  const auto instants = make_instants(options, *kind);
  if (!instants) return instants.error();
  auto recording = open_recording(options.stream);
  if (!recording) return recording.error();
  const auto choice = can_be_replayed(options) ? choose_replay(options, recording->sensor)
                                               : choose_live(options, recording->sensor);
  if (!choice) return choice.error();
  const auto writer = make_frame_writer(options.output, *kind, options.video_fps.value_or(30));
  if (!writer) return writer.error();

  Renderer& renderer = *choice->renderer;
  renderer.write_to(**writer);
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
  std::string filtered;
  if (choice->first != nullptr) {
    auto lines = filter_lines(options.stream, *choice->first);
    if (!lines) return lines.error();
    filtered = *std::move(lines);
  }
  std::cout << text("rendered ", renderer.frames(), " frames of ", events, " events in ", seconds, " s (",
                    static_cast<uint64_t>(static_cast<double>(events) / std::max(seconds, 1e-9)),
                    " events/s with reading and writing) on ", choice->implementation, "\n", filtered);
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
  const std::string when = "When";
  CLI::Option* rate = add_parsed_option(*app, "--rate", options->rate, parse_frame_rate,
                                        "Frames per second of recorded time, default 30")
                          ->group(when);
  CLI::Option* every =
      add_parsed_option(*app, "--every", options->every, parse_positive, "A frame after every N events")
          ->group(when);
  CLI::Option* at = app->add_option("--at", options->at, "end: one frame of the final state")
                        ->check(CLI::IsMember({"end"}))
                        ->group(when);
  CLI::Option* times =
      app->add_option("--at-times", options->times_file, "File with one time in us per line")->group(when);
  rate->excludes(every)->excludes(at)->excludes(times);
  every->excludes(at)->excludes(times);
  at->excludes(times);
  add_parsed_option(*app, "--max-frames", options->max_frames, parse_positive,
                    "Most frames that one gap in the recording may make due")
      ->default_str(text(options->max_frames))
      ->group(when);
  app->add_option("--video-fps", options->video_fps, "Speed at which a video is shown, default 30");
  app->add_option_function<int64_t>(
         "--compare-window", [options](int64_t milliseconds) { options->window = milliseconds; },
         "Beside each frame: the events of the last MS milliseconds, default 33")
      ->expected(0, 1)
      ->default_str(std::to_string(kDefaultWindow))
      ->check(CLI::Range(int64_t{1}, kMaxWindow));
  app->callback([&command, options] { command.run = [options] { return render(*options); }; });
}

}  // namespace scarf::tools
