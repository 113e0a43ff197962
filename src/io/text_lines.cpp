#include "io/text_lines.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "io/decimal.h"

namespace scarf {
namespace {

std::optional<uint8_t> polarity_from(std::string_view token) {
  if (token == "1" || token == "true" || token == "True") return uint8_t{1};
  if (token == "0" || token == "-1" || token == "false" || token == "False") return uint8_t{0};
  return std::nullopt;
}

size_t place_of(Column column, const std::vector<Column>& columns) {
  return static_cast<size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

}  // namespace

Fields split(std::string_view line) {
  const auto separates = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; };
  Fields fields;
  size_t at = 0;
  for (;;) {
    while (at < line.size() && separates(line[at])) ++at;
    if (at == line.size()) return fields;
    const size_t begin = at;
    while (at < line.size() && !separates(line[at])) ++at;
    if (fields.count == kMaxFields) return ++fields.count, fields;
    fields.text[fields.count++] = line.substr(begin, at - begin);
  }
}

bool is_blank(std::string_view line) {
  return line.starts_with('#') || line.find_first_not_of(" \t,\r") == line.npos;
}

bool is_polarity(std::string_view token) {
  return polarity_from(token).has_value();
}

TextLayout::TextLayout(const std::vector<Column>& columns, int exponent, std::string camera)
    : count_(columns.size()),
      t_(place_of(Column::t, columns)),
      x_(place_of(Column::x, columns)),
      y_(place_of(Column::y, columns)),
      p_(place_of(Column::p, columns)),
      exponent_(exponent),
      camera_(std::move(camera)) {
  const size_t place = place_of(Column::camera, columns);
  if (place < count_) camera_column_ = place;
}

TextLayout::Line TextLayout::parse(std::string_view line) const {
  if (line.starts_with('#')) return {Line::blank, {}};
  const Fields fields = split(line);
  if (fields.count == 0) return {Line::blank, {}};
  if (fields.count != count_ || count_ > kMaxFields) return {};
  const auto t = microseconds_from(fields.text[t_], exponent_);
  const auto x = integer_from(fields.text[x_]);
  const auto y = integer_from(fields.text[y_]);
  const auto p = polarity_from(fields.text[p_]);
  if (!t || !x || !y || !p) return {};
  if (camera_column_ && fields.text[*camera_column_] != camera_) return {Line::blank, {}};
  const auto fits = [](int64_t v) { return v >= 0 && v <= std::numeric_limits<uint16_t>::max(); };
  if (!fits(*x) || !fits(*y)) return {Line::outside, {*t}};
  return {Line::event, {*t, static_cast<uint16_t>(*x), static_cast<uint16_t>(*y), *p}};
}

}  // namespace scarf
