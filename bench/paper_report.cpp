#include "bench/paper_report.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "bench/published.h"
#include "core/text.h"

namespace scarf::bench {
namespace {

constexpr int kNumber = 10;  // characters of a column
constexpr int kName = 12;
constexpr int kSensor = 10;

// Three significant digits, or all before the point.
std::string number(std::optional<double> value) {
  if (!value) return "-";
  const int decimals = *value < 1 ? 3 : *value < 10 ? 2 : *value < 100 ? 1 : 0;
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, *value);
  return buffer;
}

std::string padded(const std::string& word, int width) {
  const std::string spaces(std::max(0, width - static_cast<int>(word.size())), ' ');
  return spaces + word;
}
std::string padded_behind(const std::string& word, int width) {
  return word + std::string(std::max(0, width - static_cast<int>(word.size())), ' ');
}

std::string sensor_name(SensorSize sensor) {
  return text(sensor.width, 'x', sensor.height);
}

std::optional<double> of(const Result<Costs>& costs, double Costs::*figure) {
  return costs ? std::optional((*costs).*figure) : std::nullopt;
}

// Reference, device, how many times as fast, the paper, the released code.
std::string columns(std::optional<double> reference, std::optional<double> device,
                    std::optional<double> in_paper, std::optional<double> of_released) {
  const auto ratio = reference && device ? std::optional(*reference / *device) : std::nullopt;
  std::string out;
  for (const auto& figure : {reference, device, ratio, in_paper, of_released})
    out += padded(number(figure), kNumber);
  return out;
}

// Quoted, so that it may hold commas; nothing stays nothing.
std::string quoted(const std::string& words) {
  if (words.empty()) return "";
  std::string out = "\"";
  for (const char c : words) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string csv_number(std::optional<double> value) {
  return value ? text(*value) : "";
}

std::string csv_line(const PaperRow& row, const std::string& implementation, const Result<Costs>& costs) {
  const PublishedCosts paper = costs_in_paper(row.representation, row.sensor);
  const PublishedCosts released = costs_of_released_code(row.representation, row.sensor);
  std::string out =
      text(row.representation, ',', row.sensor.width, ',', row.sensor.height, ',', implementation, ',',
           csv_number(of(costs, &Costs::ns_per_event)), ',', csv_number(of(costs, &Costs::query_us)));
  for (size_t i = 0; i < kQueryRates.size(); ++i) {
    out += "," + (costs ? csv_number(costs->events_per_second[i]) : "");
  }
  for (const auto& figure : {paper.ns_per_event, paper.query_us, released.ns_per_event, released.query_us}) {
    out += "," + csv_number(figure);
  }
  return text(out, ',', row.stream_rate, ',', quoted(remark(costs)), '\n');
}

}  // namespace

std::string remark(const Result<Costs>& costs) {
  if (!costs) return costs.error().message;
  std::string rates;
  for (size_t i = 0; i < kQueryRates.size(); ++i) {
    if (!costs->events_per_second[i]) rates += text(rates.empty() ? "" : ", ", kQueryRates[i]);
  }
  if (rates.empty()) return "";
  return text("no throughput at ", rates, " images per second: the events between two images take too long");
}

std::string table_head() {
  const int five = 5 * kNumber;
  std::string out = std::string(kName + kSensor, ' ') + padded("C/E: ns per event", five) +
                    padded("C/U: us per query", five) + "\n" + padded_behind("", kName) +
                    padded("sensor", kSensor);
  for (int i = 0; i < 2; ++i) {
    for (const char* column : {"reference", "device", "ratio", "paper", "released"})
      out += padded(column, kNumber);
  }
  return out + "\n";
}

std::string table_line(const PaperRow& row) {
  const PublishedCosts paper = costs_in_paper(row.representation, row.sensor);
  const PublishedCosts released = costs_of_released_code(row.representation, row.sensor);
  const auto two_sided = [&](double Costs::*figure, std::optional<double> in_paper,
                             std::optional<double> old) {
    return columns(of(row.reference, figure), of(row.device, figure), in_paper, old);
  };
  std::string out = padded_behind(row.representation, kName) + padded(sensor_name(row.sensor), kSensor) +
                    two_sided(&Costs::ns_per_event, paper.ns_per_event, released.ns_per_event) +
                    two_sided(&Costs::query_us, paper.query_us, released.query_us) + "\n";
  const auto narrow = costs_of_released_default_scarf(row.sensor).ns_per_event;
  if (row.representation == "scarf" && narrow) {
    out +=
        text("    released with its default fields, cells of 10 pixels: ", number(narrow), " ns per event\n");
  }
  for (const auto& [name, costs] :
       {std::pair{"reference", &row.reference}, std::pair{"device", &row.device}}) {
    if (const std::string words = remark(*costs); !words.empty())
      out += text("    ", name, ": ", words, "\n");
  }
  return out;
}

std::string csv(std::span<const PaperRow> rows) {
  std::string out = "representation,width,height,implementation,ns_per_event,query_us";
  for (const int32_t hz : kQueryRates) out += text(",events_per_s_at_", hz, "_hz");
  out +=
      ",paper_ns_per_event,paper_query_us,released_ns_per_event,released_query_us,stream_events_per_s,"
      "remark\n";
  for (const PaperRow& row : rows) {
    out += csv_line(row, "reference", row.reference) + csv_line(row, "gpu", row.device);
  }
  return out;
}

Plot throughput_plot(std::span<const PaperRow> rows, const std::string& device_name) {
  Plot plot{.title = "Throughput against query rate",
            .x_label = "u8 images per second of recorded time",
            .y_label = "million events per second",
            .level_label = "rate of the stream",
            .x_ticks = {kQueryRates.begin(), kQueryRates.end()},
            .labels = {},
            .panels = {},
            .columns = 2};
  const auto add_line = [](Panel& panel, size_t line, const Result<Costs>& costs) {
    panel.lines.resize(std::max(panel.lines.size(), line + 1));
    for (size_t i = 0; costs && i < kQueryRates.size(); ++i) {
      const auto throughput = costs->events_per_second[i];
      if (throughput) panel.lines[line].emplace_back(kQueryRates[i], *throughput / 1e6);
    }
  };
  std::vector<SensorSize> sensors;
  for (const PaperRow& row : rows) {
    size_t sensor = 0;
    while (sensor < sensors.size() && !(sensors[sensor] == row.sensor)) ++sensor;
    if (sensor == sensors.size()) {
      sensors.push_back(row.sensor);
      const std::string name = sensor_name(row.sensor);
      plot.panels.push_back({text(name, ", CPU reference"), {}, row.stream_rate / 1e6});
      plot.panels.push_back({text(name, ", ", device_name), {}, row.stream_rate / 1e6});
    }
    const auto label = std::find(plot.labels.begin(), plot.labels.end(), row.title);
    const auto line = static_cast<size_t>(label - plot.labels.begin());
    if (label == plot.labels.end()) plot.labels.push_back(row.title);
    add_line(plot.panels[2 * sensor], line, row.reference);
    add_line(plot.panels[2 * sensor + 1], line, row.device);
  }
  return plot;
}

}  // namespace scarf::bench
