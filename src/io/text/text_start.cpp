#include "io/text/text_start.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "core/text.h"
#include "io/base/decimal.h"

namespace scarf {
namespace {

constexpr int kSeconds = 6;
constexpr int kMicroseconds = 0;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr size_t kMaxQuote = 60;  // characters of a line in a message

std::optional<SensorSize> size_from(std::string_view line) {
  const Fields fields = split(line, separator_of(line));
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

// "2026-01-31", "2026/01/31T12:00:00", "12:00:00.5".
bool is_date(std::string_view field) {
  const auto digits = [&](size_t at, size_t count) {
    return field.size() >= at + count && std::all_of(field.begin() + static_cast<ptrdiff_t>(at),
                                                     field.begin() + static_cast<ptrdiff_t>(at + count),
                                                     [](char c) { return c >= '0' && c <= '9'; });
  };
  if (field.size() >= 8 && digits(0, 4) && (field[4] == '-' || field[4] == '/')) return digits(5, 1);
  return field.size() >= 5 && digits(0, 2) && field[2] == ':' && digits(3, 2);
}

bool is_value(std::string_view field) {
  return is_decimal(field) || polarity_field(field) != PolarityField::none || is_date(field);
}

size_t values_in(const Fields& fields) {
  const size_t count = std::min(fields.count, kMaxFields);
  return static_cast<size_t>(
      std::count_if(fields.text.begin(), fields.text.begin() + static_cast<ptrdiff_t>(count), is_value));
}

// A line that could be an event.
bool is_data(const Fields& fields) {
  return fields.count <= kMaxFields && values_in(fields) >= 4;
}

// The same behind a line of names, which may have fields that are no values.
bool is_data(const Fields& fields, const TextStart& start) {
  if (is_data(fields)) return true;
  const size_t names = start.names.size();
  const bool fits = fields.count == names || fields.without_last_empty() == names;
  return names > 0 && fits && values_in(fields) > 0;
}

// Also the polarities that are words: `on` is a name, too.
bool has_numbers(const Fields& fields) {
  const size_t count = std::min(fields.count, kMaxFields);
  return std::any_of(fields.text.begin(), fields.text.begin() + static_cast<ptrdiff_t>(count),
                     [](std::string_view field) { return is_decimal(field) || is_date(field); });
}

std::vector<Column> columns_of(const std::vector<ColumnName>& names) {
  std::vector<Column> columns;
  for (const ColumnName& name : names) columns.push_back(name.column);
  return columns;
}

std::vector<ColumnName> names_in(const Fields& fields) {
  std::vector<ColumnName> names;
  if (fields.count > kMaxFields) return names;
  for (size_t i = 0; i < fields.without_last_empty(); ++i) names.push_back(column_name(fields.text[i]));
  return names;
}

// Looks for names in a line; whether it has them.
bool take_names(std::string_view line, TextStart& start) {
  const Fields fields = split(line, separator_of(line));
  auto names = names_in(fields);
  if (!are_complete(columns_of(names))) return false;
  start.named_on = false;
  for (size_t i = 0; i < names.size(); ++i) start.named_on |= fields.text[i] == "on";
  start.names = std::move(names);
  return true;
}

// `# x,y,t,p`, `# columns: x y t p`.
bool take_names_of_comment(std::string_view comment, TextStart& start) {
  comment.remove_prefix(1);
  const size_t colon = comment.rfind(':');
  if (colon != comment.npos && take_names(comment.substr(colon + 1), start)) return true;
  return take_names(comment, start);
}

std::string quoted(std::string_view line) {
  std::string shown(line.substr(0, kMaxQuote));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      ' ');
  return text("'", shown.substr(0, shown.find_last_not_of(' ') + 1), line.size() > kMaxQuote ? "...'" : "'");
}

void take_heading(std::string_view line, const Fields& fields, TextStart& start) {
  const std::vector<Column> columns = columns_of(names_in(fields));
  const auto has = [&](Column c) { return std::find(columns.begin(), columns.end(), c) != columns.end(); };
  start.heading = quoted(line);
  start.heading_of_events |= has(Column::p) && has(Column::x) && has(Column::y);
}

double number_from(std::string_view field) {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (field.starts_with('+')) field.remove_prefix(1);
  std::from_chars(field.data(), field.data() + field.size(), value);
  return value;
}

void look_at(const Fields& fields, TextStart& start) {
  for (size_t i = 0; i < std::min(start.looks.size(), fields.count); ++i) {
    const std::string_view field = fields.text[i];
    const PolarityField polarity = polarity_field(field);
    if (is_decimal(field)) {
      start.looks[i].add(number_from(field));
      if (field.find_first_of(".eE") != field.npos) start.decimals |= uint32_t{1} << i;
    } else if (polarity == PolarityField::on || polarity == PolarityField::off) {
      start.looks[i].add(polarity == PolarityField::on ? 1 : 0);
    } else {
      start.looks[i].add_other();
      if (start.date.empty() && is_date(field)) start.date = field;
    }
  }
}

void begin_data(std::string_view line, TextStart& start) {
  start.separator = separator_of(line);
  const Fields fields = split(line, start.separator);
  start.fields = fields.count;
  start.open = fields.without_last_empty() < fields.count;
  start.looks.resize(fields.without_last_empty());
}

Error ask(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

bool fits(const TextStart& start, size_t columns) {
  return start.fields == 0 || columns == start.fields || (start.open && columns + 1 == start.fields);
}

// An order of the columns that the lines allow, as advice.
std::string advice(const TextStart& start) {
  const std::string order = likely_order(start.looks);
  return text("name their order with ReadOptions::columns",
              order.empty() ? ", such as xypt, with _ for columns to skip and c for the camera"
                            : text("; the lines would allow ReadOptions::columns ", order));
}

// Whether these may be events in some order, and are not to be passed over as something else.
bool may_be_events(const TextStart& start) {
  if (!start.names.empty() || start.heading_of_events) return true;
  // Other names say more than numbers do, unless those are four that look like an event's.
  if (!start.heading.empty() && start.looks.size() != 4) return false;
  return !likely_order(start.looks).empty();
}

Error refused(const TextStart& start, std::string message) {
  return {may_be_events(start) ? ErrorCode::bad_input : ErrorCode::unrecognised, std::move(message)};
}

Error dates(const TextStart& start) {
  const bool others = std::any_of(start.looks.begin(), start.looks.end(),
                                  [](const ColumnLook& look) { return look.is_polarity(); }) &&
                      std::count_if(start.looks.begin(), start.looks.end(),
                                    [](const ColumnLook& look) { return look.is_coordinate(); }) >= 3;
  return {others || may_be_events(start) ? ErrorCode::bad_input : ErrorCode::unrecognised,
          text("the times are dates (", quoted(start.date),
               "), which scarf does not read; write them as numbers, seconds or microseconds")};
}

bool are_dates(const TextStart& start, const std::vector<Column>& columns) {
  const auto t = static_cast<size_t>(std::find(columns.begin(), columns.end(), Column::t) - columns.begin());
  return !start.date.empty() && t < start.looks.size() && !start.looks[t].has_numbers();
}

Result<std::vector<Column>> columns_of(const TextStart& start, bool csv, const ReadOptions& options) {
  const auto mismatch = [&](size_t columns) -> Error {
    if (!start.date.empty()) return dates(start);
    return refused(
        start, text("the lines have ", start.looks.size(), " columns, not ", columns,
                    "; name their order with ReadOptions::columns, with _ for columns to skip and c for the "
                    "camera"));
  };
  std::vector<Column> columns;
  if (!options.columns.empty()) {
    const auto given = columns_from(options.columns);
    if (!given) return given.error();
    columns = *given;
  } else if (!start.names.empty()) {
    columns = columns_of(start.names);
  }
  if (!columns.empty()) {
    if (!fits(start, columns.size())) return mismatch(columns.size());
    if (are_dates(start, columns)) return dates(start);
    return columns;
  }

  // Nobody has named them: the format's own order, if the lines do not speak against it.
  columns = {Column::t, Column::x, Column::y, Column::p};
  if (csv) columns = {Column::x, Column::y, Column::p, Column::t};
  if (start.fields == 0) return columns;
  if (!start.date.empty()) return dates(start);
  if (!start.heading.empty()) {
    return refused(start, text("the line ", start.heading, " is none of names that scarf knows, ",
                               "so that the columns are unknown; ", advice(start)));
  }
  // Files with a size have the order of the programs that write it.
  const bool known = csv || start.size;
  if (allows(start.looks, columns) && (known || has_times(start.looks, columns))) return columns;
  return refused(start, text("the lines have ", start.looks.size(), " columns that do not read as ",
                             csv ? "x y p t" : "t x y p", "; ", advice(start)));
}

// The unit that a name says.
std::optional<int> named_exponent(const TextStart& start, const ReadOptions& options) {
  if (!options.columns.empty()) return std::nullopt;
  for (const ColumnName& name : start.names) {
    if (name.time_exponent) return name.time_exponent;
  }
  return std::nullopt;
}

const ColumnLook* look_of_times(const TextStart& start, const std::vector<Column>& columns) {
  const auto t = static_cast<size_t>(std::find(columns.begin(), columns.end(), Column::t) - columns.begin());
  return t < start.looks.size() ? &start.looks[t] : nullptr;
}

bool are_decimals(const TextStart& start, const std::vector<Column>& columns) {
  const auto t = static_cast<size_t>(std::find(columns.begin(), columns.end(), Column::t) - columns.begin());
  return (start.decimals >> t & 1) != 0;
}

bool has_fractions(const TextStart& start, const std::vector<Column>& columns) {
  const ColumnLook* const times = look_of_times(start, columns);
  return times != nullptr && times->has_fractions();
}

bool are_times_ambiguous(const TextStart& start, bool csv, const ReadOptions& options,
                         const std::vector<Column>& columns) {
  // Programs write whole microseconds that make files with % or a column `on`.
  if (!options.time_unit.empty() || named_exponent(start, options) || start.named_on || csv) return false;
  const ColumnLook* const times = look_of_times(start, columns);
  if (times == nullptr || !times->has_numbers() || times->has_fractions()) return false;
  // Behind a line with the size come seconds with decimals, even if those are 0.
  return !(start.size && are_decimals(start, columns));
}

// Whether some line behind the start is what the layout says, if there are lines.
Result<void> check_lines(const TextStart& start, const TextLayout& layout, std::span<const uint8_t> bytes) {
  using Line = TextLayout::Line;
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  rest.remove_prefix(std::min(start.bytes, rest.size()));
  std::string_view first;
  size_t unknown = 0;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const bool whole = line.size() < rest.size();
    rest.remove_prefix(line.size() + (whole ? 1 : 0));
    const auto kind = line.size() < kMaxLine ? layout.parse(line).kind : Line::unknown;
    if (line.starts_with('#') || is_blank_or_comment(line)) continue;
    if (kind != Line::unknown) return {};  // a line of another camera, too
    if (!whole) break;                     // it may go on
    if (unknown++ == 0) first = line;
  }
  if (unknown == 0) return {};
  return refused(start, text("none of the first ", unknown, " lines, such as ", quoted(first),
                             ", reads as an event: whole x and y, a time and a polarity; name the order of "
                             "the columns with ReadOptions::columns"));
}

}  // namespace

std::optional<TextStart> find_text_start(std::span<const uint8_t> bytes, bool last) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  TextStart start;
  TextStart comment;     // the names of a comment, which count if they fit the lines
  bool first = true;     // neither empty lines nor comments before
  bool unknown = false;  // a line that is neither of the start nor an event
  if (all.starts_with(kByteOrderMark)) start.bytes = kByteOrderMark.size();
  for (size_t at = start.bytes; at < all.size();) {
    const size_t newline = all.find('\n', at);
    if (newline == all.npos && !last) break;
    const std::string_view line = all.substr(at, std::min(newline, all.size()) - at);
    at += line.size() + (newline == all.npos ? 0 : 1);
    if (start.fields == 0 && line.starts_with('#')) take_names_of_comment(line, comment);
    if (is_blank_or_comment(line)) continue;
    const bool begun = start.fields > 0;
    const Fields fields =
        line.size() < kMaxLine ? split(line, begun ? start.separator : separator_of(line)) : Fields();
    if (is_data(fields, start)) {
      if (!begun) begin_data(line, start);
      look_at(fields, start);
    } else if (!begun) {
      const bool percent = line.starts_with('%');
      const auto size = percent ? geometry_from(line) : first ? size_from(line) : std::nullopt;
      if (size) start.size = size;
      start.percent |= percent;
      const bool names = take_names(percent ? line.substr(1) : line, start);
      const bool heading = !names && !percent && fields.count > 0 && !has_numbers(fields);
      if (heading) take_heading(line, fields, start);
      if (!size && !names && !percent && !heading) {
        // Two numbers that are no size of a sensor: no recording.
        if (start.size) return std::nullopt;
        unknown = true;
      }
      if (!unknown) start.bytes = at;
    }
    first = false;
  }
  if (start.names.empty() && !comment.names.empty() && start.heading.empty() &&
      fits(start, comment.names.size())) {
    start.names = std::move(comment.names);
    start.named_on = comment.named_on;
  }
  if (!start.names.empty()) start.heading.clear();
  // A sensor size or names and no event are an empty recording.
  const bool empty =
      last && !unknown && start.heading.empty() && (start.size || start.percent || !start.names.empty());
  return start.fields > 0 || empty ? std::optional(start) : std::nullopt;
}

bool is_order_guessed(const TextStart& start, const ReadOptions& options) {
  return options.columns.empty() && start.names.empty();
}

Result<TextLayout> text_layout(const TextStart& start, std::span<const uint8_t> bytes, bool csv,
                               const ReadOptions& options) {
  const auto given = time_exponent_from(options.time_unit);
  if (!given) return given.error();
  const auto columns = columns_of(start, csv, options);
  if (!columns) return columns.error();
  const bool cameras = std::find(columns->begin(), columns->end(), Column::camera) != columns->end();
  if (cameras && options.stream.empty()) {
    return ask(
        "the lines name their camera; choose one with ReadOptions::stream, such as ReadOptions::stream 0");
  }
  if (!cameras && !options.stream.empty()) {
    return Error{ErrorCode::illegal_parameter,
                 "ReadOptions::stream needs a column with the camera, c in ReadOptions::columns; leave it "
                 "out or name the column"};
  }
  if (are_times_ambiguous(start, csv, options, *columns)) {
    return ask(
        text("the times are whole numbers, so that seconds and microseconds look alike; name the unit with "
             "ReadOptions::time_unit",
             is_order_guessed(start, options)
                 ? ", and the order of the columns with ReadOptions::columns if it is not t x y p"
                 : ""));
  }
  const bool microseconds = (start.named_on || csv) && !has_fractions(start, *columns);
  const int exponent =
      given->value_or(named_exponent(start, options).value_or(microseconds ? kMicroseconds : kSeconds));
  TextLayout layout(*columns, start.separator, exponent, options.stream);
  if (auto r = check_lines(start, layout, bytes); !r) return r.error();
  return layout;
}

}  // namespace scarf
