#include "tools/read_options.h"

#include <map>
#include <string>

#include "core/text.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

// An option with one of several words, each of which is a value.
template <class T>
void add_choice(CLI::App& app, const std::string& name, T& target, const std::map<std::string, T>& words,
                const std::string& help) {
  app.add_option(name, target, help)->transform(CLI::CheckedTransformer(words))->group("Reading");
}

}  // namespace

void add_read_options(CLI::App& app, ReadOptions& o) {
  const std::string group = "Reading";
  add_parsed_option(app, "--geometry", o.sensor, parse_sensor,
                    "Sensor size WxH, where the recording does not say")
      ->group(group);
  add_word_option(app, "--format", o.format, "Format, where the content does not tell; see scarf formats")
      ->group(group);
  add_word_option(app, "--stream", o.stream, "Which camera, of a recording with several")->group(group);
  add_choice<TimePolicy>(app, "--time-policy", o.time_policy,
                         {{"keep", TimePolicy::keep},
                          {"clamp", TimePolicy::clamp},
                          {"drop", TimePolicy::drop},
                          {"error", TimePolicy::error}},
                         "Events older than one before them: keep, clamp to the newest time, drop, error");
  add_choice<OutOfSensor>(app, "--out-of-sensor", o.out_of_sensor,
                          {{"drop", OutOfSensor::drop}, {"error", OutOfSensor::error}},
                          "Events outside the sensor: drop, error");
  add_choice<TimeShift>(app, "--time-shift", o.time_shift,
                        {{"none", TimeShift::none},
                         {"first-high", TimeShift::first_high},
                         {"first-event", TimeShift::first_event}},
                        "What is subtracted from all times: none, first-high, first-event");
  app.add_flag("--strict", o.strict, "Damage, unknown words and truncated bytes are errors")->group(group);
  add_word_option(app, "--columns", o.columns,
                  "Order of the columns of text and plain arrays, such as txyp; or names of columns, such as "
                  "t=/a/ts,x=/a/xs,y=/a/ys,p=/a/pol (HDF5, NumPy)")
      ->group(group);
  app.add_option("--time-unit", o.time_unit, "Unit of times where the format leaves it open")
      ->check(CLI::IsMember({"s", "ms", "us", "ns"}))
      ->group(group);
  app.add_option("--yarp-time", o.yarp_time, "YARP packets without times of events: packet, spread")
      ->check(CLI::IsMember({"packet", "spread"}))
      ->group(group);
}

void add_allow_empty(CLI::App& app, bool& allow_empty) {
  app.add_flag("--allow-empty", allow_empty, "A recording without an event is no failure")->group("Reading");
}

Result<void> require_events(const std::string& path, const ReadReport& report, bool allow_empty) {
  if (report.events > 0 || allow_empty) return {};
  std::string met;
  const auto add = [&met](uint64_t count, std::string_view what) {
    if (count > 0) met += text(met.empty() ? " but " : ", ", count, " ", what);
  };
  add(report.outside, "events outside the sensor");
  add(report.dropped, "events older than one before them");
  add(report.undefined_polarities, "events of undefined polarity");
  add(report.unknown_words, "unknown words or lines");
  add(report.truncated_bytes, "bytes at the end that make no whole word, line or packet");
  add(report.damages, "damaged places");
  return Error{ErrorCode::bad_input, text(path == "-" ? "standard input" : path, ": not one event was read",
                                          met, "; if that is right, give --allow-empty")};
}

}  // namespace scarf::tools
