#include "io/base/columns.h"

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

// Without units, prefixes and quotes, in small letters: the one table of all formats that have names.
constexpr Name kNames[] = {
    {"t", Column::t},
    {"ts", Column::t},
    {"time", Column::t},
    {"times", Column::t},
    {"timestamp", Column::t},
    {"timestamps", Column::t},
    {"time_stamp", Column::t},
    {"time_stamps", Column::t},
    {"x", Column::x},
    {"xs", Column::x},
    {"x_pos", Column::x},
    {"pos_x", Column::x},
    {"x_coord", Column::x},
    {"coord_x", Column::x},
    {"x_coordinate", Column::x},
    {"y", Column::y},
    {"ys", Column::y},
    {"y_pos", Column::y},
    {"pos_y", Column::y},
    {"y_coord", Column::y},
    {"coord_y", Column::y},
    {"y_coordinate", Column::y},
    {"p", Column::p},
    {"ps", Column::p},
    {"pol", Column::p},
    {"pols", Column::p},
    {"polarity", Column::p},
    {"polarities", Column::p},
    {"on", Column::p},
    {"is_on", Column::p},
    {"is_increase", Column::p},
    {"camera", Column::camera},
    {"cam", Column::camera},
    {"channel", Column::camera},
    {"camera_id", Column::camera},
    {"cam_id", Column::camera},
};

struct Unit {
  std::string_view name;
  int exponent;
};

// Of times, behind their name: `time_us`, `t [s]`, `timestamp(ns)`.
constexpr Unit kUnits[] = {
    {"s", 6},         {"sec", 6},   {"secs", 6},   {"second", 6},      {"seconds", 6},
    {"ms", 3},        {"msec", 3},  {"msecs", 3},  {"millisecond", 3}, {"milliseconds", 3},
    {"us", 0},        {"usec", 0},  {"usecs", 0},  {"microsecond", 0}, {"microseconds", 0},
    {"\xc2\xb5s", 0},  // with the micro sign
    {"\xce\xbcs", 0},  // with the Greek letter
    {"ns", -3},       {"nsec", -3}, {"nsecs", -3}, {"nanosecond", -3}, {"nanoseconds", -3},
};

constexpr std::string_view kAround = " \t\r\"'`";    // what is no part of a name at its ends
constexpr std::string_view kBetween = " _-.:/[]()";  // what parts a name from a unit

std::string_view trimmed(std::string_view text, std::string_view off) {
  const size_t begin = std::min(text.find_first_not_of(off), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(off) + 1);
}

Column column_of(std::string_view name) {
  for (const Name& known : kNames) {
    if (known.name == name) return known.column;
  }
  return Column::skipped;
}

}  // namespace

ColumnName column_name(std::string_view written) {
  std::string lower(trimmed(written, kAround));
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  std::string_view name = lower;
  for (const std::string_view prefix : {"events", "event"}) {
    if (name.starts_with(prefix) && name.size() > prefix.size() + 1 &&
        kBetween.find(name[prefix.size()]) != kBetween.npos) {
      name.remove_prefix(prefix.size() + 1);
      break;
    }
  }
  std::string stem(name);
  std::replace(stem.begin(), stem.end(), ' ', '_');
  if (const Column column = column_of(stem); column != Column::skipped) return {column, std::nullopt};

  // What stands behind the last mark may be the unit.
  const std::string_view rest = trimmed(name, kBetween);
  const size_t mark = rest.find_last_of(kBetween);
  if (mark == rest.npos) return {};
  const std::string_view last = rest.substr(mark + 1);
  stem = trimmed(rest.substr(0, mark), kBetween);
  std::replace(stem.begin(), stem.end(), ' ', '_');
  const Column column = column_of(stem);
  if (column == Column::t) {
    for (const Unit& unit : kUnits) {
      if (unit.name == last) return {column, unit.exponent};
    }
  }
  const bool pixels = last == "px" || last == "pix" || last == "pixel" || last == "pixels";
  if (pixels && (column == Column::x || column == Column::y)) return {column, std::nullopt};
  return {};
}

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
  return column_name(name).column;
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
