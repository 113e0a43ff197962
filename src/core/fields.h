// Parameters as words. A struct P of parameters has a function fields(P&, visit) that says each of them once:
//   visit(between("tau", p.tau, 1, 10'000'000, "time constant"));
// The functions below read, check and describe a struct, or a variant of such structs, by it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/text.h"
#include "scarf/core/parameters.h"
#include "scarf/core/result.h"

namespace scarf {

/// One parameter of a struct, with the value that it has there.
struct Field {
  const char* name;
  std::string word;  ///< its value
  bool legal;
  std::string range;  ///< what is legal
  const char* description;
  std::function<bool(const std::string&)> read;  ///< sets the value from a word; false: it is none
};

// Values from words; false: the word, as a whole, is none. An int64_t is a time in microseconds, with or
// without a suffix us, ms or s; a fraction is a time if it comes to whole microseconds.
bool read_word(const std::string& word, int32_t& value);
bool read_word(const std::string& word, int64_t& microseconds);
bool read_word(const std::string& word, double& value);
template <class T>
bool read_word(const std::string& word, std::optional<T>& value) {
  return read_word(word, value.emplace());
}

// And back: 33'000 us is "33ms", no value is "".
std::string word_of(int32_t value);
std::string word_of(int64_t microseconds);
std::string word_of(double value);
template <class T>
std::string word_of(const std::optional<T>& value) {
  return value ? word_of(*value) : "";
}

std::string joined(const std::vector<std::string>& words);

/// A parameter of which the caller says whether it is legal, and what is.
template <class T>
Field field(const char* name, T& value, bool legal, const std::string& range, const char* description) {
  const auto read = [&value](const std::string& word) { return read_word(word, value); };
  return {name, word_of(value), legal, range, description, read};
}

/// A number or time from `low` to `high`.
template <class T>
Field between(const char* name, T& value, std::type_identity_t<T> low, std::type_identity_t<T> high,
              const char* description) {
  const bool legal = low <= value && value <= high;
  return field(name, value, legal, word_of(low) + " to " + word_of(high), description);
}

/// One of some words, which stand for the values 0, 1, .. of an enumeration or bool.
template <class E>
Field choice(const char* name, E& value, const std::vector<std::string>& words, const char* description) {
  const auto index = static_cast<size_t>(value);
  const bool legal = index < words.size();
  const auto read = [&value, words](const std::string& word) {
    for (size_t i = 0; i < words.size(); ++i) {
      if (words[i] != word) continue;
      value = static_cast<E>(i);
      return true;
    }
    return false;
  };
  return {name, legal ? words[index] : text(static_cast<int>(value)), legal, joined(words), description,
          read};
}
inline Field choice(const char* name, bool& value, const char* description) {
  return choice(name, value, {"false", "true"}, description);
}

Error illegal_value(const std::string& subject, const Field& field, const std::string& value);
/// `what`: "filter" or the like.
Error unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known);

template <class P>
std::vector<ParameterInfo> describe_fields(P parameters = {}) {
  std::vector<ParameterInfo> infos;
  fields(parameters, [&](const Field& f) { infos.push_back({f.name, f.word, f.range, f.description}); });
  return infos;
}

/// Sets the parameters that are named. They are not checked: what is legal may depend on several of them.
/// `subject`: whose parameters they are.
template <class P>
Result<void> read_fields(const std::string& subject, std::map<std::string, std::string> words,
                         P& parameters) {
  Result<void> result;
  std::vector<std::string> known;
  fields(parameters, [&](const Field& f) {
    known.emplace_back(f.name);
    const auto word = words.extract(f.name);
    if (result && word && !f.read(word.mapped()))
      result = illegal_value(subject, f, "'" + word.mapped() + "'");
  });
  if (result && !words.empty()) return unknown_name(subject + ": parameter", words.begin()->first, known);
  return result;
}

template <class P>
Result<void> check_fields(const std::string& subject, P& parameters) {
  Result<void> result;
  fields(parameters, [&](const Field& f) {
    if (result && !f.legal) result = illegal_value(subject, f, f.word);
  });
  return result;
}

/// "support:range=1,period=100ms" in its parts.
struct NamedWords {
  std::string name;
  std::map<std::string, std::string> words;
};
Result<NamedWords> split_words(const std::string& what, const std::string& line);

/// The alternative of that name from defaults and words, not checked. `infos`: one per alternative.
template <class Variant, class Info>
Result<Variant> read_alternative(const std::string& what, std::span<const Info> infos,
                                 const NamedWords& named) {
  std::vector<std::string> known;
  for (const Info& info : infos) known.push_back(info.name);
  Result<Variant> result = unknown_name(what, named.name, known);
  const auto read = [&]<class P>(P parameters, const std::string& name) {
    if (name != named.name) return;
    const auto words_read = read_fields(name, named.words, parameters);
    result = words_read ? Result<Variant>(parameters) : words_read.error();
  };
  const auto try_all = [&]<size_t... I>(std::index_sequence<I...>) {
    (read(std::variant_alternative_t<I, Variant>{}, infos[I].name), ...);
  };
  try_all(std::make_index_sequence<std::variant_size_v<Variant>>());
  return result;
}

template <class Variant>
Result<Variant> checked_alternative(Variant variant) {
  const auto check = [&](auto& parameters) { return check_fields(info_of(variant).name, parameters); };
  const auto result = std::visit(check, variant);
  if (!result) return result.error();
  return variant;
}

}  // namespace scarf
