#include "reprocess/summary.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "reprocess/made_by.h"

namespace scarf::reprocess {
namespace {

using Json = nlohmann::json;

constexpr int kSchema = 1;  // docs/JSON.md

constexpr std::array kColumns = {Status::done, Status::kept, Status::failed, Status::skipped, Status::left};

std::vector<Outcome> sorted(std::vector<Outcome> outcomes) {
  std::sort(outcomes.begin(), outcomes.end(),
            [](const Outcome& a, const Outcome& b) { return a.relative < b.relative; });
  return outcomes;
}

// One line of a table, whatever a message has in it.
std::string one_line(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  return message;
}

std::string padded(const std::string& word, size_t width) {
  return std::string(width - std::min(width, word.size()), ' ') + word;
}

std::string check_lines(const Checks& checks) {
  size_t identical = 0;
  std::string lines;
  for (const Outcome& o : sorted(checks.outcomes)) {
    if (o.status == Status::identical) {
      ++identical;
      continue;
    }
    lines += one_line(text("check ", name_of(o.status), ": ", o.relative, ": ", o.message)) + "\n";
  }
  return text(lines, "checked on the CPU reference: ", checks.outcomes.size(), " recordings (share ",
              checks.share, ", seed ", checks.seed, "), ", identical, " identical\n");
}

Json json_of(const std::vector<Outcome>& outcomes) {
  Json list = Json::array();
  for (const Outcome& o : sorted(outcomes)) {
    Json one = {{"input", o.relative}, {"outcome", name_of(o.status)}};
    if (!o.message.empty()) one["message"] = o.message;
    if (o.status == Status::done || o.status == Status::kept) {
      one["events"] = o.events;
      one["frames"] = o.frames;
    }
    list.push_back(one);
  }
  return list;
}

}  // namespace

size_t Summary::count(Status status) const {
  return static_cast<size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return o.status == status; }));
}

bool Summary::good() const {
  const bool checked = !checks || std::all_of(checks->outcomes.begin(), checks->outcomes.end(),
                                              [](const Outcome& o) { return o.status == Status::identical; });
  return checked && count(Status::failed) == 0 && count(Status::left) == 0;
}

std::string summary_table(const Summary& s) {
  std::string heads = "files";
  std::string numbers = padded(text(s.outcomes.size()), heads.size());
  for (const Status status : kColumns) {
    const std::string head = text("  ", name_of(status));
    heads += head;
    numbers += padded(text(s.count(status)), head.size());
  }
  std::string lines = text(heads, "\n", numbers, "\n");
  for (const Status status : {Status::failed, Status::skipped}) {
    for (const Outcome& o : sorted(s.outcomes)) {
      if (o.status != status) continue;
      lines += one_line(text(name_of(status), ": ", o.relative, ": ", o.message)) + "\n";
    }
  }
  uint64_t events = 0;
  uint64_t frames = 0;
  for (const Outcome& o : s.outcomes) {
    if (o.status != Status::done) continue;
    events += o.events;
    frames += o.frames;
  }
  if (s.checks) lines += check_lines(*s.checks);
  lines += text(events, " events, ", frames, " frames in ", s.seconds, " s on ", s.device, ", ", s.jobs,
                s.jobs == 1 ? " recording" : " recordings", " at a time");
  if (s.processes > 1) lines += text(" in each of ", s.processes, " processes");
  if (s.shard.count > 1) lines += text(", shard ", s.shard.index, "/", s.shard.count, " by ", s.shard.origin);
  return lines + "\n";
}

std::string summary_json(const Summary& s) {
  Json totals = {{"files", s.outcomes.size()}};
  for (const Status status : kColumns) totals[name_of(status)] = s.count(status);
  Json timings = Json::object();
  for (const Outcome& o : s.outcomes) {
    if (o.status == Status::done) timings[o.relative] = o.seconds;
  }
  Json json = {{"schema", kSchema},
               {"input", s.input},
               {"version", made_by()},
               {"device", s.device},
               {"shard", {{"index", s.shard.index}, {"count", s.shard.count}}},
               {"totals", totals},
               {"recordings", json_of(s.outcomes)},
               {"good", s.good()},
               {"timings",
                {{"seconds", s.seconds},
                 {"jobs", s.jobs},
                 {"processes", s.processes},
                 {"seconds_of_recordings", timings}}}};
  if (s.checks) {
    json["checks"] = {
        {"share", s.checks->share}, {"seed", s.checks->seed}, {"recordings", json_of(s.checks->outcomes)}};
  }
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

std::string summary_name(const Shard& shard) {
  if (shard.count == 1) return "summary.json";
  return text("summary.", shard.index, "-of-", shard.count, ".json");
}

}  // namespace scarf::reprocess
