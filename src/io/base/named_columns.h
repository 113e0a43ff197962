// Columns that ReadOptions::columns names, for files whose names scarf does not know.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "scarf/core/result.h"

namespace scarf {

struct NamedColumn {
  std::string name;  ///< of a data set, an array or a field; what lies within another is parted from it by /
  std::optional<size_t> index = {};  ///< of several columns of that name, from 0
};

/// t, x, y and p.
using NamedColumns = std::array<NamedColumn, 4>;

/// Whether the option names columns ("t=/a/ts,x=/a/xy[0],y=/a/xy[1],p=/a/pol") and not their order ("txyp").
inline bool names_columns(std::string_view columns) {
  return columns.find('=') != columns.npos;
}

/// Errors: illegal_parameter, unless each of t, x, y and p is named once.
Result<NamedColumns> named_columns_from(std::string_view columns);

}  // namespace scarf
