// Numbers and pairs of numbers out of words.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/text.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf {

/// Whether there is nothing but blanks.
inline bool is_blank(std::string_view word) {
  return word.find_first_not_of(" \t\r\n\v\f") == word.npos;
}

/// The whole word as a number; nullopt if it is anything else.
template <class T>
std::optional<T> parse_integer(std::string_view word) {
  T value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// The whole word as an integer. Errors: illegal_parameter, naming the range of T.
template <class T>
Result<T> parse_whole(const std::string& word) {
  if (const auto value = parse_integer<T>(word)) return *value;
  using Limits = std::numeric_limits<T>;
  return Error{ErrorCode::illegal_parameter,
               text("'", word, "' is not a whole number from ", Limits::min(), " to ", Limits::max())};
}
/// The whole word as a finite decimal number. Errors: illegal_parameter.
Result<double> parse_number(const std::string& word);
/// A number of things, at least 1. Errors: illegal_parameter.
Result<uint64_t> parse_positive(const std::string& word);

/// A time as whole microseconds: a number of them, or a number with the unit us, ms or s ("1500", "1.5ms").
/// Errors: illegal_parameter, also for a fraction of a microsecond.
Result<int64_t> parse_time(const std::string& word);

/// Two numbers: one for each axis.
struct Pair {
  int32_t x = 0;
  int32_t y = 0;
};

/// "WxH". Errors: illegal_parameter, showing the form.
Result<Pair> parse_by(const std::string& word);
/// "X,Y". Errors: illegal_parameter, showing the form.
Result<Pair> parse_comma(const std::string& word);
/// "WxH" with 1 to kMaxSensorSize pixels each. Errors: illegal_parameter.
Result<SensorSize> parse_sensor(const std::string& word);

}  // namespace scarf
