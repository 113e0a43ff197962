#include "tools/frame_options.h"

#include <utility>

#include "core/text.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

constexpr double kMinVideoFps = 0.1;
constexpr double kMaxVideoFps = 1000;

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

}  // namespace

void add_frame_options(CLI::App& app, FrameOptions& o) {
  const std::string when = "When";
  CLI::Option* rate = add_parsed_option(app, "--rate", o.rate, parse_frame_rate,
                                        "Frames per second of recorded time, default 30")
                          ->group(when);
  CLI::Option* every =
      add_parsed_option(app, "--every", o.every, parse_positive, "A frame after every N events")->group(when);
  CLI::Option* at = app.add_option("--at", o.at, "end: one frame of the final state")
                        ->check(CLI::IsMember({"end"}))
                        ->group(when);
  CLI::Option* times =
      add_input_option(app, "--at-times", o.times_file, "File with one time per line, in us")->group(when);
  rate->excludes(every)->excludes(at)->excludes(times);
  every->excludes(at)->excludes(times);
  at->excludes(times);
  add_parsed_option(app, "--times-column", o.times_format.column, parse_positive,
                    "Column of the times, where the file of --at-times has several; default 1")
      ->group(when)
      ->needs(times);
  add_parsed_option(app, "--times-unit", o.times_format.exponent, parse_time_unit,
                    "Unit of these times: s, ms, us (default) or ns")
      ->group(when)
      ->needs(times);
  add_parsed_option(
      app, "--max-frames", o.max_frames, parse_positive,
      "Most frames of --rate in a row without an event between them, default 10000: a longer jump "
      "in time ends the job")
      ->default_str(text(o.max_frames))
      ->group(when);
  add_parsed_option(app, "--video-fps", o.video_fps, parse_number,
                    "Speed at which a video is shown, default 30");
}

Result<void> check_frames(const FrameOptions& options, const std::string& output, OutputKind kind) {
  if (kind == OutputKind::image && options.timed()) {
    return illegal(text(output,
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
  return {};
}

Result<std::unique_ptr<Instants>> make_instants(const FrameOptions& options, OutputKind kind) {
  if (options.every) return frames_every(*options.every);
  if (!options.at.empty() || kind == OutputKind::image) return frame_at_end();
  if (options.times_file.empty())
    return frames_at_rate(options.rate.value_or(FrameRate{}), options.max_frames);
  auto times = read_times(options.times_file, options.times_format);
  if (!times) return times.error();
  return frames_at_times(*std::move(times));
}

}  // namespace scarf::tools
