#include "tools/reprocess/recipe.h"

#include <fnmatch.h>

#include <string_view>
#include <utility>

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
// Some of them do not hold for files that are no TOML, and end debug builds.
#define TOML_ASSERT(condition) static_cast<void>(0)
#include <toml++/toml.h>

#include "core/regular_file.h"
#include "core/text.h"

namespace scarf::tools::reprocess {
namespace {

constexpr std::string_view kRules = "input";
constexpr std::string_view kMatch = "match";
constexpr size_t kMaxRecipe = size_t{16} << 20;  // bytes

Error at_line(const std::string& path, const toml::source_region& source, const std::string& what) {
  return {ErrorCode::illegal_parameter, text(path, " line ", source.begin.line, ": ", what)};
}

// A value as the word that an option takes.
std::optional<std::string> word_of(const toml::node& node) {
  if (const auto value = node.value_exact<std::string>()) return *value;
  if (const auto value = node.value_exact<int64_t>()) return text(*value);
  if (const auto value = node.value_exact<double>()) return text(*value);
  if (const auto value = node.value_exact<bool>()) return *value ? "true" : "false";
  return std::nullopt;
}

Result<std::vector<std::string>> words_of(const std::string& path, std::string_view name,
                                          const toml::node& node) {
  std::vector<std::string> words;
  const auto add = [&](const toml::node& one) -> Result<void> {
    const auto word = word_of(one);
    if (!word) {
      return at_line(path, one.source(), text(name, " is neither text, a number, true or false, nor a list"));
    }
    words.push_back(*word);
    return {};
  };
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& one : *list) {
      if (auto r = add(one); !r) return r.error();
    }
    return words;
  }
  if (auto r = add(node); !r) return r.error();
  return words;
}

// Names are checked here, so that the error can tell the line; values need all that the settings end up with.
Result<Settings> settings_of(const std::string& path, const toml::table& table, std::string_view besides) {
  Settings settings;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (name == besides) continue;
    auto words = words_of(path, name, node);
    if (!words) return words.error();
    settings[name] = *std::move(words);
  }
  return settings;
}

Result<Recipe::Rule> rule_of(const std::string& path, const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return at_line(path, node.source(), "input is no table; write [[input]]");
  const auto match = (*table)[kMatch].value<std::string>();
  if (!match || match->empty()) {
    return at_line(path, table->source(), "[[input]] has no match; add one, such as match = \"*.raw\"");
  }
  auto settings = settings_of(path, *table, kMatch);
  if (!settings) return settings.error();
  return Recipe::Rule{*match, *std::move(settings)};
}

// Whether the settings can be read, by themselves or on top of others.
Result<void> check(const std::string& path, const toml::source_region& source, const Settings& settings) {
  const auto options = parse_settings(settings);
  return options ? Result<void>() : at_line(path, source, options.error().message);
}

// The first line with a character that is not ASCII outside strings and comments, where TOML has none.
// toml++ 3.3 looks for blanks among these, and what it does at some of them (U+FEFE) is not defined.
std::optional<size_t> stray_line(std::string_view content) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);  // a byte order mark
  size_t line = 1;
  std::string_view end;  // of the string or comment that is open
  for (size_t at = 0; at < content.size();) {
    const std::string_view rest = content.substr(at);
    const char c = rest.front();
    size_t taken = 1;
    if (!end.empty()) {
      if (c == '\\' && end.front() == '"' && rest.size() > 1 && rest[1] != '\n') {
        taken = 2;
      } else if (rest.starts_with(end) ||
                 (c == '\n' && end.size() == 1)) {  // what may end in no other line is closed
        taken = rest.starts_with(end) ? end.size() : 1;
        end = {};
      }
    } else if (rest.starts_with("\"\"\"") || rest.starts_with("'''")) {
      end = c == '"' ? "\"\"\"" : "'''";
      taken = end.size();
    } else if (c == '"' || c == '\'') {
      end = c == '"' ? "\"" : "'";
    } else if (c == '#') {
      end = "\n";
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      return line;
    }
    line += c == '\n' ? 1 : 0;
    at += taken;
  }
  return std::nullopt;
}

}  // namespace

Settings Recipe::for_recording(const std::string& relative) const {
  Settings all = settings;
  const std::string last = relative.substr(relative.find_last_of('/') + 1);
  for (const Rule& rule : rules) {
    const std::string& subject = rule.match.find('/') == std::string::npos ? last : relative;
    if (fnmatch(rule.match.c_str(), subject.c_str(), 0) == 0) lay_over(all, rule.settings);
  }
  return all;
}

Recipe default_recipe() {
  return {.settings = {{"output", {".png"}}, {"representation", {"scarf"}}}, .rules = {}};
}

Result<Recipe> read_recipe(const std::string& path) {
  const auto content = read_whole(path, kMaxRecipe);
  if (!content) {
    return Error{ErrorCode::io, text("cannot read the recipe ", path, ": ", content.error().message)};
  }
  return parse_recipe(*content, path);
}

Result<Recipe> parse_recipe(const std::string& content, const std::string& path) {
  if (const auto line = stray_line(content)) {
    return Error{ErrorCode::illegal_parameter,
                 text(path, " line ", *line, ": a character that TOML has in strings and comments only")};
  }
  const toml::parse_result parsed = toml::parse(content);
  if (!parsed) return at_line(path, parsed.error().source(), std::string(parsed.error().description()));
  const toml::table& table = parsed.table();

  Recipe recipe = default_recipe();
  const auto settings = settings_of(path, table, kRules);
  if (!settings) return settings.error();
  lay_over(recipe.settings, *settings);
  if (auto r = check(path, table.source(), recipe.settings); !r) return r.error();

  const toml::node* rules = table.get(kRules);
  if (rules == nullptr) return recipe;
  const toml::array* list = rules->as_array();
  if (list == nullptr) return at_line(path, rules->source(), "input is one table; write [[input]]");
  for (const toml::node& node : *list) {
    auto rule = rule_of(path, node);
    if (!rule) return rule.error();
    Settings together = recipe.settings;
    lay_over(together, rule->settings);
    if (auto r = check(path, node.source(), together); !r) return r.error();
    recipe.rules.push_back(*std::move(rule));
  }
  return recipe;
}

}  // namespace scarf::tools::reprocess
