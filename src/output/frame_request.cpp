#include "output/frame_request.h"

#include <utility>

#include "core/parse.h"
#include "core/text.h"

namespace scarf {
namespace {

constexpr double kMinVideoFps = 0.1;
constexpr double kMaxVideoFps = 1000;

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

}  // namespace

Settings frame_settings(FrameRequest& o) {
  const std::string when = "When";
  Settings settings("FrameRequest");
  settings.add_parsed("rate", o.rate, parse_frame_rate, "Frames per second of recorded time, default 30")
      .in(when);
  settings.add_parsed("every", o.every, parse_positive, "A frame after every N events").in(when);
  settings.add_text(Setting::Kind::word, "at", o.at, "One frame of the final state").in(when).one_of({"end"});
  settings.add_text(Setting::Kind::input, "at-times", o.at_times, "File with one time per line, in us")
      .in(when);
  const std::vector<std::string> instants = {"rate", "every", "at", "at-times"};
  for (size_t i = 0; i < instants.size(); ++i) {
    for (size_t k = i + 1; k < instants.size(); ++k) settings.exclude(instants[i], instants[k]);
  }
  settings
      .add_parsed("times-column", o.times.column, parse_positive,
                  "Column of the times, where the file of at-times has several; default 1")
      .in(when);
  settings
      .add_parsed("times-unit", o.times.exponent, parse_time_unit,
                  "Unit of these times: s, ms, us (default) or ns")
      .in(when);
  settings.need("times-column", "at-times");
  settings.need("times-unit", "at-times");
  settings
      .add_parsed("max-frames", o.max_frames, parse_positive,
                  "Most frames of rate in a row without an event between them, default 10000: a longer jump "
                  "in time ends the job")
      .in(when);
  settings.add_parsed("video-fps", o.video_fps, parse_number, "Speed at which a video is shown, default 30");
  return settings;
}

Result<void> check_frames(const FrameRequest& request, const std::string& output, OutputKind kind) {
  if (kind == OutputKind::image && request.timed()) {
    return illegal(
        text(output,
             " is one image, which shows the end; leave out FrameRequest::rate, FrameRequest::every and "
             "FrameRequest::at_times, or give a folder or a video"));
  }
  if (kind == OutputKind::video && !request.at.empty()) {
    return illegal("FrameRequest::at end is one picture; give a .png, a .pgm or a folder instead of a video");
  }
  if (request.video_fps && kind != OutputKind::video) {
    return illegal(
        "FrameRequest::video_fps is used by videos only; leave it out, or give an output that ends in .mp4 "
        "or .avi");
  }
  if (request.video_fps && !(*request.video_fps >= kMinVideoFps && *request.video_fps <= kMaxVideoFps)) {
    return illegal(text("FrameRequest::video_fps is ", *request.video_fps, ", legal is ", kMinVideoFps,
                        " to ", kMaxVideoFps));
  }
  return {};
}

Result<std::unique_ptr<Instants>> make_instants(const FrameRequest& request, OutputKind kind) {
  if (request.every) return frames_every(*request.every);
  if (!request.at.empty() || kind == OutputKind::image) return frame_at_end();
  if (request.at_times.empty()) {
    return frames_at_rate(request.rate.value_or(FrameRate{}), request.max_frames);
  }
  auto times = read_times(request.at_times, request.times);
  if (!times) return times.error();
  return frames_at_times(*std::move(times));
}

}  // namespace scarf
