#include "io/base/decimal.h"

#include <algorithm>

namespace scarf {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Takes a sign off the front; true if it was a minus.
bool take_sign(std::string_view& token) {
  if (token.empty() || (token[0] != '-' && token[0] != '+')) return false;
  const bool negative = token[0] == '-';
  token.remove_prefix(1);
  return negative;
}

}  // namespace

std::optional<int64_t> integer_from(std::string_view token) {
  constexpr int64_t kLimit = int64_t{1} << 31;
  const bool negative = take_sign(token);
  if (token.empty()) return std::nullopt;
  int64_t value = 0;
  for (const char c : token) {
    if (!is_digit(c)) return std::nullopt;
    value = std::min(value * 10 + (c - '0'), kLimit);
  }
  return negative ? -value : value;
}

namespace {

// A decimal number as a whole number of a unit, and what is left over.
struct Scanned {
  bool negative = false;
  int64_t whole = 0;
  bool too_large = false;  // for a whole number nearer to 0 than about 2^62
  int next = 0;            // the digit behind the whole number ...
  bool finer = false;      // ... and whether any behind that one is not 0
};

// nullopt if the token is no such number.
std::optional<Scanned> scan(std::string_view token, int unit_exponent) {
  Scanned scanned;
  scanned.negative = take_sign(token);
  size_t point = token.npos;
  int64_t exponent = 0;
  for (size_t i = 0; i < token.size(); ++i) {
    if (token[i] == '.' && point == token.npos) point = i;
    if (token[i] != 'e' && token[i] != 'E') continue;
    const auto value = integer_from(token.substr(i + 1));
    if (!value) return std::nullopt;
    exponent = *value;
    token = token.substr(0, i);
  }
  point = std::min(point, token.size());

  // The first `whole` digits make the whole number.
  const int64_t whole = static_cast<int64_t>(point) + exponent + unit_exponent;
  const auto append = [&scanned](int digit) {
    scanned.too_large |= scanned.whole > kMaxTextTime / 10;
    if (!scanned.too_large) scanned.whole = scanned.whole * 10 + digit;
  };
  int64_t index = 0;
  for (size_t i = 0; i < token.size(); ++i) {
    if (i == point) continue;
    if (!is_digit(token[i])) return std::nullopt;
    const int digit = token[i] - '0';
    if (index < whole) {
      append(digit);
    } else if (index == whole) {
      scanned.next = digit;
    } else {
      scanned.finer |= digit != 0;
    }
    ++index;
  }
  if (index == 0) return std::nullopt;
  for (; index < whole && scanned.whole != 0 && !scanned.too_large; ++index) append(0);
  return scanned;
}

}  // namespace

std::optional<int64_t> whole_from(std::string_view token) {
  constexpr int64_t kLimit = int64_t{1} << 31;
  if (const auto integer = integer_from(token)) return integer;
  const auto scanned = scan(token, 0);
  if (!scanned || scanned->next != 0 || scanned->finer) return std::nullopt;
  const int64_t value = scanned->too_large ? kLimit : std::min(scanned->whole, kLimit);
  return scanned->negative ? -value : value;
}

std::optional<int64_t> microseconds_from(std::string_view token, int unit_exponent) {
  const auto scanned = scan(token, unit_exponent);
  if (!scanned || scanned->too_large) return std::nullopt;
  // Half up is towards plus infinity: a negative time moves away from zero only beyond the half.
  const bool up = scanned->next > 5 || (scanned->next == 5 && (!scanned->negative || scanned->finer));
  const int64_t value = scanned->whole + (up ? 1 : 0);
  if (value >= kMaxTextTime) return std::nullopt;
  return scanned->negative ? -value : value;
}

bool is_decimal(std::string_view token) {
  take_sign(token);
  const size_t exponent = token.find_first_of("eE");
  if (exponent != token.npos && !integer_from(token.substr(exponent + 1))) return false;
  token = token.substr(0, exponent);
  const auto points = std::count(token.begin(), token.end(), '.');
  const auto digits = std::count_if(token.begin(), token.end(), is_digit);
  return points <= 1 && digits > 0 && points + digits == std::ssize(token);
}

}  // namespace scarf
