// scarf bench --paper: the paper's cost table and figure, for every representation.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/paper_report.h"
#include "bench/published.h"
#include "core/text.h"
#include "io/files/write_file.h"
#include "scarf/io/recordings.h"
#include "scarf/reference/reference.h"
#include "tools/bench/bench.h"

namespace scarf::tools {
namespace {

constexpr SensorSize kSensors[] = {{240, 180}, {1280, 720}};
// Events per second of recorded time: a camera in motion, at sizes below and above kLarge pixels.
constexpr double kSmallRate = 5e6;
constexpr double kLargeRate = 20e6;
constexpr int32_t kLarge = 300'000;

struct Effort {
  size_t events;   // of the recording or the simulation, before they are repeated
  double seconds;  // for each figure
};
constexpr Effort kQuick = {1'000'000, 0.2};
constexpr Effort kFull = {4'000'000, 1.2};

// A line on the terminal that tells what is being measured.
void show(const std::string& line) {
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
}

Result<std::vector<Event>> read_some(EventSource& source, size_t most) {
  std::vector<Event> events(most);
  size_t n = 0;
  while (n < most) {
    const auto read = source.read(std::span(events).subspan(n));
    if (!read) return read.error();
    if (*read == 0) break;
    n += *read;
  }
  events.resize(n);
  return events;
}

struct Input {
  SensorSize sensor;
  bench::EndlessStream stream;
};

Input input_of(std::vector<Event> events, SensorSize sensor) {
  return {sensor, bench::EndlessStream(std::move(events), bench::kQueryRates.front())};
}

Result<Input> recording(const BenchOptions& options, const Effort& effort) {
  const auto source = open_events(options.file, {.sensor = options.sensor});
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, options.file);
  if (!sensor) return sensor.error();
  auto events = read_some(**source, effort.events);
  if (!events) return events.error();
  if (events->empty())
    return Error{ErrorCode::bad_input, text(options.file, " has no events to measure with")};
  return input_of(*std::move(events), *sensor);
}

Result<Input> simulation(SensorSize sensor, const Effort& effort) {
  show(text("simulating a shaking camera of ", sensor.width, 'x', sensor.height));
  const bool large = int64_t{sensor.width} * sensor.height >= kLarge;
  auto events = bench::shaken_scene(sensor, effort.events, large ? kLargeRate : kSmallRate);
  if (!events) return events.error();
  return input_of(*std::move(events), sensor);
}

Result<std::vector<Parameters>> representations_to_measure(const BenchOptions& options) {
  std::vector<Parameters> all;
  for (const RepresentationInfo& info : representations()) {
    if (!options.representation.empty() && options.representation != info.name) continue;
    const auto parameters = parse_parameters(info.name, options.parameters);
    if (!parameters) return parameters.error();
    all.push_back(*parameters);
  }
  return all;
}

template <class Made>
Result<bench::Costs> costs(Result<Made> made, const Parameters& parameters, bench::EndlessStream& stream,
                           double seconds) {
  if (!made) return made.error();
  return bench::measure_costs(**made, parameters, stream, seconds);
}

nlohmann::json json_of(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json json_of(const bench::PaperRow& row, const char* implementation,
                       const Result<bench::Costs>& costs) {
  nlohmann::json out = {{"benchmark", "paper"},
                        {"implementation", implementation},
                        {"representation", row.representation},
                        {"width", row.sensor.width},
                        {"height", row.sensor.height},
                        {"stream_events_per_s", row.stream_rate}};
  const auto published = [](const bench::PublishedCosts& figures) {
    return nlohmann::json{{"ns_per_event", json_of(figures.ns_per_event)},
                          {"query_us", json_of(figures.query_us)}};
  };
  out["paper"] = published(bench::costs_in_paper(row.representation, row.sensor));
  out["released_code"] = published(bench::costs_of_released_code(row.representation, row.sensor));
  if (const std::string words = bench::remark(costs); !words.empty()) out["remark"] = words;
  if (!costs) return out;
  out["ns_per_event"] = costs->ns_per_event;
  out["query_us"] = costs->query_us;
  for (size_t i = 0; i < bench::kQueryRates.size(); ++i) {
    out["throughput"].push_back(
        {{"query_hz", bench::kQueryRates[i]}, {"events_per_s", json_of(costs->events_per_second[i])}});
  }
  return out;
}

Result<void> write_files(const BenchOptions& options, const std::vector<bench::PaperRow>& rows,
                         const nlohmann::json& head, const std::string& device_name) {
  if (!options.csv.empty()) {
    if (auto r = write_file(options.csv, bench::csv(rows), options.rule); !r) return r;
  }
  if (!options.plot.empty()) {
    const std::string plot = bench::svg(bench::throughput_plot(rows, device_name));
    if (auto r = write_file(options.plot, plot, options.rule); !r) return r;
  }
  if (options.json.empty()) return {};
  nlohmann::json report = head;
  report["results"] = nlohmann::json::array();
  for (const bench::PaperRow& row : rows) {
    report["results"].push_back(json_of(row, "reference", row.reference));
    report["results"].push_back(json_of(row, "gpu", row.device));
  }
  return write_file(options.json, report.dump(1) + "\n", options.rule);
}

}  // namespace

Result<int> bench_paper(const BenchOptions& options) {
  const Effort& effort = options.quick ? kQuick : kFull;
  const auto measured = representations_to_measure(options);
  if (!measured) return measured.error();
  std::shared_ptr<GpuContext> context;
  if (!options.cpu) {
    auto made = GpuContext::create(options.device);
    if (!made) return made.error();
    context = *std::move(made);
  }
  const std::string device = context ? context->device().name : "no device";
  const std::string driver = context ? context->device().driver : "";
  const std::string source = options.file.empty() ? "a simulated shaking camera" : options.file;
  std::cout << text(
                   "device ", device, driver.empty() ? "" : ", driver ", driver, ", commit ", SCARF_COMMIT,
                   "\n", "events of ", source, ", ", bench::kBatch, " per push; about ", effort.seconds,
                   " s for each figure\n",
                   "C/E: pushes alone. C/U: one finished u8 image of an up-to-date state. ratio: reference / "
                   "device\n",
                   "paper: its cost table, 240x180 only. released: its code on a 2-core machine; scarf with "
                   "fields of r = 1.2\n")
            << bench::table_head() << std::flush;

  std::vector<bench::PaperRow> rows;
  const auto measure_on = [&](Input input) {
    for (const Parameters& parameters : *measured) {
      const RepresentationInfo& info = info_of(parameters);
      bench::PaperRow row{.representation = info.name,
                          .title = info.title,
                          .sensor = input.sensor,
                          .stream_rate = input.stream.events_per_second()};
      const std::string what = text(info.name, " at ", input.sensor.width, 'x', input.sensor.height);
      show(text("measuring ", what, " in the reference"));
      row.reference = costs(make_reference_representation(parameters, input.sensor), parameters, input.stream,
                            effort.seconds);
      show(text("measuring ", what, " on the device"));
      row.device = context ? costs(make_gpu_representation(context, parameters, input.sensor), parameters,
                                   input.stream, effort.seconds)
                           : Error{};
      show("");
      std::cout << bench::table_line(row) << std::flush;
      rows.push_back(std::move(row));
    }
  };
  if (!options.file.empty()) {
    auto input = recording(options, effort);
    if (!input) return input.error();
    measure_on(*std::move(input));
  } else {
    std::vector<SensorSize> sensors(std::begin(kSensors), std::end(kSensors));
    if (options.sensor) sensors = {*options.sensor};
    for (const SensorSize sensor : sensors) {
      auto input = simulation(sensor, effort);
      if (!input) return input.error();
      measure_on(*std::move(input));
    }
  }
  const nlohmann::json head = {{"schema", kBenchSchema},
                               {"device", device},
                               {"driver", driver},
                               {"commit", SCARF_COMMIT},
                               {"events", source}};
  if (auto r = write_files(options, rows, head, device); !r) return r.error();
  return 0;
}

}  // namespace scarf::tools
