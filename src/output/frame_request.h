// Which frames of a recording are due: shared by everything that makes pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "output/frame_writer.h"
#include "session/instants.h"
#include "session/settings.h"

namespace scarf {

struct FrameRequest {
  std::optional<FrameRate> rate;
  std::optional<uint64_t> every;
  std::string at;        ///< "end" or empty
  std::string at_times;  ///< a file; empty: none
  TimesFormat times;
  uint64_t max_frames = 10'000;  ///< in a row without an event between them, of a frame clock
  std::optional<double> video_fps;

  /// Whether several frames are asked for.
  bool timed() const { return rate || every || !at_times.empty(); }
  double shown_fps() const { return video_fps.value_or(30); }
};

/// The settings by which words fill in the request, which outlives them.
Settings frame_settings(FrameRequest& request);

/// Whether the request fits an output. Errors: illegal_parameter, naming what to change.
Result<void> check_frames(const FrameRequest& request, const std::string& output, OutputKind kind);

/// The instants that are asked for; one picture shows the end. Errors: as read_times.
Result<std::unique_ptr<Instants>> make_instants(const FrameRequest& request, OutputKind kind);

}  // namespace scarf
