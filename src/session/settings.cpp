#include "session/settings.h"

#include <algorithm>

#include "core/parse.h"
#include "core/text.h"

namespace scarf {
namespace {

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += text(list.empty() ? "" : ", ", word);
  return list;
}

Setting& Setting::in(std::string_view name_of_group) {
  group = name_of_group;
  return *this;
}

Setting& Setting::one_of(std::vector<std::string> words) {
  choices = std::move(words);
  return *this;
}

Setting& Settings::add(Setting::Kind kind, std::string name, std::string help,
                       std::function<Result<void>(const std::string&)> set, std::string member) {
  if (member.empty()) {
    member = name;
    std::replace(member.begin(), member.end(), '-', '_');
  }
  Setting setting;
  setting.name = std::move(name);
  setting.member = text(owner_, "::", member);
  setting.help = std::move(help);
  setting.kind = kind;
  setting.set = std::move(set);
  settings_.push_back(std::move(setting));
  return settings_.back();
}

Setting& Settings::add_text(Setting::Kind kind, std::string name, std::string& target, std::string help,
                            std::string member) {
  return add(
      kind, std::move(name), std::move(help),
      [&target](const std::string& word) -> Result<void> {
        target = word;
        return {};
      },
      std::move(member));
}

Setting& Settings::add_flag(std::string name, bool& target, std::string help, std::string member) {
  return add(
             Setting::Kind::flag, std::move(name), std::move(help),
             [&target](const std::string& word) -> Result<void> {
               target = word == "true";
               return {};
             },
             std::move(member))
      .one_of({"true", "false"});
}

void Settings::exclude(std::string one, std::string other) {
  exclusions_.emplace_back(std::move(one), std::move(other));
}

void Settings::need(std::string name, std::string needed) {
  needs_.emplace_back(std::move(name), std::move(needed));
}

void Settings::join(Settings more) {
  std::move(more.settings_.begin(), more.settings_.end(), std::back_inserter(settings_));
  std::move(more.exclusions_.begin(), more.exclusions_.end(), std::back_inserter(exclusions_));
  std::move(more.needs_.begin(), more.needs_.end(), std::back_inserter(needs_));
}

Result<void> set(const Setting& setting, const std::string& word) {
  if (!setting.choices.empty() &&
      std::find(setting.choices.begin(), setting.choices.end(), word) == setting.choices.end()) {
    return illegal(text("'", word, "' is none of ", listed(setting.choices)));
  }
  return setting.set(word);
}

Result<void> set(const Settings& settings, const SettingWords& words) {
  for (const auto& [name, values] : words) {
    const auto& all = settings.all();
    const auto setting =
        std::find_if(all.begin(), all.end(), [&wanted = name](const Setting& s) { return s.name == wanted; });
    if (setting == all.end()) {
      std::vector<std::string> names;
      for (const Setting& known : all) names.push_back(known.name);
      return illegal(text("'", name, "' is no setting; there are ", listed(names)));
    }
    if (values.size() > 1 && !setting->repeated) {
      return illegal(text(name, " has ", values.size(), " values, but takes one"));
    }
    for (const std::string& word : values) {
      if (is_blank(word)) return illegal(text(name, " is empty; give it a value, or leave it out"));
      if (const auto r = set(*setting, word); !r) return illegal(text(name, ": ", r.error().message));
    }
  }
  for (const auto& [one, other] : settings.exclusions()) {
    if (words.contains(one) && words.contains(other)) {
      return illegal(text(one, " and ", other, " exclude each other; leave one out"));
    }
  }
  for (const auto& [name, needed] : settings.needs()) {
    if (words.contains(name) && !words.contains(needed))
      return illegal(text(name, " needs ", needed, ", too"));
  }
  return {};
}

std::string with_names(std::string_view message, const Settings& settings,
                       const std::function<std::string(const Setting&)>& name_of) {
  std::string said;
  while (!message.empty()) {
    const auto here = std::find_if(settings.all().begin(), settings.all().end(), [&](const Setting& setting) {
      return message.starts_with(setting.member) &&
             (message.size() == setting.member.size() || !is_name(message[setting.member.size()])) &&
             (said.empty() || !is_name(said.back()));
    });
    const size_t length = here == settings.all().end() ? 1 : here->member.size();
    said += here == settings.all().end() ? std::string(message.substr(0, 1)) : name_of(*here);
    message.remove_prefix(length);
  }
  return said;
}

}  // namespace scarf
