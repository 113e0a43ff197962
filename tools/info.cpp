// scarf info: what is in a recording.
#include <iomanip>
#include <iostream>
#include <optional>

#include "core/text.h"
#include "scarf/digest.h"
#include "tools/commands.h"
#include "tools/play.h"
#include "tools/progress.h"
#include "tools/read_options.h"

namespace scarf::tools {
namespace {

struct InfoOptions {
  std::string file;
  ReadOptions read;
  bool digest = false;
};

void line(const std::string& name, const std::string& value) {
  std::cout << std::left << std::setw(19) << name + ":" << value << "\n";
}

// Events per second, rounded; "unknown" if no time passes between the first and the last event.
std::string mean_rate(uint64_t events, int64_t duration) {
  if (duration <= 0) return "unknown";
  return text(static_cast<uint64_t>(static_cast<double>(events) * 1e6 / static_cast<double>(duration) + 0.5),
              " ev/s");
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
  line("format", std::string((*source)->format()));
  line("sensor", sensor ? text(sensor->width, "x", sensor->height) : "unknown");
  line("events", text(report.events));
  line("on", text(on));
  line("off", text(report.events - on));
  line("first", first ? text(*first, " us") : "none");
  line("last", first ? text(last, " us") : "none");
  // Unsigned, because hostile times may lie further apart than a signed number reaches.
  const auto duration =
      static_cast<int64_t>(static_cast<uint64_t>(last) - static_cast<uint64_t>(first.value_or(last)));
  line("duration", text(duration, " us"));
  line("mean rate", mean_rate(report.events, duration));
  line("outside", text(report.outside));
  line("back-steps", text(report.back_steps));
  line("largest back-step", text(report.largest_back_step, " us"));
  line("dropped", text(report.dropped));
  line("gaps", text(report.gaps));
  line("unknown words", text(report.unknown_words));
  line("truncated bytes", text(report.truncated_bytes));
  line("damaged places", text(report.damages));
  if (report.damage) line("first damage", text("byte ", report.damage->byte, ": ", report.damage->what));
  if (options.digest) std::cout << "events " << digest.hex() << "\n";
  return 0;
}

}  // namespace

void add_info(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("info", "Format, sensor, events and oddities of a recording");
  auto options = std::make_shared<InfoOptions>();
  app->add_option("file", options->file, "Recording; - is standard input")->required();
  add_read_options(*app, options->read);
  app->add_flag("--digest", options->digest, "Also the SHA-256 of the decoded events");
  app->callback([&command, options] { command.run = [options] { return info(*options); }; });
}

}  // namespace scarf::tools
