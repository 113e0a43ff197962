#include "reprocess/manifest.h"

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/parse.h"
#include "core/text.h"
#include "io/base/line_reader.h"

namespace scarf::reprocess {
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
  if (entry->path == "-") {
    return in_line(
        "- is standard input, which holds no file that could be read twice; name a file or folder");
  }
  if (const auto as = entry->settings.extract(std::string(kAs))) {
    if (as.mapped().size() != 1) return in_line("as is not one path");
    entry->as = as.mapped().front();
    if (is_blank(entry->as)) return in_line("as is empty; give it a path, or leave it out");
  }
  return entry;
}

}  // namespace

Result<std::vector<Listed>> read_manifest(const std::string& path) {
  const auto no_list = [&] {
    return Error{ErrorCode::illegal_parameter,
                 text(path,
                      " is neither a folder nor a list of recordings; render a single "
                      "recording instead")};
  };
  auto lines = LineReader::open(path, kMaxLine);
  if (!lines) return Error{ErrorCode::io, text("cannot read the list ", path, ": ", lines.error().message)};
  std::vector<Listed> entries;
  std::optional<bool> json;
  for (;;) {
    const auto line = lines->next();
    if (!line && line.error().code == ErrorCode::bad_input) return no_list();
    if (!line) return Error{ErrorCode::io, text("cannot read the list ", path, ": ", line.error().message)};
    if (!*line) return entries;
    if ((*line)->find('\0') != std::string_view::npos) return no_list();
    if ((*line)->empty() || (*line)->starts_with('#')) continue;
    if (!json) json = (*line)->starts_with('{');
    auto entry = entry_of(std::string(**line), *json);
    if (!entry) {
      return Error{ErrorCode::illegal_parameter,
                   text(path, " line ", lines->number(), ": ", entry.error().message)};
    }
    entry->line = lines->number();
    entries.push_back(*std::move(entry));
  }
}

}  // namespace scarf::reprocess
