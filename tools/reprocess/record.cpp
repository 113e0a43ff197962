#include "tools/reprocess/record.h"

#include <nlohmann/json.hpp>

#include "core/regular_file.h"
#include "core/text.h"
#include "tools/reprocess/version.h"

namespace scarf::tools::reprocess {
namespace {

using Json = nlohmann::json;

constexpr size_t kMaxRecord = size_t{16} << 20;  // bytes

// One value as itself, several as a list.
Json json_of(const Settings& settings) {
  Json json = Json::object();
  for (const auto& [name, words] : settings) {
    json[name] = words.size() == 1 ? Json(words.front()) : Json(words);
  }
  return json;
}

Settings settings_of(const Json& json) {
  Settings settings;
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
               {"dropped", r.dropped},
               {"gaps", r.gaps},
               {"unknown_words", r.unknown_words},
               {"truncated_bytes", r.truncated_bytes},
               {"damages", r.damages}};
  if (r.damage) json["damage"] = {{"byte", r.damage->byte}, {"what", r.damage->what}};
  return json;
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
      {"input", job.relative},
      {"input_sha256", record.input_sha256},
      {"input_bytes", record.input_bytes},
      {"format", computed.format},
      {"sensor", text(computed.sensor.width, "x", computed.sensor.height)},
      {"recipe", json_of(record.settings)},
      {"version", version()},
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
    record.input_sha256 = json.at("input_sha256");
    record.input_bytes = json.at("input_bytes");
    record.settings = settings_of(json.at("recipe"));
    record.digests = {json.at("state"), json.at("image"), json.at("events")};
    record.outputs = json.at("outputs").get<std::vector<std::string>>();
    record.events = json.at("counts").at("events");
    record.frames = json.at("counts").at("frames");
    return record;
  } catch (const Json::exception&) {
    return Error{ErrorCode::bad_input, text(path, " is no record of scarf reprocess; remove it")};
  }
}

}  // namespace scarf::tools::reprocess
