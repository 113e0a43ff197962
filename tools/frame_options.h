// Options that say which frames of a recording are due: shared by everything that makes pictures.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tools/frame_writer.h"
#include "tools/instants.h"

namespace scarf::tools {

struct FrameOptions {
  std::optional<FrameRate> rate;
  std::optional<uint64_t> every;
  std::string at;          ///< "end" or empty
  std::string times_file;  ///< empty: none
  TimesFormat times_format;
  uint64_t max_frames = 10'000;  ///< in a row without an event between them, of a frame clock
  std::optional<double> video_fps;

  /// Whether several frames are asked for.
  bool timed() const { return rate || every || !times_file.empty(); }
  double shown_fps() const { return video_fps.value_or(30); }
};

void add_frame_options(CLI::App& app, FrameOptions& options);

/// Whether the options fit an output. Errors: illegal_parameter, naming the option to change.
Result<void> check_frames(const FrameOptions& options, const std::string& output, OutputKind kind);

/// The instants that the options ask for; one picture shows the end. Errors: as read_times.
Result<std::unique_ptr<Instants>> make_instants(const FrameOptions& options, OutputKind kind);

}  // namespace scarf::tools
