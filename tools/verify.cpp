// scarf verify: the CPU reference and the device on the same stream, compared after every batch.
#include <filesystem>
#include <iostream>

#include "core/text.h"
#include "tools/commands.h"
#include "tools/lockstep.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

struct VerifyOptions {
  StreamOptions stream;
  std::optional<uint64_t> max_events;
  std::string failing;  ///< where the failing prefix goes
};

// None where every bit must be the same.
std::unique_ptr<Tolerance> tolerance_of(const StreamOptions& options, SensorSize sensor) {
  if (options.representation == "scarf") return nullptr;
  const auto parameters = parameters_of(options);
  if (!parameters || info_of(*parameters).exact) return nullptr;
  return std::make_unique<Tolerance>(*parameters, sensor);
}

// What was compared.
std::string subject(const StreamOptions& options, Representation& r) {
  if (const auto* scarf = dynamic_cast<Scarf*>(&r)) return text(scarf->geometry().patches(), " patches");
  return text(options.representation, " on ", r.sensor().width, "x", r.sensor().height);
}

Result<int> verify(const VerifyOptions& options) {
  if (options.stream.cpu) {
    return Error{ErrorCode::illegal_parameter,
                 "verify compares the CPU reference with a device; leave out --cpu"};
  }
  auto recording = open_recording(options.stream);
  if (!recording) return recording.error();
  const auto reference = make_reference(options.stream, recording->sensor);
  if (!reference) return reference.error();
  const auto device = make_gpu(options.stream, recording->sensor);
  if (!device) return device.error();

  Representation& a = *reference->representation;
  Representation& b = *device->representation;
  const SideNames names{reference->name, device->name};
  PlayOptions play_options{.batches = options.stream.batches};
  if (options.max_events) play_options.max_events = *options.max_events;
  const auto make_tolerance = [&] { return tolerance_of(options.stream, recording->sensor); };
  const auto tolerance = make_tolerance();
  auto run = run_in_lockstep(*recording->source, play_options, a, b, names, tolerance.get());
  if (!run) return run.error();
  if (!run->difference) {
    std::cout << text(tolerance ? "within the bound: " : "identical: ", run->events, " events, ",
                      run->batches, " batches, ", subject(options.stream, a), ", device ", device->name,
                      tolerance ? text("; ", tolerance->report()) : "", "\n");
    return 0;
  }
  if (options.stream.file == "-") {
    std::cout << text("different after ", run->events, " events, ", run->batches,
                      " batches: ", *run->difference,
                      "\nstandard input cannot be read again: no failing prefix was written\n");
    return 1;
  }
  const auto open_again = [&] { return open_events(options.stream.file, options.stream.read); };
  const Lockstep failed =
      shortest_failure(*std::move(run), open_again, play_options, a, b, names, make_tolerance);
  std::cout << text("different after ", failed.events, " events, ", failed.batches,
                    " batches: ", *failed.difference, "\n");
  if (auto r = write_prefix(open_again, recording->sensor, failed.events, options.failing); !r) {
    return r.error();
  }
  std::cout << text("failing prefix: ", options.failing, "\n");
  return 1;
}

}  // namespace

void add_verify(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("verify", "Compare a device with the CPU reference, batch by batch");
  auto options = std::make_shared<VerifyOptions>();
  add_stream_options(*app, options->stream);
  add_parsed_option(*app, "--max-events", options->max_events, parse_whole<uint64_t>,
                    "Stop after so many events");
  app->add_option("--failing", options->failing,
                  "Text recording for the failing prefix, default NAME.failing.txt in the current folder");
  app->callback([&command, options] {
    if (options->failing.empty()) {
      options->failing = std::filesystem::path(options->stream.file).stem().string() + ".failing.txt";
    }
    command.run = [options] { return verify(*options); };
  });
}

}  // namespace scarf::tools
