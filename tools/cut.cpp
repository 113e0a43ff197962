// scarf cut: a part of a recording, by time, by number of events, by region of the sensor.
#include <iostream>
#include <limits>
#include <optional>

#include "core/parse.h"
#include "core/text.h"
#include "io/base/sensor_size.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/recording_copy.h"

namespace scarf::tools {
namespace {

// Events a .. b-1 of those inside the sensor.
struct EventRange {
  uint64_t begin = 0;
  uint64_t end = std::numeric_limits<uint64_t>::max();
};

struct Region {
  int32_t x = 0;
  int32_t y = 0;
  int32_t width = 0;
  int32_t height = 0;
};

struct TimePoint {
  int64_t t = 0;
  bool relative = false;  // to the first event
};

struct CutOptions {
  std::string file;
  ReadOptions read;
  CopyTarget target;
  std::optional<TimePoint> from;
  std::optional<TimePoint> to;
  std::optional<EventRange> events;
  std::optional<Region> region;
};

Error illegal(std::string message) {
  return {ErrorCode::illegal_parameter, std::move(message)};
}

// "a:b", either of which may be left out.
Result<EventRange> parse_event_range(const std::string& word) {
  const size_t colon = word.find(':');
  EventRange range;
  const auto read = [](const std::string& number, uint64_t& value) {
    if (number.empty()) return true;
    const auto parsed = parse_integer<uint64_t>(number);
    value = parsed.value_or(0);
    return parsed.has_value();
  };
  if (colon == word.npos || !read(word.substr(0, colon), range.begin) ||
      !read(word.substr(colon + 1), range.end)) {
    return illegal(
        text("'", word, "' is not of the form A:B, such as 1000:2000 for the events 1000 to 1999"));
  }
  if (range.begin >= range.end) return illegal(text("the events ", word, " are none; A must be below B"));
  return range;
}

Result<Region> parse_region(const std::string& word) {
  Region r;
  int32_t* const numbers[] = {&r.x, &r.y, &r.width, &r.height};
  size_t at = 0;
  for (size_t i = 0; i < 4; ++i) {
    const size_t comma = i < 3 ? word.find(',', at) : word.size();
    const auto value =
        comma == word.npos ? std::nullopt : parse_integer<int32_t>(word.substr(at, comma - at));
    if (!value || *value < (i < 2 ? 0 : 1)) {
      return illegal(text("'", word, "' is not of the form X,Y,WIDTH,HEIGHT, such as 100,50,320,240"));
    }
    *numbers[i] = *value;
    at = comma + 1;
  }
  return r;
}

// "1.5s", or "+1.5s" for 1.5 s after the first event.
Result<TimePoint> parse_time_point(const std::string& word) {
  const bool relative = word.starts_with('+');
  if (relative && word.starts_with("+-")) {
    return illegal(text("'", word, "' is before the first event; leave it out"));
  }
  const auto time = parse_time(relative ? word.substr(1) : word);
  if (!time) return time.error();
  return TimePoint{*time, relative};
}

// Times t with from <= t < to.
struct TimeWindow {
  int64_t from = std::numeric_limits<int64_t>::min();
  int64_t to = std::numeric_limits<int64_t>::max();

  bool contains(int64_t t) const { return from <= t && t < to; }
};

// What the options ask for in a recording whose first event has the time `first`.
Result<TimeWindow> window_of(const CutOptions& options, int64_t first) {
  const auto absolute = [&](const TimePoint& point) {
    int64_t t = point.t;
    if (point.relative && __builtin_add_overflow(t, first, &t)) t = std::numeric_limits<int64_t>::max();
    return t;
  };
  TimeWindow window;
  if (options.from) window.from = absolute(*options.from);
  if (options.to) window.to = absolute(*options.to);
  if (window.from < window.to) return window;
  return illegal(text("no time is from ", window.from, " to ", window.to, " us; --from must be below --to"));
}

Result<int> cut(const CutOptions& options, const OutputRule& rule) {
  if (auto r = rule.check(options.target.path); !r) return r.error();
  // Told before the recording is opened, where that can be known.
  const bool is_relative = (options.from && options.from->relative) || (options.to && options.to->relative);
  const bool comparable = !options.from || !options.to || options.from->relative == options.to->relative;
  const auto unshifted = window_of(options, 0);
  if (comparable && !unshifted) return unshifted.error();
  const auto source = open_events(options.file, options.read);
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, options.file);
  if (!sensor) return sensor.error();
  const Region region = options.region.value_or(Region{0, 0, sensor->width, sensor->height});
  if (region.width > sensor->width - region.x || region.height > sensor->height - region.y) {
    return illegal(text("the region of ", region.width, "x", region.height, " at ", region.x, ",", region.y,
                        " is not within the sensor of ", size_text(*sensor)));
  }

  const EventRange range = options.events.value_or(EventRange{});
  // Without an event there is nothing that a time could be relative to.
  TimeWindow window = is_relative ? TimeWindow{0, 0} : *unshifted;
  uint64_t index = 0;  // of the next event
  Choose choose;
  choose.begin = [&](const Event& first) -> Result<void> {
    const auto shifted = window_of(options, first.t);
    if (!shifted) return shifted.error();
    window = *shifted;
    return {};
  };
  choose.trigger = [&](const Trigger& trigger) {
    return index >= range.begin && index < range.end && window.contains(trigger.t);
  };
  choose.event = [&](Event& e) {
    const uint64_t i = index++;
    const int32_t x = e.x - region.x;
    const int32_t y = e.y - region.y;
    if (i < range.begin || i >= range.end || !window.contains(e.t)) return false;
    if (x < 0 || x >= region.width || y < 0 || y >= region.height) return false;
    e.x = static_cast<uint16_t>(x);
    e.y = static_cast<uint16_t>(y);
    return true;
  };
  const auto copied = copy_recording({**source, options.file, options.read}, choose,
                                     {region.width, region.height}, options.target, rule);
  if (!copied) return copied.error();
  remarks(options.target) << text("cut ", copied->events, " events out of ", copied->events + copied->left,
                                  " from ", (*source)->format(), " to ", copied->format,
                                  options.target.check ? ", checked" : "", "\n", beside_events(*copied),
                                  copied->losses, "events ", copied->digest, "\n");
  return 0;
}

}  // namespace

void add_cut(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("cut", "A part of a recording, by time, number of events or region");
  auto options = std::make_shared<CutOptions>();
  add_input_option(*app, "file", options->file, "Recording; - is standard input")->required();
  add_copy_target(*app, options->target);
  add_parsed_option(
      *app, "--from", options->from, parse_time_point,
      "Earliest time of events and triggers: us, or with a unit (1.5s, 20ms); with a + in front, "
      "after the first event (+1.5s)");
  add_parsed_option(*app, "--to", options->to, parse_time_point, "First time too late, in the same ways");
  add_parsed_option(
      *app, "--events", options->events, parse_event_range,
      "A:B: the events number A to B-1 of those inside the sensor, counted from 0, and the triggers "
      "before each of them");
  add_parsed_option(*app, "--roi", options->region, parse_region,
                    "X,Y,WIDTH,HEIGHT: a region of the sensor, which becomes the sensor of the output");
  add_settings(*app, read_settings(options->read));
  app->callback([&command, app, options] {
    command.run = [app, options] { return cut(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
