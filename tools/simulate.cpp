// scarf simulate: the recording of a simulated event camera, and what it should show.
#include "scarf/simulate/simulate.h"

#include <filesystem>
#include <iostream>
#include <optional>

#include "core/parse.h"
#include "core/text.h"
#include "io/base/format.h"
#include "output/pictures.h"
#include "scarf/io/recordings.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/options.h"
#include "tools/output_format.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxTruthRate = 10'000;
constexpr std::string_view kFrame = "frame";
constexpr std::string_view kEdges = "edges";

struct SimulateOptions {
  std::string output;
  std::string format;  // empty: by the name
  SimulationOptions simulation;
  std::string truth;  // folder
  double truth_rate = 30;
};

// Frames and outlines at the truth rate, from time 0 to the end.
Result<void> write_truth(const SimulateOptions& options, const Simulation& simulation,
                         PictureFolder& folder) {
  std::string list = "index,t_us\n";
  for (int64_t i = 0;; ++i) {
    const auto t = static_cast<int64_t>(static_cast<double>(i) * 1e6 / options.truth_rate);
    if (t > simulation.duration()) break;
    const auto write = [&](std::string_view name, const Image<uint8_t>& image) {
      return folder.write(name, static_cast<uint64_t>(i), image);
    };
    if (auto r = write(kFrame, simulation.frame(t)); !r) return r;
    if (auto r = write(kEdges, simulation.edges(t)); !r) return r;
    list += text(i, ",", t, "\n");
  }
  return folder.finish(list);
}

Result<int> simulate(const SimulateOptions& options, const OutputRule& rule) {
  const auto simulation = make_simulation(options.simulation);
  if (!simulation) return simulation.error();
  const auto format = output_format(options.output, options.format);
  if (!format) return format.error();
  if (!(options.truth_rate > 0 && options.truth_rate <= kMaxTruthRate)) {
    return Error{ErrorCode::illegal_parameter,
                 text("truth rate is ", options.truth_rate, ", legal is above 0, up to ", kMaxTruthRate)};
  }

  // What cannot be created is told before the work is done.
  if (!options.truth.empty()) {
    if (auto r = PictureFolder::check(options.truth, {kFrame, kEdges}, rule); !r) return r.error();
    std::error_code ignored;
    if (fs::weakly_canonical(options.output, ignored) ==
        fs::weakly_canonical(fs::path(options.truth) / kPictureList, ignored)) {
      return Error{ErrorCode::illegal_parameter,
                   text(options.output, " is the list of the pictures of --truth; give another name")};
    }
  }
  const auto sink = create_recording(options.output, *format, options.simulation.sensor, rule);
  if (!sink) return sink.error();
  std::optional<PictureFolder> truth;
  if (!options.truth.empty()) {
    auto folder = PictureFolder::create(options.truth, {kFrame, kEdges}, rule);
    if (!folder) return folder.error();
    truth.emplace(*std::move(folder));
  }
  uint64_t events = 0;
  while (!(*simulation)->finished()) {
    const auto step = (*simulation)->next();
    if (auto r = (*sink)->write(step); !r) return r.error();
    events += step.size();
  }
  if (truth) {
    if (auto r = write_truth(options, **simulation, *truth); !r) return r.error();
  }
  if (auto r = (*sink)->finish(); !r) return r.error();
  const double seconds = static_cast<double>((*simulation)->duration()) / 1e6;
  // Standard output may be the recording.
  (options.output == "-" ? std::cerr : std::cout)
      << text(events, " events, ", seconds, " s, ", static_cast<double>(events) / seconds / 1e6, " Mev/s\n");
  return 0;
}

}  // namespace

void add_simulate(CLI::App& program, Command& command) {
  CLI::App* app =
      program.add_subcommand("simulate", "Record a simulated event camera that watches moving shapes");
  auto options = std::make_shared<SimulateOptions>();
  SimulationOptions& o = options->simulation;
  add_output_option(
      *app, "output", options->output,
      "Recording to write, in the format of its name (" + output_extensions() + "); - is standard output")
      ->required();
  add_word_option(*app, "--output-format,--format", options->format,
                  "Format, where the name does not tell; see scarf formats");
  std::string scenes;
  for (const auto name : scene_names()) scenes += (scenes.empty() ? "" : ", ") + std::string(name);
  add_word_option(*app, "--scene", o.scene, scenes)->capture_default_str();
  add_parsed_option(*app, "--sensor", o.sensor, parse_sensor, "Sensor size WxH [346x260]");
  add_parsed_option(*app, "--duration", o.duration_s, parse_number, "Seconds")
      ->default_str(text(o.duration_s));
  add_parsed_option(*app, "--threshold", o.threshold, parse_number, "Change of log intensity per event")
      ->default_str(text(o.threshold));
  add_parsed_option(*app, "--mismatch", o.mismatch, parse_number,
                    "Spread of the pixels' thresholds, relative")
      ->default_str(text(o.mismatch));
  add_parsed_option(*app, "--refractory", o.refractory_us, parse_time,
                    "Time that a pixel is blind after an event: us, or with a unit (1ms)")
      ->default_str(text(o.refractory_us));
  add_parsed_option(*app, "--noise", o.noise_hz, parse_number, "Noise events per pixel and second")
      ->default_str(text(o.noise_hz));
  add_parsed_option(*app, "--hot-pixels", o.hot_pixels, parse_whole<int32_t>,
                    "Number of pixels that fire all the time")
      ->default_str(text(o.hot_pixels));
  add_parsed_option(*app, "--seed", o.seed, parse_whole<uint64_t>, "Seed of the sensor's imperfections")
      ->default_str(text(o.seed));
  add_output_option(*app, "--truth", options->truth,
                    "Folder for PNG frames and masks of the true outlines, and their list frames.csv");
  add_parsed_option(*app, "--truth-rate", options->truth_rate, parse_number, "Frames per second of --truth")
      ->default_str(text(options->truth_rate));
  app->callback([&command, app, options] {
    command.run = [app, options] { return simulate(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
