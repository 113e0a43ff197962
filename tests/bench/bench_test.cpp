// What scarf bench --paper measures and writes; no test depends on how long anything takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/paper_report.h"
#include "bench/published.h"
#include "bench/push.h"
#include "core/text.h"
#include "scarf/reference/reference.h"
#include "tests/support/context.h"
#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::bench {
namespace {

using testing::HasSubstr;
using testing::Not;
using tools::content_of;
using tools::random_events;

constexpr SensorSize kSensor{64, 48};

std::vector<std::string> lines_of(const std::string& content) {
  std::istringstream in(content);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

// The first mistake in the nesting of an XML document without comments; empty if there is none.
std::string xml_mistake(const std::string& document) {
  std::vector<std::string> open;
  for (size_t i = document.find('<'); i != std::string::npos; i = document.find('<', i + 1)) {
    const size_t end = document.find('>', i);
    if (end == std::string::npos) return "a tag without end";
    const std::string tag = document.substr(i + 1, end - i - 1);
    if (tag.find('<') != std::string::npos) return text("< within ", tag);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return text("an open quote in ", tag);
    const std::string name = tag.substr(0, tag.find(' '));
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return text("unexpected ", tag);
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = end;
  }
  return open.empty() ? "" : text("not closed: ", open.back());
}

size_t count_of(const std::string& word, const std::string& content) {
  size_t n = 0;
  for (size_t i = content.find(word); i != std::string::npos; i = content.find(word, i + 1)) ++n;
  return n;
}

EndlessStream short_stream() {
  return {random_events(5'000, kSensor), static_cast<double>(kQueryRates.front())};
}

Costs some_costs() {
  return {.ns_per_event = 12.5, .query_us = 3, .events_per_second = {4e6, 3e6, 2e6, 1e6}};
}

TEST(EndlessStream, RepeatsAShortRecordingWithTimesThatGoOn) {
  const std::vector<Event> events = random_events(70'000, kSensor);
  EndlessStream stream(events, 30);
  ASSERT_EQ(stream.size(), 140'000u);
  const int64_t period = events.back().t - events.front().t + 1;
  const auto all = stream.next(stream.size());
  for (size_t i = 0; i < all.size(); ++i) {
    Event expected = events[i % events.size()];
    expected.t += i < events.size() ? 0 : period;
    ASSERT_EQ(all[i], expected) << i;
  }
  EXPECT_EQ(stream.next(1)[0].t, events.front().t + 2 * period);
}

TEST(EndlessStream, BeginsAnewWhereAPieceWouldRunOverTheEnd) {
  const std::vector<Event> events = random_events(100'000, kSensor);
  EndlessStream stream(events, 30);
  ASSERT_EQ(stream.size(), events.size());
  stream.next(60'000);
  const auto rest = stream.next(40'000);
  EXPECT_EQ(rest.front(), events[60'000]);
  stream.next(60'000);
  const auto again = stream.next(60'000);
  EXPECT_EQ(again.front().x, events.front().x);
  EXPECT_GT(again.front().t, events.back().t);
}

TEST(EndlessStream, HoldsTheEventsBetweenTwoOfTheSlowestQueries) {
  std::vector<Event> events(1000);
  for (size_t i = 0; i < events.size(); ++i) events[i].t = static_cast<int64_t>(i / 50);  // 50 Mev/s
  const EndlessStream stream(events, 30);
  EXPECT_DOUBLE_EQ(stream.events_per_second(), 50e6);
  EXPECT_EQ(stream.events_per_query(1000), 50'000u);
  EXPECT_GE(stream.size(), stream.events_per_query(30));
}

TEST(ShakenScene, HasTheRateThatWasAskedFor) {
  const auto events = shaken_scene(kSensor, 20'000, 5e6);
  ASSERT_TRUE(events.ok()) << events.error().message;
  EXPECT_GE(events->size(), 20'000u);
  const EndlessStream stream(*events, 30);
  EXPECT_NEAR(stream.events_per_second(), 5e6, 5e4);
  EXPECT_TRUE(
      std::all_of(events->begin(), events->end(), [](const Event& e) { return kSensor.contains(e); }));
}

TEST(PaperCosts, AreMeasuredForEveryReference) {
  for (const RepresentationInfo& info : representations()) {
    const Parameters parameters = *parse_parameters(info.name);
    auto representation = make_reference_representation(parameters, kSensor);
    ASSERT_TRUE(representation.ok()) << info.name;
    EndlessStream stream = short_stream();
    const auto costs = measure_costs(**representation, parameters, stream, 0.002);
    ASSERT_TRUE(costs.ok()) << info.name << ": " << costs.error().message;
    EXPECT_GT(costs->ns_per_event, 0) << info.name;
    EXPECT_GT(costs->query_us, 0) << info.name;
  }
}

using BenchOnDevice = test::DeviceTest;

TEST_F(BenchOnDevice, CostsAreMeasured) {
  const Parameters parameters = TimeWindowParameters{};
  auto representation = make_gpu_representation(context_, parameters, kSensor);
  ASSERT_TRUE(representation.ok()) << representation.error().message;
  EndlessStream stream = short_stream();
  const auto costs = measure_costs(**representation, parameters, stream, 0.01);
  ASSERT_TRUE(costs.ok()) << costs.error().message;
  EXPECT_GT(costs->ns_per_event, 0);
  EXPECT_GT(costs->query_us, 0);
}

TEST(PaperCosts, WhatTakesTooLongIsLeftOut) {
  const Parameters parameters = TosParameters{};
  auto representation = *make_reference_representation(parameters, kSensor);
  EndlessStream stream = short_stream();
  const auto costs = measure_costs(*representation, parameters, stream, 1e-12);
  ASSERT_TRUE(costs.ok()) << costs.error().message;
  for (const auto& throughput : costs->events_per_second) EXPECT_FALSE(throughput);
  EXPECT_THAT(remark(*costs), HasSubstr("30, 100, 300, 1000"));
}

TEST(TimePush, TellsHowManyEventsItTook) {
  auto representation = *make_reference_representation(SaeParameters{}, kSensor);
  const auto time = time_push(*representation, random_events(250'000, kSensor), 1);
  ASSERT_TRUE(time.ok());
  EXPECT_EQ(time->events, 250'000u);
  EXPECT_GT(time->ns_per_event, 0);
  EXPECT_GT(time->query_us, 0);
}

TEST(Published, FiguresBelongToTheirSensors) {
  EXPECT_EQ(costs_in_paper("scarf", {240, 180}).ns_per_event, 70);
  EXPECT_EQ(costs_in_paper("aed_sae", {240, 180}).query_us, 2786);
  EXPECT_FALSE(costs_in_paper("scarf", {1280, 720}).ns_per_event);
  EXPECT_FALSE(costs_in_paper("sae", {240, 180}).query_us);
  EXPECT_EQ(costs_of_released_code("scarf", {1280, 720}).ns_per_event, 537);
  EXPECT_EQ(costs_of_released_default_scarf({1280, 720}).ns_per_event, 150);
  EXPECT_EQ(costs_of_released_code("chain_sae", {346, 260}).query_us, 734);
  EXPECT_FALSE(costs_of_released_code("eros", {240, 180}).query_us);
  EXPECT_FALSE(costs_of_released_code("scarf", {64, 48}).ns_per_event);
}

TEST(PaperReport, EveryLineOfTheCsvHasEveryColumn) {
  const PaperRow row{"eros", "EROS",       {240, 180},
                     5e6,    some_costs(), Error{ErrorCode::device, "lost, \"gone\""}};
  const auto lines = lines_of(csv(std::vector{row}));
  ASSERT_EQ(lines.size(), 3u);
  const auto names = cells_of(lines[0]);
  const auto reference = cells_of(lines[1]);
  const auto device = cells_of(lines[2]);
  ASSERT_EQ(reference.size(), names.size());
  ASSERT_EQ(device.size(), names.size());
  const auto cell = [&](const std::vector<std::string>& line, const std::string& name) -> std::string {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? "no column " + name : line[static_cast<size_t>(found - names.begin())];
  };
  EXPECT_EQ(cell(reference, "implementation"), "reference");
  EXPECT_EQ(cell(reference, "ns_per_event"), "12.5");
  EXPECT_EQ(cell(reference, "events_per_s_at_1000_hz"), "1e+06");
  EXPECT_EQ(cell(reference, "paper_ns_per_event"), "84");
  EXPECT_EQ(cell(reference, "released_query_us"), "");
  EXPECT_EQ(cell(reference, "remark"), "");
  EXPECT_EQ(cell(device, "implementation"), "gpu");
  EXPECT_EQ(cell(device, "ns_per_event"), "");
  EXPECT_EQ(cell(device, "remark"), "\"lost, \"\"gone\"\"\"");
}

TEST(PaperReport, TheTableShowsReasonsAndFigures) {
  const PaperRow row{"tos", "TOS", {240, 180}, 5e6, some_costs(), Error{ErrorCode::device, "no such stage"}};
  const auto lines = lines_of(table_line(row));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], HasSubstr(" 12.5 "));
  EXPECT_THAT(lines[0], HasSubstr(" 96.0 "));
  EXPECT_THAT(lines[1], HasSubstr("device: no such stage"));
  const auto head = lines_of(table_head());
  ASSERT_EQ(head.size(), 2u);
  EXPECT_EQ(head[1].size(), lines[0].size());
}

TEST(PaperReport, ThePlotHasALineForEachRowAndSide) {
  std::vector<PaperRow> rows;
  for (const SensorSize sensor : {SensorSize{240, 180}, SensorSize{1280, 720}}) {
    rows.push_back({"eros", "EROS", sensor, 5e6, some_costs(), some_costs()});
    rows.push_back({"tos", "T<O>S & \"co\"", sensor, 5e6, some_costs(), Error{}});
  }
  const Plot plot = throughput_plot(rows, "a <device>");
  ASSERT_EQ(plot.panels.size(), 4u);
  ASSERT_EQ(plot.labels.size(), 2u);
  EXPECT_EQ(plot.panels[0].lines[0].size(), kQueryRates.size());
  EXPECT_TRUE(plot.panels[1].lines[1].empty());
  const std::string document = svg(plot);
  EXPECT_EQ(xml_mistake(document), "");
  EXPECT_EQ(count_of("<polyline", document), 6u);
  EXPECT_THAT(document, HasSubstr("T&lt;O&gt;S &amp; &quot;co&quot;"));
}

TEST(Plot, IsFiniteWithoutAnyLineAndWithASinglePoint) {
  Plot plot{.title = "t",
            .x_label = "x",
            .y_label = "y",
            .level_label = "",
            .x_ticks = {10},
            .labels = {"a"},
            .panels = {}};
  for (const bool with_point : {false, true}) {
    plot.panels = {{"p", {{}}, std::nullopt}};
    if (with_point) plot.panels[0].lines[0].emplace_back(10, 1000);
    const std::string document = svg(plot);
    EXPECT_EQ(xml_mistake(document), "");
    EXPECT_THAT(document, Not(HasSubstr("nan")));
    EXPECT_THAT(document, Not(HasSubstr("inf")));
  }
}

// The built program from outside.
class BenchProgram : public testing::Test {
 protected:
  int run(const std::string& arguments) {
    const std::string command =
        text("exec ", SCARF_PROGRAM, " bench ", arguments, " >", path("out"), " 2>", path("err"));
    const int status = std::system(command.c_str());
    out_ = content_of(path("out"));
    err_ = content_of(path("err"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string path(const std::string& name) const { return folder_.path(name); }

  std::string out_;
  std::string err_;

 private:
  const tools::TemporaryFolder folder_;
};

TEST_F(BenchProgram, BadUsageExitsWithTwo) {
  for (const std::string arguments :
       {"--representation none", "--kernel 9", "--csv x", "--plot x", "--file x", "--geometry 64x48", "--cpu",
        "--paper --stages", "--paper --geometry 0x0", "--paper --cpu --device 0", "--streams 0",
        "--streams 2 --wire", "--streams --replay", "extra"}) {
    EXPECT_EQ(run(arguments), 2) << arguments << "\n" << err_;
    EXPECT_EQ(lines_of(err_).size(), 1u) << arguments << "\n" << err_;
  }
}

#ifdef NDEBUG

TEST_F(BenchProgram, ParametersOfOtherRepresentationsAreRefused) {
  EXPECT_EQ(run("--paper --cpu --representation sae --kernel 9"), 2);
  EXPECT_THAT(err_, HasSubstr("kernel"));
}

TEST_F(BenchProgram, WritesTheTableAsCsvJsonAndPlot) {
  ASSERT_EQ(run(text("--paper --quick --cpu --representation eros --kernel 5 --geometry 64x48 --csv ",
                     path("o.csv"), " --json ", path("o.json"), " --plot ", path("o.svg"))),
            0)
      << err_;
  EXPECT_EQ(err_, "");
  EXPECT_THAT(out_, HasSubstr("eros"));
  EXPECT_EQ(lines_of(content_of(path("o.csv"))).size(), 3u);
  const auto report = nlohmann::json::parse(content_of(path("o.json")));
  EXPECT_EQ(report["schema"], 1);
  ASSERT_EQ(report["results"].size(), 2u);
  EXPECT_GT(report["results"][0]["ns_per_event"].get<double>(), 0);
  EXPECT_EQ(report["results"][0]["throughput"].size(), kQueryRates.size());
  EXPECT_FALSE(report["results"][1].contains("ns_per_event"));
  EXPECT_EQ(xml_mistake(content_of(path("o.svg"))), "");
}

TEST_F(BenchProgram, ComparesManyStreamsWithOne) {
  ASSERT_EQ(run("--streams 2 --quick --json " + path("o.json")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("one stream of 20000 events per batch, and 2 streams of 10000"));
  const auto report = nlohmann::json::parse(content_of(path("o.json")));
  EXPECT_EQ(report["schema"], 1);
  ASSERT_EQ(report["results"].size(), 6u);  // sensors and presets
  for (const auto& result : report["results"]) {
    EXPECT_EQ(result["streams"], 2);
    for (const char* contender : {"one", "together", "alone"}) {
      EXPECT_GT(result[contender]["ns_per_event"].get<double>(), 0);
    }
  }
}

TEST_F(BenchProgram, TakesARecording) {
  tools::write_text(path("one.txt"), "64 48\n0.000001 1 2 1\n0.000002 3 4 0\n");
  ASSERT_EQ(run("--paper --quick --cpu --representation time_window --file " + path("one.txt")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("64x48"));
  tools::write_text(path("none.txt"), "64 48\n");
  EXPECT_EQ(run("--paper --quick --cpu --file " + path("none.txt")), 1);
  EXPECT_THAT(err_, HasSubstr("no events"));
  EXPECT_EQ(run("--paper --quick --cpu --file " + path("missing.raw")), 1);
}

#else

TEST_F(BenchProgram, RefusesADebugBuild) {
  EXPECT_EQ(run("--paper --quick --cpu"), 1);
  EXPECT_THAT(err_, HasSubstr("debug build"));
}

#endif

}  // namespace
}  // namespace scarf::bench
