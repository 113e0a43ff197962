#include "io/columns.h"

#include <algorithm>
#include <string>

#include "core/text.h"
#include "core/time_unit.h"

namespace scarf {
namespace {

struct Name {
  std::string_view name;
  Column column;
};

constexpr Name kNames[] = {
    {"t", Column::t},           {"ts", Column::t},         {"time", Column::t},
    {"timestamp", Column::t},   {"timestamps", Column::t}, {"x", Column::x},
    {"xs", Column::x},          {"y", Column::y},          {"ys", Column::y},
    {"p", Column::p},           {"ps", Column::p},         {"pol", Column::p},
    {"polarity", Column::p},    {"polarities", Column::p}, {"on", Column::p},
    {"camera", Column::camera}, {"cam", Column::camera},   {"channel", Column::camera},
};

}  // namespace

Result<std::vector<Column>> columns_from(std::string_view letters) {
  constexpr std::string_view kLetters = "txypc_";
  constexpr Column kColumns[] = {Column::t, Column::x, Column::y, Column::p, Column::camera, Column::skipped};
  std::vector<Column> columns;
  for (const char letter : letters) {
    const size_t at = kLetters.find(letter);
    if (at == kLetters.npos) {
      columns.clear();
      break;
    }
    columns.push_back(kColumns[at]);
  }
  if (are_complete(columns)) return columns;
  return Error{ErrorCode::illegal_parameter,
               text("the columns '", letters,
                    "' must have each of t, x, y and p once, c (the camera) at most once, and _ for each "
                    "column to skip, such as txyp or xypt_")};
}

Column column_named(std::string_view name) {
  std::string lower(name);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const Name& known : kNames) {
    if (known.name == lower) return known.column;
  }
  return Column::skipped;
}

bool are_complete(const std::vector<Column>& columns) {
  const auto times = [&](Column column) { return std::count(columns.begin(), columns.end(), column); };
  return times(Column::t) == 1 && times(Column::x) == 1 && times(Column::y) == 1 && times(Column::p) == 1 &&
         times(Column::camera) <= 1;
}

Result<std::optional<int>> time_exponent_from(std::string_view unit) {
  if (unit.empty()) return std::optional<int>();
  if (const auto exponent = time_exponent(unit)) return exponent;
  return Error{ErrorCode::illegal_parameter,
               text("the unit of times '", unit, "' is unknown; there are ", kTimeUnits)};
}

}  // namespace scarf
