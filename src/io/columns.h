// What the columns of text and arrays mean, and the unit of their times.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scarf/result.h"

namespace scarf {

enum class Column : uint8_t { t, x, y, p, camera, skipped };

/// ReadOptions::columns: each of the letters t, x, y and p once, c at most once, _ for what is skipped.
/// Errors: illegal_parameter.
Result<std::vector<Column>> columns_from(std::string_view letters);

/// What a column of this name holds ("timestamp", "xs", "polarity", ...), in any case of letters; skipped if
/// the name says nothing.
Column column_named(std::string_view name);

/// Whether t, x, y and p are there, each once, and at most one camera.
bool are_complete(const std::vector<Column>& columns);

/// ReadOptions::time_unit as the power of ten that turns it into microseconds: "s" is 6. nullopt if empty.
/// Errors: illegal_parameter.
Result<std::optional<int>> time_exponent_from(std::string_view unit);

}  // namespace scarf
