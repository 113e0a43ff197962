// scarf bench: the device beside the reference, in one run.
#include "tools/bench/bench.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/parse.h"
#include "core/text.h"
#include "io/files/write_file.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/options.h"

namespace scarf::tools {

Result<void> write_report(const BenchOptions& options, const DeviceInfo* device, nlohmann::json report) {
  if (options.json.empty()) return {};
  report["schema"] = kBenchSchema;
  report["commit"] = SCARF_COMMIT;
  if (device != nullptr) {
    report["device"] = device->name;
    report["driver"] = device->driver;
  }
  return write_file(options.json, report.dump(1) + "\n", options.rule);
}

namespace {

Result<int> bench(const BenchOptions& options) {
#ifndef NDEBUG
  return Error{ErrorCode::device,
               "this is a debug build, whose times mean nothing; build with the release preset"};
#endif
  if (options.sensor && !options.paper && !options.io) {
    return Error{ErrorCode::illegal_parameter, "--geometry is used by --paper and --io only; leave it out"};
  }
  std::vector<std::string> files;
  for (const std::string& file : {options.json, options.csv, options.plot}) {
    if (!file.empty()) files.push_back(file);
  }
  if (auto r = options.rule.check(files); !r) return r.error();
  if (options.io) return bench_io(options);
  if (options.wire) return bench_wire(options);
  if (options.replay) return bench_replay(options);
  if (options.streams) return bench_streams(options);
  if (options.paper) return bench_paper(options);
  return options.offload ? bench_offload(options) : bench_scenes(options);
}

}  // namespace

void add_bench(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("bench", "Measure the device beside the reference");
  auto options = std::make_shared<BenchOptions>();
  app->add_flag("--quick", options->quick, "Fewer events and repeats");
  CLI::Option* stages =
      app->add_flag("--stages", options->stages,
                    "Device time of each stage; of scarf also the bytes that it has to move "
                    "and the fractions of what the device can do");
  CLI::Option* wire =
      app->add_flag(
             "--wire", options->wire,
             "Bytes per event on the way to a device that has memory of its own, and the cost of packing")
          ->excludes(stages);
  add_input_option(*app, "--recordings", options->recordings, "Recordings to measure besides the scenes")
      ->needs(wire);
  add_output_option(*app, "--json", options->json, "Write the results to this file as well");
  std::vector<std::string> names;
  for (const RepresentationInfo& info : representations()) names.push_back(info.name);
  CLI::Option* representation =
      app->add_option("--representation", options->representation,
                      "One representation instead of scarf's presets, or of all with --paper")
          ->check(CLI::IsMember(names));
  const Settings parameters = parameter_settings(options->parameters, representations());
  add_settings(*app, parameters);
  for (const Setting& parameter : parameters.all())
    app->get_option("--" + parameter.name)->needs(representation);

  app->add_flag(
         "--offload", options->offload,
         "What the device does for a host with very many events: throughput with images back, kernel time "
         "and latency, beside what it can copy")
      ->excludes(stages)
      ->excludes(wire)
      ->excludes(representation);
  const std::string reading = "Reading of recordings";
  CLI::Option* io = app->add_flag("--io", options->io,
                                  "Time per event of the readers, beside that of reading the file alone")
                        ->excludes(stages)
                        ->excludes(representation)
                        ->group(reading);
  add_input_option(
      *app, "recordings", options->recordings,
      "Recordings to read; without any, one of a synthetic scene in every format that is written")
      ->needs(io)
      ->group(reading);
  const std::string costs = "The paper's costs";
  CLI::Option* paper = app->add_flag("--paper", options->paper,
                                     "Time per event and per query of every representation, and throughput "
                                     "against query rate, beside the paper's figures")
                           ->excludes(stages)
                           ->excludes(wire)
                           ->group(costs);
  add_input_option(*app, "--file", options->file,
                   "Events of this recording; else of a simulated shaking camera")
      ->needs(paper)
      ->group(costs);
  add_parsed_option(
      *app, "--geometry", options->sensor, parse_sensor,
      "Sensor size WxH, of the simulation (default: 240x180 and 1280x720), or of a recording that "
      "does not say")
      ->group(costs);
  add_output_option(*app, "--csv", options->csv, "Write the results to this file as CSV")
      ->needs(paper)
      ->group(costs);
  add_output_option(*app, "--plot", options->plot, "Write the figure to this file as SVG")
      ->needs(paper)
      ->group(costs);

  app->add_flag("--replay", options->replay, "A picture per millisecond of recorded time: replay and stream")
      ->excludes(paper)
      ->excludes(representation);

  constexpr size_t kStreams = 16;
  app->add_option("--streams", options->streams,
                  text("N small streams in one submission, beside one stream of N times as many events "
                       "(default: ",
                       kStreams, ")"))
      ->expected(0, 1)
      ->default_str(std::to_string(kStreams))
      ->check(CLI::Range(1, 256))
      ->excludes("--replay")
      ->excludes("--offload")
      ->excludes(wire)
      ->excludes(io)
      ->excludes(paper)
      ->excludes(representation);

  const std::string work = "Work";
  CLI::Option* device = add_word_option(*app, "--device", options->device.device,
                                        "Index, part of the name, UUID or type of the device")
                            ->group(work);
  CLI::Option* require_gpu =
      app->add_flag("--require-gpu", options->device.require_gpu, "A CPU device is an error")->group(work);
  app->add_flag("--cpu", options->cpu, "The CPU reference only, no Vulkan")
      ->needs(paper)
      ->excludes(device)
      ->excludes(require_gpu)
      ->group(work);
  app->callback([&command, app, options] {
    command.run = [app, options] {
      options->rule = output_rule(*app);
      return bench(*options);
    };
  });
}

}  // namespace scarf::tools
