// Units of time as users write them.
#pragma once

#include <optional>
#include <string_view>

namespace scarf {

/// The power of ten that turns times of a unit into microseconds: "s" is 6, "ns" is -3. nullopt: there is no
/// such unit.
constexpr std::optional<int> time_exponent(std::string_view unit) {
  if (unit == "s") return 6;
  if (unit == "ms") return 3;
  if (unit == "us") return 0;
  if (unit == "ns") return -3;
  return std::nullopt;
}

/// All of them, for messages.
inline constexpr std::string_view kTimeUnits = "s, ms, us and ns";

}  // namespace scarf
