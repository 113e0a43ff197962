// Numbers of text files, read exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace scarf {

/// Times of text files are nearer to 0 than this, microseconds: so that differences of two fit 64 bits.
inline constexpr int64_t kMaxTextTime = int64_t{1} << 62;

/// A decimal number ("0.000003", "-1.5", "1.25e-3") of units of 10^exponent microseconds (6: seconds) as
/// microseconds, without binary rounding; what is finer is rounded half up. nullopt if it is not such a
/// number or as far as kMaxTextTime.
std::optional<int64_t> microseconds_from(std::string_view token, int exponent);

inline std::optional<int64_t> microseconds_from_seconds(std::string_view token) {
  return microseconds_from(token, 6);
}

/// Whether the token is a decimal number, which the others take.
bool is_decimal(std::string_view token);

/// A decimal number that is whole ("30", "30.000", "3.0e+01"), limited to +-2^31; nullopt if it is none.
std::optional<int64_t> whole_from(std::string_view token);

/// A decimal integer, limited to +-2^31; nullopt if it is none.
std::optional<int64_t> integer_from(std::string_view token);

}  // namespace scarf
