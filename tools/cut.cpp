// scarf cut: a part of a recording, by time, by number of events, by region of the sensor.
#include <iostream>
#include <limits>
#include <optional>

#include "core/text.h"
#include "io/sensor_size.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/parse.h"
#include "tools/read_options.h"
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

struct CutOptions {
  std::string file;
  ReadOptions read;
  CopyTarget target;
  int64_t from = std::numeric_limits<int64_t>::min();
  int64_t to = std::numeric_limits<int64_t>::max();
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

Result<int> cut(const CutOptions& options, const OutputRule& rule) {
  if (auto r = rule.check(options.target.path); !r) return r.error();
  if (options.from >= options.to) {
    return illegal(
        text("no time is from ", options.from, " to ", options.to, " us; --from must be below --to"));
  }
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
  uint64_t index = 0;
  const auto choose = [&](Event& e) {
    const uint64_t i = index++;
    const int32_t x = e.x - region.x;
    const int32_t y = e.y - region.y;
    if (i < range.begin || i >= range.end || e.t < options.from || e.t >= options.to) return false;
    if (x < 0 || x >= region.width || y < 0 || y >= region.height) return false;
    e.x = static_cast<uint16_t>(x);
    e.y = static_cast<uint16_t>(y);
    return true;
  };
  const auto copied = copy_recording(**source, choose, {region.width, region.height}, options.target, rule);
  if (!copied) return copied.error();
  remarks(options.target) << text("cut ", copied->events, " events out of ", copied->events + copied->left,
                                  " from ", (*source)->format(), " to ", copied->format,
                                  options.target.check ? ", checked" : "", "\n", losses(**source), "events ",
                                  copied->digest, "\n");
  return 0;
}

}  // namespace

void add_cut(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("cut", "A part of a recording, by time, number of events or region");
  auto options = std::make_shared<CutOptions>();
  add_input_option(*app, "file", options->file, "Recording; - is standard input")->required();
  add_copy_target(*app, options->target);
  add_parsed_option(*app, "--from", options->from, parse_whole<int64_t>, "Earliest time of an event, us");
  add_parsed_option(*app, "--to", options->to, parse_whole<int64_t>, "First time too late, us");
  add_parsed_option(*app, "--events", options->events, parse_event_range,
                    "A:B: the events number A to B-1 of those inside the sensor, counted from 0");
  add_parsed_option(*app, "--roi", options->region, parse_region,
                    "X,Y,WIDTH,HEIGHT: a region of the sensor, which becomes the sensor of the output");
  add_read_options(*app, options->read);
  app->callback([&command, app, options] {
    command.run = [app, options] { return cut(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
