// What the columns of text and arrays mean, and the unit of their times.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scarf/core/result.h"

namespace scarf {

enum class Column : uint8_t { t, x, y, p, camera, skipped };

/// What a number in a column of polarities means: 1 is brighter, 0 and -1 are darker.
/// nullopt: undefined.
constexpr std::optional<uint8_t> polarity_from(int64_t value) {
  if (value < -1 || value > 1) return std::nullopt;
  return static_cast<uint8_t>(value == 1 ? 1 : 0);
}

/// ReadOptions::columns: each of the letters t, x, y and p once, c at most once, _ for what is skipped.
/// Errors: illegal_parameter.
Result<std::vector<Column>> columns_from(std::string_view letters);

/// What the name of a column, field or data set says.
struct ColumnName {
  Column column = Column::skipped;  ///< skipped: the name says nothing
  /// Of a time with its unit in its name, the power of ten that turns it into microseconds: 0 for `time_us`,
  /// `t [us]` or "Timestamp(us)".
  std::optional<int> time_exponent;
};

/// The names that scarf knows, in text, NumPy and HDF5 alike: "timestamp", "xs", "Polarity", "event_t_ns", in
/// any case of letters, perhaps in quotes, with a unit or with the prefix `event`.
ColumnName column_name(std::string_view name);

/// What a column of this name holds, without its unit.
Column column_named(std::string_view name);

/// Whether t, x, y and p are there, each once, and at most one camera.
bool are_complete(const std::vector<Column>& columns);

/// ReadOptions::time_unit as the power of ten that turns it into microseconds: "s" is 6. nullopt if empty.
/// Errors: illegal_parameter.
Result<std::optional<int>> time_exponent_from(std::string_view unit);

}  // namespace scarf
