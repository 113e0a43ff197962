#include "io/text/text_lines.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "io/base/decimal.h"

namespace scarf {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

size_t place_of(Column column, const std::vector<Column>& columns) {
  return static_cast<size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

std::string_view trimmed(std::string_view field) {
  while (!field.empty() && is_blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_blank(field.back())) field.remove_suffix(1);
  return field;
}

std::string_view unquoted(std::string_view field) {
  const bool quoted = field.size() >= 2 && (field[0] == '"' || field[0] == '\'') && field.back() == field[0];
  return quoted ? field.substr(1, field.size() - 2) : field;
}

bool is_word(std::string_view field, std::string_view word) {
  return std::equal(field.begin(), field.end(), word.begin(), word.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

bool separates(char c, Separator separator) {
  return separator == Separator::blanks ? is_blank(c) : c == static_cast<char>(separator);
}

// Where the field ends that begins at `at`: at a separator that is not in quotes.
size_t field_end(std::string_view line, size_t at, Separator separator) {
  char quote = 0;
  for (; at < line.size(); ++at) {
    const char c = line[at];
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"') {
      quote = c;
    } else if (separates(c, separator)) {
      break;
    }
  }
  return at;
}

}  // namespace

Separator separator_of(std::string_view line) {
  const auto has = [&](Separator separator) { return field_end(line, 0, separator) < line.size(); };
  if (has(Separator::semicolon)) return Separator::semicolon;
  if (has(Separator::comma)) return Separator::comma;
  const bool spaces = line.find(' ') != line.npos;
  return has(Separator::tab) && !spaces ? Separator::tab : Separator::blanks;
}

size_t Fields::without_last_empty() const {
  const bool empty = count > 1 && count <= kMaxFields && text[count - 1].empty();
  return empty ? count - 1 : count;
}

Fields split(std::string_view line, Separator separator) {
  Fields fields;
  size_t at = 0;
  for (;;) {
    if (separator == Separator::blanks) {
      while (at < line.size() && separates(line[at], separator)) ++at;
      if (at == line.size()) return fields;
    }
    if (fields.count == kMaxFields) return ++fields.count, fields;
    const size_t end = field_end(line, at, separator);
    fields.text[fields.count++] = unquoted(trimmed(line.substr(at, end - at)));
    if (end == line.size()) return fields;
    at = end + 1;
  }
}

bool is_blank_or_comment(std::string_view line) {
  if (!line.empty() && line.front() >= '0' && line.front() <= '9') return false;
  return line.starts_with('#') || line.find_first_not_of(" \t,;\r") == line.npos;
}

PolarityField polarity_field(std::string_view field) {
  if (field == "1") return PolarityField::on;
  if (field == "0") return PolarityField::off;
  if (is_word(field, "true") || is_word(field, "on")) return PolarityField::on;
  if (is_word(field, "false") || is_word(field, "off")) return PolarityField::off;
  if (const auto number = whole_from(field)) {
    const auto polarity = polarity_from(*number);
    if (!polarity) return PolarityField::undefined;
    return *polarity == 1 ? PolarityField::on : PolarityField::off;
  }
  const bool number =
      is_decimal(field) || is_word(field, "nan") || is_word(field, "inf") || is_word(field, "-inf");
  return number ? PolarityField::undefined : PolarityField::none;
}

TextLayout::TextLayout(const std::vector<Column>& columns, Separator separator, int exponent,
                       std::string camera)
    : count_(columns.size()),
      t_(place_of(Column::t, columns)),
      x_(place_of(Column::x, columns)),
      y_(place_of(Column::y, columns)),
      p_(place_of(Column::p, columns)),
      separator_(separator),
      exponent_(exponent),
      camera_(std::move(camera)) {
  const size_t place = place_of(Column::camera, columns);
  if (place < count_) camera_column_ = place;
}

TextLayout::Line TextLayout::parse(std::string_view line) const {
  if (is_blank_or_comment(line)) return {Line::blank, {}};
  const Fields fields = split(line, separator_);
  if (fields.count != count_ && fields.without_last_empty() != count_) return {};
  if (count_ > kMaxFields) return {};
  const auto t = microseconds_from(fields.text[t_], exponent_);
  const auto x = whole_from(fields.text[x_]);
  const auto y = whole_from(fields.text[y_]);
  const PolarityField p = polarity_field(fields.text[p_]);
  if (!t || !x || !y || p == PolarityField::none) return {};
  if (camera_column_ && fields.text[*camera_column_] != camera_) return {Line::blank, {}};
  if (p == PolarityField::undefined) return {Line::undefined, {}};
  const auto fits = [](int64_t v) { return v >= 0 && v <= std::numeric_limits<uint16_t>::max(); };
  if (!fits(*x) || !fits(*y)) return {Line::outside, {*t}};
  return {Line::event,
          {*t, static_cast<uint16_t>(*x), static_cast<uint16_t>(*y),
           static_cast<uint8_t>(p == PolarityField::on ? 1 : 0)}};
}

}  // namespace scarf
