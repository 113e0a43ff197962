// scarf info: what is in a recording.
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/text.h"
#include "scarf/digest.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/play.h"
#include "tools/progress.h"
#include "tools/read_options.h"

namespace scarf::tools {
namespace {

struct InfoOptions {
  std::string file;
  ReadOptions read;
  bool digest = false;
  bool json = false;
};

// What is told of a recording: a name for people, one for programs, a value.
struct Fact {
  std::string name;
  std::string key;
  nlohmann::ordered_json value;  // null: not known
  std::string unit = {};
};

void print_table(const std::vector<Fact>& facts) {
  for (const Fact& fact : facts) {
    const std::string value = fact.value.is_null()     ? "unknown"
                              : fact.value.is_string() ? fact.value.get<std::string>()
                                                       : fact.value.dump();
    std::cout << std::left << std::setw(19) << fact.name + ":" << value
              << (fact.value.is_null() ? "" : fact.unit) << "\n";
  }
}

void print_json(const std::vector<Fact>& facts) {
  nlohmann::ordered_json all;
  for (const Fact& fact : facts) all[fact.key] = fact.value;
  // Names of files and packets may hold any bytes.
  std::cout << all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

// Events per second, rounded; null if no time passes between the first and the last event.
nlohmann::ordered_json mean_rate(uint64_t events, int64_t duration) {
  if (duration <= 0) return nullptr;
  return static_cast<uint64_t>(static_cast<double>(events) * 1e6 / static_cast<double>(duration) + 0.5);
}

Result<int> info(const InfoOptions& options) {
  const auto source = open_events(options.file, options.read);
  if (!source) return source.error();

  uint64_t on = 0;
  std::optional<int64_t> first;
  int64_t last = 0;
  EventDigest digest;
  {
    Progress progress(**source);
    const auto take = [&](std::span<const Event> events) -> Result<void> {
      if (!first) first = events.front().t;
      last = events.back().t;
      for (const Event& e : events) {
        on += e.p;
        if (options.digest) digest.add(e);
      }
      progress.add(events.size());
      return {};
    };
    const auto played = play(**source, {}, {.events = take});
    if (!played) return played.error();
  }

  const ReadReport& report = (*source)->report();
  const auto sensor = (*source)->sensor();
  // Unsigned, because hostile times may lie further apart than a signed number reaches.
  const auto duration =
      static_cast<int64_t>(static_cast<uint64_t>(last) - static_cast<uint64_t>(first.value_or(last)));
  using Json = nlohmann::ordered_json;
  std::vector<Fact> facts = {
      {"format", "format", std::string((*source)->format())},
      {"sensor", "sensor", sensor ? Json(text(sensor->width, "x", sensor->height)) : Json()},
      {"events", "events", report.events},
      {"on", "on", on},
      {"off", "off", report.events - on},
      {"first", "first_us", first ? Json(*first) : Json(), " us"},
      {"last", "last_us", first ? Json(last) : Json(), " us"},
      {"duration", "duration_us", duration, " us"},
      {"mean rate", "events_per_second", mean_rate(report.events, duration), " ev/s"},
      {"outside", "outside", report.outside},
      {"back-steps", "back_steps", report.back_steps},
      {"largest back-step", "largest_back_step_us", report.largest_back_step, " us"},
      {"dropped", "dropped", report.dropped},
      {"gaps", "gaps", report.gaps},
      {"unknown words", "unknown_words", report.unknown_words},
      {"truncated bytes", "truncated_bytes", report.truncated_bytes},
      {"damaged places", "damages", report.damages},
  };
  if (report.damage) {
    facts.push_back(
        {"first damage", "first_damage", text("byte ", report.damage->byte, ": ", report.damage->what)});
  }
  if (options.json && options.digest) facts.push_back({"events digest", "digest", digest.hex()});
  options.json ? print_json(facts) : print_table(facts);
  if (options.digest && !options.json) std::cout << "events " << digest.hex() << "\n";
  return 0;
}

}  // namespace

void add_info(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("info", "Format, sensor, events and oddities of a recording");
  auto options = std::make_shared<InfoOptions>();
  add_input_option(*app, "file", options->file, "Recording; - is standard input")->required();
  add_read_options(*app, options->read);
  app->add_flag("--digest", options->digest, "Also the SHA-256 of the decoded events");
  app->add_flag("--json", options->json, "As JSON");
  app->callback([&command, options] { command.run = [options] { return info(*options); }; });
}

}  // namespace scarf::tools
