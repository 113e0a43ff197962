// The settings of a request by name. Whatever lets somebody fill in a request from words (a command line, a
// recipe, a binding) is made from these, so that each is named, explained and checked in one place.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarf/core/result.h"

namespace scarf {

struct Setting {
  enum class Kind {
    word,    ///< a value
    flag,    ///< "true" or "false"
    input,   ///< the name of a file that is read
    output,  ///< the name of a file that is written
  };

  std::string name;    ///< as words call it: "time-policy"
  std::string member;  ///< as messages of the library call it: "ReadOptions::time_policy"
  std::string help;
  std::string group;
  Kind kind = Kind::word;
  bool repeated = false;             ///< may be given several times, and is set once for each
  bool positional = false;           ///< of a command line: needs no name, and must be there
  std::vector<std::string> choices;  ///< the legal words; empty: what `set` takes
  /// Reads a word into the request. Errors: illegal_parameter, without the setting's name.
  std::function<Result<void>(const std::string& word)> set;

  Setting& in(std::string_view name_of_group);
  Setting& one_of(std::vector<std::string> words);
};

/// The settings of one request, and which of them may stand together.
class Settings {
 public:
  /// `owner`: the struct, as messages call it.
  explicit Settings(std::string owner) : owner_(std::move(owner)) {}

  /// The member has the setting's name with _ for -, unless it is given.
  Setting& add(Setting::Kind kind, std::string name, std::string help,
               std::function<Result<void>(const std::string&)> set, std::string member = {});
  /// A word that `parse` reads into `target`.
  template <class T, class Target>
  Setting& add_parsed(std::string name, Target& target, Result<T> (*parse)(const std::string&),
                      std::string help, std::string member = {}) {
    return add(
        Setting::Kind::word, std::move(name), std::move(help),
        [&target, parse](const std::string& word) -> Result<void> {
          auto value = parse(word);
          if (!value) return value.error();
          target = *std::move(value);
          return {};
        },
        std::move(member));
  }
  Setting& add_text(Setting::Kind kind, std::string name, std::string& target, std::string help,
                    std::string member = {});
  Setting& add_flag(std::string name, bool& target, std::string help, std::string member = {});
  /// One of several words, each of which stands for a value.
  template <class T>
  Setting& add_choice(std::string name, T& target, std::vector<std::pair<std::string, T>> values,
                      std::string help, std::string member = {}) {
    std::vector<std::string> words;
    for (const auto& [word, value] : values) words.push_back(word);
    return add(
               Setting::Kind::word, std::move(name), std::move(help),
               [&target, values = std::move(values)](const std::string& word) -> Result<void> {
                 for (const auto& [known, value] : values) {
                   if (known == word) target = value;
                 }
                 return {};
               },
               std::move(member))
        .one_of(std::move(words));
  }

  /// At most one of the two may be set.
  void exclude(std::string one, std::string other);
  /// `name` is set only together with `needed`.
  void need(std::string name, std::string needed);

  /// Adds those of another request.
  void join(Settings more);

  const std::vector<Setting>& all() const { return settings_; }
  const std::vector<std::pair<std::string, std::string>>& exclusions() const { return exclusions_; }
  const std::vector<std::pair<std::string, std::string>>& needs() const { return needs_; }

 private:
  std::string owner_;
  std::vector<Setting> settings_;
  std::vector<std::pair<std::string, std::string>> exclusions_;
  std::vector<std::pair<std::string, std::string>> needs_;
};

/// The words of a list, with commas between them.
std::string listed(const std::vector<std::string>& words);

/// Sets it to the word: one of its choices, or what `set` reads. Errors: illegal_parameter, without
/// the setting's name.
Result<void> set(const Setting& setting, const std::string& word);

/// Words by the names of settings; several where one may be repeated.
using SettingWords = std::map<std::string, std::vector<std::string>>;

/// Sets those that `words` name. Errors: illegal_parameter, naming the setting: one that is not there, that
/// is given too often, beside one that excludes it or without one that it needs, or whose word is empty or
/// illegal.
Result<void> set(const Settings& settings, const SettingWords& words);

/// A message of the library in which the members ("ReadOptions::time_policy") have been replaced by what
/// `name_of` makes of their settings. Words of other structs stay.
std::string with_names(std::string_view message, const Settings& settings,
                       const std::function<std::string(const Setting&)>& name_of);

}  // namespace scarf
