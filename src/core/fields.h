// Parameters in words, as "name:key=value,key=value". Each parameter is described once; the description reads
// it, checks it and explains it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.h"
#include "scarf/parameters.h"
#include "scarf/result.h"

namespace scarf {

/// One parameter: a number, a time in microseconds, or a choice between words (its value is the index).
struct Field {
  enum class Kind { number, time, choice };
  Kind kind = Kind::number;
  std::string_view name;
  int64_t low = 0;
  int64_t high = 0;
  std::string_view description;
  std::vector<std::string_view> choices = {};
};

inline Field number_field(std::string_view name, int64_t low, int64_t high, std::string_view description) {
  return {Field::Kind::number, name, low, high, description};
}
inline Field time_field(std::string_view name, int64_t low, int64_t high, std::string_view description) {
  return {Field::Kind::time, name, low, high, description};
}
inline Field choice_field(std::string_view name, std::vector<std::string_view> choices,
                          std::string_view description) {
  const auto last = static_cast<int64_t>(choices.size()) - 1;
  return {Field::Kind::choice, name, 0, last, description, std::move(choices)};
}

/// "support:range=1,period=100ms" in its parts.
struct NamedWords {
  std::string name;
  std::map<std::string, std::string> words;
};

/// `what`: "filter" or the like, for messages.
Result<NamedWords> split_words(std::string_view what, const std::string& line);

/// The value that a word stands for. `subject`: whose parameter it is, for messages.
Result<int64_t> read_field(const std::string& subject, const Field& field, const std::string& word);
Result<void> check_field(const std::string& subject, const Field& field, int64_t value);
ParameterInfo describe_field(const Field& field, int64_t value);
Error unknown_name(std::string_view what, const std::string& name, const std::vector<std::string>& known);

// The following call visit_fields(parameters, visit), which calls visit(Field, member) for each member.

template <class Parameters>
Result<void> check_fields(const std::string& subject, Parameters parameters) {
  Result<void> result;
  visit_fields(parameters, [&](const Field& field, auto& value) {
    if (result) result = check_field(subject, field, static_cast<int64_t>(value));
  });
  return result;
}

template <class Parameters>
std::vector<ParameterInfo> describe_fields(Parameters parameters = {}) {
  std::vector<ParameterInfo> infos;
  visit_fields(parameters, [&](const Field& field, auto& value) {
    infos.push_back(describe_field(field, static_cast<int64_t>(value)));
  });
  return infos;
}

template <class Parameters>
Result<Parameters> read_fields(const std::string& subject, std::map<std::string, std::string> words) {
  Parameters parameters;
  std::optional<Error> error;
  std::vector<std::string> known;
  visit_fields(parameters, [&](const Field& field, auto& value) {
    known.emplace_back(field.name);
    const auto word = words.extract(known.back());
    if (error || !word) return;
    const auto number = read_field(subject, field, word.mapped());
    if (!number) {
      error = number.error();
    } else {
      value = static_cast<std::remove_reference_t<decltype(value)>>(*number);
    }
  });
  if (error) return *error;
  if (!words.empty()) return unknown_name(subject + ": parameter", words.begin()->first, known);
  return parameters;
}

}  // namespace scarf
