#include "core/fields.h"

#include <algorithm>
#include <charconv>

#include "core/time_unit.h"

namespace scarf {
namespace {

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

template <class T>
bool read_number(const std::string& word, T& value) {
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

// How many decimals of a time in this unit come to whole microseconds.
std::optional<size_t> decimals_of(const std::string& unit) {
  const auto exponent = unit.empty() ? 0 : time_exponent(unit);
  return exponent && *exponent >= 0 ? std::optional(static_cast<size_t>(*exponent)) : std::nullopt;
}

}  // namespace

bool read_word(const std::string& word, int32_t& value) {
  return read_number(word, value);
}
bool read_word(const std::string& word, double& value) {
  return read_number(word, value);
}

// The point moves to the right in the digits themselves, so nothing is rounded.
bool read_word(const std::string& word, int64_t& microseconds) {
  const size_t unit = std::min(word.find_first_not_of("0123456789."), word.size());
  const auto decimals = decimals_of(word.substr(unit));
  const size_t point = std::min(word.find('.'), unit);
  const std::string whole = word.substr(0, point);
  std::string fraction = point < unit ? word.substr(point + 1, unit - point - 1) : "";
  if (!decimals || (whole.empty() && fraction.empty())) return false;
  fraction.erase(fraction.find_last_not_of('0') + 1);
  if (fraction.size() > *decimals) return false;
  fraction.resize(*decimals, '0');
  return read_number(whole + fraction, microseconds);
}

std::string word_of(int32_t value) {
  return text(value);
}
std::string word_of(double value) {
  return text(value);
}
std::string word_of(int64_t microseconds) {
  if (microseconds % 1'000'000 == 0) return text(microseconds / 1'000'000, "s");
  if (microseconds % 1'000 == 0) return text(microseconds / 1'000, "ms");
  return text(microseconds, "us");
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

Error illegal_value(const std::string& subject, const Field& field, const std::string& value) {
  return illegal(text(subject, ": ", field.name, " is ", value, ", legal is ", field.range));
}

Error unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  return illegal(text(what, " '", name, "' is unknown; ",
                      known.empty() ? "there is none" : "use one of " + joined(known)));
}

Result<NamedWords> split_words(const std::string& what, const std::string& line) {
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
      return illegal(text(what, " '", line, "': '", word, "' is no parameter; write ", what,
                          "s as name:parameter=value,parameter=value"));
    }
    if (!result.words.emplace(word.substr(0, equals), word.substr(equals + 1)).second)
      return illegal(text(what, " '", line, "': ", word.substr(0, equals), " is given twice; give it once"));
  }
  return result;
}

}  // namespace scarf
