#include "reprocess/record.h"

#include <nlohmann/json.hpp>

#include "core/regular_file.h"
#include "core/text.h"
#include "reprocess/made_by.h"

namespace scarf::reprocess {
namespace {

using Json = nlohmann::json;

constexpr int kSchema = 1;                       // docs/JSON.md
constexpr size_t kMaxRecord = size_t{16} << 20;  // bytes

// One value as itself, several as a list.
Json json_of(const SettingWords& settings) {
  Json json = Json::object();
  for (const auto& [name, words] : settings) {
    json[name] = words.size() == 1 ? Json(words.front()) : Json(words);
  }
  return json;
}

SettingWords settings_of(const Json& json) {
  SettingWords settings;
  for (const auto& [name, value] : json.items()) {
    settings[name] = value.is_array() ? value.get<std::vector<std::string>>()
                                      : std::vector<std::string>{value.get<std::string>()};
  }
  return settings;
}

Json json_of(const ReadReport& r) {
  Json json = {{"events", r.events},
               {"outside", r.outside},
               {"back_steps", r.back_steps},
               {"largest_back_step_us", r.largest_back_step},
               {"jumps", r.jumps},
               {"largest_jump_us", r.largest_jump},
               {"largest_jump_from_us", r.largest_jump_from},
               {"dropped", r.dropped},
               {"gaps", r.gaps},
               {"unknown_words", r.unknown_words},
               {"skipped", r.skipped},
               {"undefined_polarities", r.undefined_polarities},
               {"truncated_bytes", r.truncated_bytes},
               {"damages", r.damages}};
  if (r.damage) json["damage"] = {{"byte", r.damage->byte}, {"what", r.damage->what}};
  return json;
}

Json json_of(const std::optional<FileState>& state) {
  if (!state) return nullptr;
  return {{"inode", state->inode}, {"modified_ns", state->modified_ns}, {"changed_ns", state->changed_ns}};
}

// What was noted of an input of so many bytes; records of before schema 1 note nothing.
std::optional<FileState> state_of(const Json& record, uint64_t bytes) {
  const auto found = record.find("input_state");
  if (found == record.end() || found->is_null()) return std::nullopt;
  FileState state;
  state.inode = found->at("inode");
  state.bytes = bytes;
  state.modified_ns = found->at("modified_ns");
  state.changed_ns = found->at("changed_ns");
  return state;
}

}  // namespace

std::string record_text(const Record& record, const Job& job, const Computed& computed,
                        const std::string& device, const Timings& timings) {
  Json counts = json_of(computed.report);
  counts["frames"] = computed.frames;
  counts["filters"] = Json::array();
  for (const FilterReport& f : computed.filters) {
    counts["filters"].push_back({{"passed", f.passed}, {"rejected", f.rejected}});
  }
  const Json json = {
      {"schema", kSchema},
      {"input", job.relative},
      {"input_sha256", record.input.sha256},
      {"input_bytes", record.input.bytes},
      {"input_state", json_of(record.input.state)},
      {"times_sha256", record.times_sha256.empty() ? Json() : Json(record.times_sha256)},
      {"format", computed.format},
      {"sensor", text(computed.sensor.width, "x", computed.sensor.height)},
      {"recipe", json_of(record.settings)},
      {"version", made_by()},
      {"device", device},
      {"counts", counts},
      {"state", record.digests.state},
      {"image", record.digests.image},
      {"events", record.digests.events},
      {"outputs", record.outputs},
      {"timings", {{"started", timings.started}, {"seconds", timings.seconds}}},
  };
  // Names of files need not be UTF-8; JSON must be.
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

Result<Record> read_record(const std::string& path) {
  const auto content = read_whole(path, kMaxRecord);
  if (!content) {
    return Error{ErrorCode::io, text("cannot read the record ", path, ": ", content.error().message)};
  }
  try {
    const Json json = Json::parse(*content);
    Record record;
    record.input.sha256 = json.at("input_sha256");
    record.input.bytes = json.at("input_bytes");
    record.input.state = state_of(json, record.input.bytes);
    if (const auto times = json.find("times_sha256"); times != json.end() && !times->is_null()) {
      record.times_sha256 = *times;
    }
    record.settings = settings_of(json.at("recipe"));
    record.digests = {json.at("state"), json.at("image"), json.at("events")};
    record.outputs = json.at("outputs").get<std::vector<std::string>>();
    record.events = json.at("counts").at("events");
    record.frames = json.at("counts").at("frames");
    return record;
  } catch (const Json::exception&) {
    return Error{ErrorCode::bad_input, text(path, " is no record of reprocessing; remove it")};
  }
}

}  // namespace scarf::reprocess
