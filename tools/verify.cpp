// scarf verify: the CPU reference and the device on the same stream, compared after every batch.
#include <filesystem>
#include <iostream>
#include <map>
#include <tuple>

#include "compare/lockstep.h"
#include "core/text.h"
#include "session/device_words.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

struct VerifyOptions {
  StreamRequest stream;
  std::optional<uint64_t> max_events;
  std::string failing;  ///< where the failing prefix goes
  bool decode_on_device = false;
  GpuOptions plan;
};

// None where every bit must be the same.
std::unique_ptr<Tolerance> tolerance_of(const StreamRequest& options, SensorSize sensor) {
  if (options.representation == "scarf") return nullptr;
  const auto parameters = parameters_of(options);
  if (!parameters || info_of(*parameters).exact) return nullptr;
  return std::make_unique<Tolerance>(*parameters, sensor);
}

// What was compared.
std::string subject(const StreamRequest& options, Representation& r) {
  if (const auto* scarf = dynamic_cast<Scarf*>(&r)) return text(scarf->geometry().patches(), " patches");
  return text(options.representation, " on ", r.sensor().width, "x", r.sensor().height);
}

std::string identical(const Lockstep& run, const StreamRequest& options, Representation& reference,
                      const std::string& device, const Tolerance* tolerance) {
  return text(tolerance ? "within the bound: " : "identical: ", run.events, " events, ", run.batches,
              " batches, ", subject(options, reference), ", device ", device,
              tolerance ? text("; ", tolerance->report()) : "", "\n");
}

// The reference gets the events that a reader makes of the bytes that the device got.
Result<std::optional<std::string>> push_and_compare(EventSource& source, const ReadReport& on_device,
                                                    Lockstep& run, Representation& a, Representation& b,
                                                    const SideNames& names, Tolerance* tolerance) {
  std::vector<Event> events(on_device.events - run.events);
  size_t filled = 0;
  while (filled < events.size()) {
    const auto n = source.read(std::span(events).subspan(filled));
    if (!n) return n.error();
    if (*n == 0)
      return std::optional(text("the device decoded more events than the reader's ", run.events + filled));
    filled += *n;
  }
  if (const auto pushed = a.push(events); !pushed) return pushed.error();
  run.events += events.size();
  run.batches += 1;
  return first_difference(a, b, names, tolerance);
}

Result<int> verify_decoding(const VerifyOptions& options, EventSource& source, Representation& a,
                            Representation& b, const SideNames& names, Tolerance* tolerance) {
  if (options.max_events) {
    return Error{ErrorCode::illegal_parameter,
                 "--max-events is not offered with --decode device, which reads whole words; leave it out"};
  }
  Representation* const to[] = {&b};
  auto words = DeviceWords::open(options.stream, to);
  if (!words) return words.error();
  BatchSizes batches = options.stream.batches;
  Lockstep run;
  while (!run.difference) {
    const auto pushed = words->push(2 * batches.next());
    if (!pushed) return pushed.error();
    const auto report = words->report();
    if (!report) return report.error();
    if (*pushed == 0) {
      Event more;
      const auto left = source.read(std::span(&more, 1));
      if (!left) return left.error();
      if (*left != 0 || source.report() != *report)
        run.difference = text("the reader's report differs from the device's after ", run.events, " events");
      break;
    }
    auto difference = push_and_compare(source, *report, run, a, b, names, tolerance);
    if (!difference) return difference.error();
    run.difference = *std::move(difference);
  }
  if (!run.difference) {
    std::cout << identical(run, options.stream, a, names.b, tolerance);
    return 0;
  }
  // Words and events are read apart: of a file that was written meanwhile they may differ.
  if (auto r = source.unchanged(); !r) return r.error();
  std::cout << text("different after ", run.events, " events, ", run.batches, " batches: ", *run.difference,
                    "\n");
  return 1;
}

// "NAME.failing.txt", or with a number if that is there: whoever gave no name is not to lose an earlier one.
Result<std::string> place_of_failing(const VerifyOptions& options, const OutputRule& rule) {
  if (!options.failing.empty()) {
    if (auto r = rule.check(options.failing); !r) return r.error();
    return options.failing;
  }
  const std::string stem = std::filesystem::path(options.stream.file).stem().string();
  std::string name = text(stem, ".failing.txt");
  for (int i = 2; std::filesystem::symlink_status(name).type() != std::filesystem::file_type::not_found;
       ++i) {
    name = text(stem, ".failing-", i, ".txt");
  }
  return name;
}

Result<int> verify(const VerifyOptions& options, const OutputRule& rule) {
  if (options.stream.cpu) {
    return Error{ErrorCode::illegal_parameter,
                 "verify compares the CPU reference with a device; leave out --cpu"};
  }
  const auto failing = place_of_failing(options, rule);
  if (!failing) return failing.error();
  auto recording = open_recording(options.stream);
  if (!recording) return recording.error();
  const auto reference = make_reference(options.stream, recording->sensor);
  if (!reference) return reference.error();
  const auto device = make_gpu(options.stream, recording->sensor, options.plan);
  if (!device) return device.error();

  Representation& a = *reference->representation;
  Representation& b = *device->representation;
  const SideNames names{reference->name, device->name};
  PlayOptions play_options{.batches = options.stream.batches};
  if (options.max_events) play_options.max_events = *options.max_events;
  const auto make_tolerance = [&] { return tolerance_of(options.stream, recording->sensor); };
  const auto tolerance = make_tolerance();
  const bool none_wanted = options.max_events == 0u;
  const auto some = [&] {
    return require_events(options.stream.file, recording->source->report(),
                          options.stream.allow_empty || none_wanted);
  };
  if (options.decode_on_device) {
    auto outcome = verify_decoding(options, *recording->source, a, b, names, tolerance.get());
    if (auto r = some(); outcome && !r) return r.error();
    return outcome;
  }
  auto run = run_in_lockstep(*recording->source, play_options, a, b, names, tolerance.get());
  if (!run) return run.error();
  if (auto r = some(); !r) return r.error();
  if (!run->difference) {
    std::cout << identical(*run, options.stream, a, device->name, tolerance.get());
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
  if (auto r = write_prefix(open_again, recording->sensor, failed.events, *failing, rule); !r) {
    return r.error();
  }
  std::cout << text("failing prefix: ", *failing, "\n");
  return 1;
}

}  // namespace

void add_verify(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("verify", "Compare a device with the CPU reference, batch by batch");
  auto options = std::make_shared<VerifyOptions>();
  add_settings(*app, stream_settings(options->stream));
  add_decode_option(*app, options->decode_on_device);
  add_parsed_option(*app, "--max-events", options->max_events, parse_whole<uint64_t>,
                    "Stop after so many events");
  add_output_option(*app, "--failing", options->failing,
                    "Text recording that is written of the events up to a difference; default "
                    "NAME.failing.txt in the current folder");
  const std::string plan = "How work is cut; never changes a result, 0 is chosen for the device";
  for (const auto& [name, number, help] :
       {std::tuple("--submission-events", &GpuOptions::submission_events, "Events per submission"),
        std::tuple("--chunk-events", &GpuOptions::chunk_events, "Events of scarf walked by one team"),
        std::tuple("--bands", &GpuOptions::bands, "Bands of rows of scarf's patches")}) {
    add_parsed_option(*app, name, options->plan.*number, parse_whole<uint32_t>, help)->group(plan);
  }
  const std::map<std::string, GpuOptions::Placing> placings = {{"automatic", GpuOptions::Placing::automatic},
                                                               {"chunked", GpuOptions::Placing::chunked},
                                                               {"appended", GpuOptions::Placing::appended}};
  app->add_option("--placing", options->plan.placing, "How events of scarf get into the rings")
      ->transform(CLI::CheckedTransformer(placings))
      ->group(plan);
  app->callback([&command, app, options] {
    command.run = [app, options] { return verify(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
