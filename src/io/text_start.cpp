#include "io/text_start.h"

#include <algorithm>
#include <limits>

#include "core/text.h"
#include "io/decimal.h"

namespace scarf {
namespace {

constexpr int kSeconds = 6;
constexpr int kMicroseconds = 0;

std::optional<SensorSize> size_from(std::string_view line) {
  const Fields fields = split(line);
  if (fields.count != 2) return std::nullopt;
  const auto width = integer_from(fields.text[0]);
  const auto height = integer_from(fields.text[1]);
  if (!width || !height) return std::nullopt;
  const auto clamped = [](int64_t v) {
    return static_cast<int32_t>(std::min<int64_t>(v, std::numeric_limits<int32_t>::max()));
  };
  return SensorSize{clamped(*width), clamped(*height)};
}

// Of `%geometry:width,height`.
std::optional<SensorSize> geometry_from(std::string_view line) {
  constexpr std::string_view kGeometry = "%geometry:";
  return line.starts_with(kGeometry) ? size_from(line.substr(kGeometry.size())) : std::nullopt;
}

bool is_data(const Fields& fields) {
  if (fields.count < 4 || fields.count > kMaxFields) return false;
  return std::all_of(fields.text.begin(), fields.text.begin() + static_cast<ptrdiff_t>(fields.count),
                     [](std::string_view token) { return is_decimal(token) || is_polarity(token); });
}

// The columns that a line of names stands for; empty if it is none.
std::vector<Column> names_from(const Fields& fields) {
  if (fields.count > kMaxFields) return {};
  std::vector<Column> columns;
  for (size_t i = 0; i < fields.count; ++i) columns.push_back(column_named(fields.text[i]));
  if (!are_complete(columns)) columns.clear();
  return columns;
}

void look_at(const Fields& fields, std::string_view line, TextStart& start) {
  static const TextLayout kPlain({Column::t, Column::x, Column::y, Column::p}, kSeconds);
  const auto kind = kPlain.parse(line).kind;
  start.plain |= kind == TextLayout::Line::event || kind == TextLayout::Line::outside;
  start.columns = fields.count;
  for (size_t i = 0; i < fields.count; ++i) {
    const bool fraction = is_decimal(fields.text[i]) && fields.text[i].find_first_of(".eE") != line.npos;
    start.fractional |= uint32_t{fraction} << i;
  }
}

Error ask(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

Result<std::vector<Column>> columns_of(const TextStart& start, bool csv, const ReadOptions& options) {
  std::vector<Column> columns = {Column::t, Column::x, Column::y, Column::p};
  if (!options.columns.empty()) {
    const auto given = columns_from(options.columns);
    if (!given) return given.error();
    columns = *given;
  } else if (!start.names.empty()) {
    columns = start.names;
  } else if (csv) {
    columns = {Column::x, Column::y, Column::p, Column::t};
  } else if (start.columns > 0 && !start.plain) {
    return ask(
        text("the lines have ", start.columns,
             " columns that do not read as t x y p; name their order with --columns, such as xypt, with "
             "_ for columns to skip and c for the camera"));
  }
  if (start.columns > 0 && columns.size() != start.columns) {
    return ask(text("the lines have ", start.columns, " columns, not ", columns.size(),
                    "; name their order with --columns, with _ for columns to skip and c for the camera"));
  }
  return columns;
}

// Whether times without a fraction are microseconds, as the programs write them that make such files.
bool are_microseconds(const TextStart& start, bool csv) {
  return start.named_on || (csv && start.names.empty());
}

bool has_fractions(const TextStart& start, const std::vector<Column>& columns) {
  const auto t = std::find(columns.begin(), columns.end(), Column::t) - columns.begin();
  return (start.fractional >> t & 1) != 0;
}

bool are_times_ambiguous(const TextStart& start, bool csv, const std::vector<Column>& columns) {
  return start.columns > 0 && !are_microseconds(start, csv) && !has_fractions(start, columns);
}

}  // namespace

std::optional<TextStart> find_text_start(std::span<const uint8_t> bytes, bool last) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  TextStart start;
  bool first = true;
  bool unknown = false;  // a line that is neither of the start nor an event
  for (size_t at = 0; at < all.size();) {
    const size_t newline = all.find('\n', at);
    if (newline == all.npos && !last) break;
    const std::string_view line = all.substr(at, std::min(newline, all.size()) - at);
    at += line.size() + (newline == all.npos ? 0 : 1);
    if (is_blank(line)) continue;
    const Fields fields = line.size() < kMaxLine ? split(line) : Fields();
    if (is_data(fields)) {
      look_at(fields, line, start);
    } else if (start.columns == 0 && !unknown) {
      const auto size = line.starts_with('%') ? geometry_from(line) : first ? size_from(line) : std::nullopt;
      const auto names = names_from(fields);
      if (size) start.size = size;
      if (!names.empty()) {
        start.names = names;
        start.named_on = std::find(fields.text.begin(), fields.text.end(), "on") != fields.text.end();
      }
      start.percent |= line.starts_with('%');
      unknown = !size && names.empty() && !line.starts_with('%');
      if (!unknown) start.bytes = at;
      if (unknown && start.size) return std::nullopt;
    }
    first = false;
  }
  // A sensor size or names and no event are an empty recording.
  const bool empty = last && !unknown && (start.size || start.percent || !start.names.empty());
  return start.columns > 0 || empty ? std::optional(start) : std::nullopt;
}

Result<TextLayout> text_layout(const TextStart& start, bool csv, const ReadOptions& options) {
  const auto columns = columns_of(start, csv, options);
  if (!columns) return columns.error();
  const bool cameras = std::find(columns->begin(), columns->end(), Column::camera) != columns->end();
  if (cameras && options.stream.empty()) {
    return ask("the lines name their camera; choose one with --stream, such as --stream 0");
  }
  if (!cameras && !options.stream.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 "--stream needs a column with the camera, c in --columns; leave it out or name the column"};
  }
  const auto given = time_exponent_from(options.time_unit);
  if (!given) return given.error();
  if (*given) return TextLayout(*columns, **given, options.stream);
  if (are_times_ambiguous(start, csv, *columns)) {
    return ask(
        "the times are whole numbers, so that seconds and microseconds look alike; name the unit with "
        "--time-unit, and the order of the columns with --columns if it is not t x y p");
  }
  const bool seconds = start.columns == 0 ? !are_microseconds(start, csv) : has_fractions(start, *columns);
  return TextLayout(*columns, seconds ? kSeconds : kMicroseconds, options.stream);
}

bool wants_more_lines(const TextStart& start, bool csv, const ReadOptions& options) {
  const auto columns = columns_of(start, csv, options);
  return columns && options.time_unit.empty() && are_times_ambiguous(start, csv, *columns);
}

}  // namespace scarf
