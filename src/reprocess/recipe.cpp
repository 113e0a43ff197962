#include "reprocess/recipe.h"

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

namespace scarf::reprocess {
namespace {

constexpr std::string_view kRules = "input";
constexpr std::string_view kMatch = "match";
constexpr size_t kMaxRecipe = size_t{16} << 20;  // bytes

// Blanks of other scripts are looked for by toml++ 3.3 wherever blanks may be, and what it does at some
// characters that are none (U+FEFE, but U+00E9 too) is not defined. All are above those if each byte becomes
// a character of plane 15.
std::string veiled(std::string_view utf8) {
  std::string ascii_and_plane_15;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      ascii_and_plane_15 += c;
    } else {
      ascii_and_plane_15 +=
          {'\xF3', '\xB0', static_cast<char>(0x80 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3F))};
    }
  }
  return ascii_and_plane_15;
}

std::string unveiled(std::string_view veiled) {
  std::string utf8;
  for (size_t at = 0; at < veiled.size();) {
    const std::string_view rest = veiled.substr(at);
    if (rest.size() > 3 && (rest.starts_with("\xF3\xB0\x82") || rest.starts_with("\xF3\xB0\x83"))) {
      utf8 += static_cast<char>((rest[2] & 3) << 6 | (rest[3] & 0x3F));
      at += 4;
    } else {
      utf8 += rest.front();
      ++at;
    }
  }
  return utf8;
}

// Well-formed, as Unicode's table 3-7 has it.
bool is_utf8(std::string_view text) {
  const auto byte = [&](size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0; };
  for (size_t at = 0; at < text.size();) {
    const int first = byte(at);
    const size_t more = first < 0x80   ? 0
                        : first < 0xC2 ? 4
                        : first < 0xE0 ? 1
                        : first < 0xF0 ? 2
                        : first < 0xF5 ? 3
                                       : 4;
    if (more == 4) return false;
    const int least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    const int most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
    if (more > 0 && (byte(at + 1) < least || byte(at + 1) > most)) return false;
    for (size_t i = 2; i <= more; ++i) {
      if (byte(at + i) >> 6 != 2) return false;
    }
    at += 1 + more;
  }
  return true;
}

Error at_line(const std::string& path, const toml::source_region& source, const std::string& what) {
  return {ErrorCode::illegal_parameter, text(path, " line ", source.begin.line, ": ", unveiled(what))};
}

// A value as the word that an option takes.
std::optional<std::string> word_of(const toml::node& node) {
  if (const auto value = node.value_exact<std::string>()) return unveiled(*value);
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
Result<SettingWords> words_in(const std::string& path, const toml::table& table, std::string_view besides) {
  SettingWords settings;
  for (const auto& [key, node] : table) {
    const std::string name = unveiled(key.str());
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
  auto settings = words_in(path, *table, kMatch);
  if (!settings) return settings.error();
  return Recipe::Rule{unveiled(*match), *std::move(settings)};
}

// Whether the settings can be read, by themselves or on top of others.
Result<void> check(const std::string& path, const toml::source_region& source, const SettingWords& settings) {
  const auto options = parse_settings(settings);
  return options ? Result<void>() : at_line(path, source, options.error().message);
}

}  // namespace

SettingWords Recipe::for_recording(const std::string& relative) const {
  SettingWords all = settings;
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
  std::string_view body = content;
  if (body.starts_with("\xEF\xBB\xBF")) body.remove_prefix(3);  // a byte order mark
  if (!is_utf8(body)) return Error{ErrorCode::illegal_parameter, text(path, ": it is not text in UTF-8")};
  const toml::parse_result parsed = toml::parse(veiled(body));
  if (!parsed) return at_line(path, parsed.error().source(), std::string(parsed.error().description()));
  const toml::table& table = parsed.table();

  Recipe recipe = default_recipe();
  const auto settings = words_in(path, table, kRules);
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
    SettingWords together = recipe.settings;
    lay_over(together, rule->settings);
    if (auto r = check(path, node.source(), together); !r) return r.error();
    recipe.rules.push_back(*std::move(rule));
  }
  return recipe;
}

}  // namespace scarf::reprocess
