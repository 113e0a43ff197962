#include "tools/reprocess/manifest.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "tools/command_line.h"

namespace scarf::tools::reprocess {
namespace {

using Json = nlohmann::json;

constexpr size_t kMaxLine = 65'536;  // characters: what is longer is no list
constexpr std::string_view kAs = "as";

Error in_line(const std::string& what) {
  return {ErrorCode::illegal_parameter, what};
}

Result<Listed> text_entry(const std::string& line) {
  Listed entry;
  size_t begin = 0;
  for (bool first = true; begin <= line.size(); first = false) {
    const size_t end = std::min(line.find('\t', begin), line.size());
    const std::string field = line.substr(begin, end - begin);
    begin = end + 1;
    if (first) {
      entry.path = field;
      continue;
    }
    if (field.empty()) continue;  // several tabs, for people
    const size_t equals = field.find('=');
    if (equals == field.npos || equals == 0)
      return in_line(text("'", field, "' is not of the form NAME=VALUE"));
    const std::string name = field.substr(0, equals);
    entry.settings[name].push_back(field.substr(equals + 1));
  }
  return entry;
}

std::optional<std::string> word_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  return std::nullopt;
}

Result<Listed> json_entry(const std::string& line) {
  const Json object = Json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!object.is_object()) return in_line("this is no JSON object");
  Listed entry;
  for (const auto& [name, value] : object.items()) {
    std::vector<std::string> words;
    for (const Json& one : value.is_array() ? value : Json::array({value})) {
      const auto word = word_of(one);
      if (!word) return in_line(text(name, " is neither text, a number, true or false, nor a list"));
      words.push_back(*word);
    }
    if (name == "path") {
      if (words.size() != 1) return in_line("path is not one path");
      entry.path = words.front();
    } else {
      entry.settings[name] = std::move(words);
    }
  }
  return entry;
}

Result<Listed> entry_of(const std::string& line, bool json) {
  auto entry = json ? json_entry(line) : text_entry(line);
  if (!entry) return entry;
  if (entry->path.empty()) return in_line("the path is missing");
  if (const auto as = entry->settings.extract(std::string(kAs))) {
    if (as.mapped().size() != 1) return in_line("as is not one path");
    entry->as = as.mapped().front();
    if (is_blank(entry->as)) return in_line("as is empty; give it a path, or leave it out");
  }
  return entry;
}

}  // namespace

Result<std::vector<Listed>> read_manifest(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{ErrorCode::io, text("cannot open the list ", path)};
  std::vector<Listed> entries;
  std::string line;
  std::optional<bool> json;
  for (size_t number = 1; std::getline(file, line); ++number) {
    if (line.size() > kMaxLine || line.find('\0') != line.npos) {
      return Error{ErrorCode::illegal_parameter,
                   text(path,
                        " is neither a folder nor a list of recordings; `scarf render` takes a single "
                        "recording")};
    }
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    if (!json) json = line.starts_with('{');
    auto entry = entry_of(line, *json);
    if (!entry) {
      return Error{ErrorCode::illegal_parameter, text(path, " line ", number, ": ", entry.error().message)};
    }
    entry->line = number;
    entries.push_back(*std::move(entry));
  }
  if (file.bad()) return Error{ErrorCode::io, text("cannot read the list ", path)};
  return entries;
}

}  // namespace scarf::tools::reprocess
