#include "core/fields.h"

#include <charconv>

namespace scarf {
namespace {

constexpr int64_t kMillisecond = 1'000;
constexpr int64_t kSecond = 1'000'000;

// A time in the largest unit that writes it as a whole number.
std::string time_text(int64_t microseconds) {
  if (microseconds % kSecond == 0) return text(microseconds / kSecond, "s");
  if (microseconds % kMillisecond == 0) return text(microseconds / kMillisecond, "ms");
  return text(microseconds, "us");
}

std::string range_text(const Field& field) {
  switch (field.kind) {
    case Field::Kind::number:
      return text(field.low, " to ", field.high);
    case Field::Kind::time:
      return text(time_text(field.low), " to ", time_text(field.high));
    case Field::Kind::choice:
      break;
  }
  std::string names;
  for (const std::string_view choice : field.choices)
    names += (names.empty() ? "" : " or ") + std::string(choice);
  return names;
}

Error illegal(const std::string& subject, const Field& field, const std::string& value) {
  const std::string_view unit = field.kind == Field::Kind::time
                                    ? ", as a whole number of microseconds or with a suffix us, ms or s"
                                    : "";
  return {ErrorCode::illegal_parameter,
          text(subject, ": ", field.name, " is ", value, ", legal is ", range_text(field), unit)};
}

// A whole number and what follows it.
std::optional<std::pair<int64_t, std::string_view>> leading_number(std::string_view word) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc()) return std::nullopt;
  return std::pair(value, word.substr(end - word.data()));
}

std::optional<int64_t> microseconds_per(std::string_view suffix) {
  if (suffix.empty() || suffix == "us") return 1;
  if (suffix == "ms") return kMillisecond;
  if (suffix == "s") return kSecond;
  return std::nullopt;
}

std::optional<int64_t> parsed(const Field& field, const std::string& word) {
  if (field.kind == Field::Kind::choice) {
    for (size_t i = 0; i < field.choices.size(); ++i) {
      if (field.choices[i] == word) return static_cast<int64_t>(i);
    }
    return std::nullopt;
  }
  const auto number = leading_number(word);
  if (!number) return std::nullopt;
  const auto& [value, suffix] = *number;
  if (field.kind == Field::Kind::number) return suffix.empty() ? std::optional(value) : std::nullopt;
  const auto scale = microseconds_per(suffix);
  // Compared before it is multiplied: the product may not fit.
  if (!scale || value > field.high / *scale || value < 0) return std::nullopt;
  return value * *scale;
}

}  // namespace

Result<NamedWords> split_words(std::string_view what, const std::string& line) {
  const size_t colon = line.find(':');
  NamedWords result{line.substr(0, colon), {}};
  if (colon == std::string::npos) return result;
  std::string_view rest = std::string_view(line).substr(colon + 1);
  for (bool more = true; more;) {
    const size_t comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
    const size_t equals = word.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      return Error{ErrorCode::illegal_parameter,
                   text(what, " '", line, "': '", word, "' is no parameter; write ", what,
                        "s as name:parameter=value,parameter=value")};
    }
    if (!result.words.emplace(word.substr(0, equals), word.substr(equals + 1)).second) {
      return Error{ErrorCode::illegal_parameter,
                   text(what, " '", line, "': ", word.substr(0, equals), " is given twice; give it once")};
    }
  }
  return result;
}

Result<int64_t> read_field(const std::string& subject, const Field& field, const std::string& word) {
  const auto value = parsed(field, word);
  if (!value || *value < field.low || *value > field.high) return illegal(subject, field, "'" + word + "'");
  return *value;
}

Result<void> check_field(const std::string& subject, const Field& field, int64_t value) {
  if (value >= field.low && value <= field.high) return {};
  return illegal(subject, field, text(value));
}

ParameterInfo describe_field(const Field& field, int64_t value) {
  ParameterInfo info{std::string(field.name), text(value), range_text(field), std::string(field.description)};
  if (field.kind == Field::Kind::time) info.value = time_text(value);
  if (field.kind == Field::Kind::choice) info.value = field.choices[static_cast<size_t>(value)];
  return info;
}

Error unknown_name(std::string_view what, const std::string& name, const std::vector<std::string>& known) {
  std::string names;
  for (const std::string& each : known) names += (names.empty() ? "" : ", ") + each;
  return {ErrorCode::illegal_parameter,
          text(what, " '", name, "' is unknown; ", known.empty() ? "there is none" : "use one of " + names)};
}

}  // namespace scarf
