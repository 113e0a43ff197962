// scarf info: what is in recordings.
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/text.h"
#include "scarf/digest/digest.h"
#include "session/play.h"
#include "session/progress.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/options.h"
#ifdef SCARF_PICTURES
#include "reprocess/job_list.h"
#endif

namespace scarf::tools {
namespace {

constexpr int kSchema = 1;  // docs/JSON.md

struct InfoOptions {
  std::vector<std::string> files;
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
    if (fact.key == "digest") {  // as scarf digest prints it
      std::cout << "events " << fact.value.get<std::string>() << "\n";
      continue;
    }
    std::string value = fact.value.is_null()     ? "unknown"
                        : fact.value.is_string() ? fact.value.get<std::string>()
                                                 : fact.value.dump();
    // One line, whatever a hostile file or name had in it.
    std::replace_if(
        value.begin(), value.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
    std::cout << std::left << std::setw(19) << fact.name + ":" << value
              << (fact.value.is_null() ? "" : fact.unit) << "\n";
  }
}

nlohmann::ordered_json json_of(const std::vector<Fact>& facts) {
  nlohmann::ordered_json all;
  for (const Fact& fact : facts) all[fact.key] = fact.value;
  return all;
}

void print_json(const nlohmann::ordered_json& json) {
  // Names of files and packets may hold any bytes.
  std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

// Events per second, rounded; null if no time passes between the first and the last event.
nlohmann::ordered_json mean_rate(uint64_t events, int64_t duration) {
  if (duration <= 0) return nullptr;
  return static_cast<uint64_t>(static_cast<double>(events) * 1e6 / static_cast<double>(duration) + 0.5);
}

Result<std::vector<Fact>> facts_of(const std::string& file, const InfoOptions& options) {
  const auto source = open_events(file, options.read);
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
      {"jumps", "jumps", report.jumps},
      {"largest jump", "largest_jump_us", report.largest_jump, " us"},
      {"dropped", "dropped", report.dropped},
      {"gaps", "gaps", report.gaps},
      {"unknown words", "unknown_words", report.unknown_words},
      {"skipped records", "skipped", report.skipped},
      {"odd polarities", "undefined_polarities", report.undefined_polarities},
      {"truncated bytes", "truncated_bytes", report.truncated_bytes},
      {"damaged places", "damages", report.damages},
  };
  if (report.jumps > 0) {
    facts.push_back({"jump from", "largest_jump_from_us", report.largest_jump_from, " us"});
  }
  if (report.damage) {
    facts.push_back(
        {"first damage", "first_damage", text("byte ", report.damage->byte, ": ", report.damage->what)});
  }
  if (options.digest) facts.push_back({"events digest", "digest", digest.hex()});
  return facts;
}

// One recording: nothing else is printed.
Result<int> tell_one(const std::string& file, const InfoOptions& options) {
  const auto facts = facts_of(file, options);
  if (!facts) return facts.error();
  if (options.json) {
    nlohmann::ordered_json all = {{"schema", kSchema}};
    all.update(json_of(*facts));
    print_json(all);
  } else {
    print_table(*facts);
  }
  return 0;
}

// Something of the command line, or of a folder there.
struct Candidate {
  std::string path;
  bool named = false;        // on the command line: it must be a recording
  std::string failure = {};  // why it cannot be looked at
};

struct Candidates {
  std::vector<Candidate> files;
  std::vector<std::string> skipped;  // what is neither a file nor a folder of recordings
};

bool is_folder_of_recordings(const std::string& path, const InfoOptions& options) {
  std::error_code ignored;
  if (path == "-" || !std::filesystem::is_directory(path, ignored)) return false;
  ReadOptions read = options.read;
  read.format.clear();  // says nothing of a folder
  const auto source = open_events(path, read);
  return !source && source.error().code == ErrorCode::unrecognised;
}

#ifdef SCARF_PICTURES
// As scarf reprocess finds them.
Result<void> list_folder(const std::string& folder, Candidates& candidates) {
  reprocess::Recipe recipe = reprocess::default_recipe();
  recipe.settings["output"] = {};
  auto list = reprocess::list_jobs(folder, recipe, "");
  if (!list) return list.error();
  for (const reprocess::Job& job : list->jobs) candidates.files.push_back({job.path});
  for (const reprocess::Outcome& o : list->settled) {
    const std::string path = (std::filesystem::path(folder) / o.relative).string();
    if (o.status == reprocess::Status::failed) {
      candidates.files.push_back({path, false, in_options(o.message)});
    } else {
      candidates.skipped.push_back(path);
    }
  }
  return {};
}
#else
Result<void> list_folder(const std::string& folder, Candidates&) {
  return Error{
      ErrorCode::illegal_parameter,
      text(folder, " is a folder, which this build of scarf does not go through; name the files in it")};
}
#endif

Result<Candidates> candidates_of(const InfoOptions& options) {
  Candidates candidates;
  for (const std::string& path : options.files) {
    if (!is_folder_of_recordings(path, options)) {
      candidates.files.push_back({path, true});
    } else if (const auto r = list_folder(path, candidates); !r) {
      candidates.files.push_back({path, true, in_options(r.error().message)});
    }
  }
  return candidates;
}

// Several recordings: a broken one does not keep the others from being told of.
Result<int> tell_all(const InfoOptions& options) {
  if (std::count(options.files.begin(), options.files.end(), "-") > 1) {
    return Error{ErrorCode::illegal_parameter, "standard input can be read once only; give one -"};
  }
  auto candidates = candidates_of(options);
  if (!candidates) return candidates.error();
  nlohmann::ordered_json recordings = nlohmann::ordered_json::array();
  size_t told = 0;
  size_t failed = 0;
  std::string first_failure;
  for (const Candidate& c : candidates->files) {
    const auto facts = c.failure.empty() ? facts_of(c.path, options)
                                         : Result<std::vector<Fact>>(Error{ErrorCode::io, c.failure});
    if (!facts && !c.named && facts.error().code == ErrorCode::unrecognised) {
      candidates->skipped.push_back(c.path);
      continue;
    }
    if (!facts && failed++ == 0) first_failure = in_options(facts.error().message);
    std::vector<Fact> all = {{"file", "file", c.path}};
    if (facts) {
      all.insert(all.end(), facts->begin(), facts->end());
    } else {
      all.push_back({"error", "error", in_options(facts.error().message)});
    }
    if (options.json) {
      recordings.push_back(json_of(all));
    } else {
      if (told > 0) std::cout << "\n";
      print_table(all);
      std::cout.flush();
    }
    ++told;
  }
  std::sort(candidates->skipped.begin(), candidates->skipped.end());
  if (options.json) {
    print_json({{"schema", kSchema}, {"recordings", recordings}, {"skipped", candidates->skipped}});
  } else if (!candidates->skipped.empty()) {
    std::cout << (told > 0 ? "\n" : "") << "skipped, as no recordings:\n";
    for (const std::string& path : candidates->skipped) std::cout << "  " << path << "\n";
  }
  if (told == 0) return Error{ErrorCode::bad_input, "there are no recordings here"};
  if (failed == 0) return 0;
  return Error{ErrorCode::bad_input,
               text(failed, " of ", told, " recordings cannot be read; the first: ", first_failure)};
}

Result<int> info(const InfoOptions& options) {
  const bool one = options.files.size() == 1 && !is_folder_of_recordings(options.files.front(), options);
  return one ? tell_one(options.files.front(), options) : tell_all(options);
}

}  // namespace

void add_info(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand("info", "Format, sensor, events and oddities of recordings");
  auto options = std::make_shared<InfoOptions>();
  add_input_option(
      *app, "files", options->files,
      "Recordings, - for standard input, and folders of recordings; of those in folders, what is no "
      "recording is left out")
      ->required();
  add_settings(*app, read_settings(options->read));
  app->add_flag("--digest", options->digest, "Also the SHA-256 of the decoded events");
  app->add_flag("--json", options->json, "As JSON: an object, and of several recordings one with a list");
  app->callback([&command, options] { command.run = [options] { return info(*options); }; });
}

}  // namespace scarf::tools
