#include "io/numpy/array_source.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/block_source.h"
#include "io/base/column_look.h"
#include "io/base/event_tally.h"
#include "io/base/named_columns.h"
#include "io/base/rounding.h"
#include "io/base/sensor_size.h"

namespace scarf {
namespace {

// Rows that become a block of events, and rows that are looked at before the first.
constexpr size_t kBlockRows = 4096;

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

bool is_float(const NumpyType& type) {
  return type.kind == 'f';
}

// The bytes of a number, as the lower ones of a word.
uint64_t load_word(const NumpyType& type, const uint8_t* at) {
  uint64_t word = 0;
  for (size_t i = 0; i < type.bytes; ++i) {
    word |= uint64_t{at[type.big_endian ? type.bytes - 1 - i : i]} << (8 * i);
  }
  return word;
}

double half(uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const int fraction = bits & 1023;
  double value = 0;
  if (exponent == 31) {
    value =
        fraction == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  } else {
    value = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  }
  return bits >> 15 ? -value : value;
}

double load_float(const NumpyType& type, const uint8_t* at) {
  const uint64_t word = load_word(type, at);
  if (type.bytes == 2) return half(static_cast<uint16_t>(word));
  if (type.bytes == 4) return std::bit_cast<float>(static_cast<uint32_t>(word));
  return std::bit_cast<double>(word);
}

// A whole number; nullopt if it is none or does not fit.
std::optional<int64_t> load_integer(const NumpyType& type, const uint8_t* at) {
  if (is_float(type)) {
    const double value = load_float(type, at);
    constexpr double kLimit = 9e18;
    if (!(std::abs(value) < kLimit) || value != std::floor(value)) return std::nullopt;
    return static_cast<int64_t>(value);
  }
  const uint64_t word = load_word(type, at);
  if (type.kind == 'u' || type.kind == 'b') {
    if (word > static_cast<uint64_t>(std::numeric_limits<int64_t>::max())) return std::nullopt;
    return static_cast<int64_t>(word);
  }
  const int shift = static_cast<int>(64 - 8 * type.bytes);
  return static_cast<int64_t>(word << shift) >> shift;
}

int64_t power_of_ten(int exponent) {
  int64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

// Units of 10^exponent microseconds, rounded half up; nullopt if they are too many.
std::optional<int64_t> load_time(const NumpyType& type, int exponent, const uint8_t* at) {
  const int64_t power = power_of_ten(std::abs(exponent));
  if (is_float(type)) {
    const double value = load_float(type, at);
    const auto scale = static_cast<double>(power);
    const double t = rounded(exponent >= 0 ? value * scale : value / scale);
    if (!(std::abs(t) < static_cast<double>(kMaxTime))) return std::nullopt;
    return static_cast<int64_t>(t);
  }
  const auto value = load_integer(type, at);
  if (!value || *value == std::numeric_limits<int64_t>::min()) return std::nullopt;  // NumPy: not a time
  int64_t t = 0;
  if (exponent >= 0) {
    if (std::abs(*value / 2) >= kMaxTime / power) return std::nullopt;
    t = *value * power;
  } else {
    t = rounded_quotient(*value, power);
  }
  if (t <= -kMaxTime || t >= kMaxTime) return std::nullopt;
  return t;
}

// The columns of an event, found once.
struct EventColumns {
  ArrayColumn t, x, y, p;

  explicit EventColumns(const std::vector<ArrayColumn>& columns) {
    for (const ArrayColumn& column : columns) {
      if (column.content == Column::t) t = column;
      if (column.content == Column::x) x = column;
      if (column.content == Column::y) y = column;
      if (column.content == Column::p) p = column;
    }
  }
};

const uint8_t* at_row(const std::vector<Array>& arrays, const ArrayColumn& column, size_t row) {
  const Array& array = arrays[column.array];
  return array.bytes.available().data() + row * array.row_bytes + column.offset;
}

class ArraySource final : public BlockSource {
 public:
  ArraySource(std::string_view format, const std::string& name, EventArrays arrays, int exponent,
              std::optional<SensorSize> sensor, const ReadOptions& options)
      : BlockSource(name, sensor, options),
        format_(format),
        arrays_(std::move(arrays.arrays)),
        columns_(arrays.columns),
        rows_(arrays.rows),
        exponent_(exponent) {}

  std::string_view format() const override { return format_; }
  uint64_t bytes_read() const override { return sum(&ByteReader::consumed); }
  uint64_t bytes_total() const override { return sum(&ByteReader::total); }

 protected:
  Result<bool> next(std::vector<Event>& block) override;

 private:
  enum class Row { event, outside, unknown, undefined };

  uint64_t sum(uint64_t (ByteReader::*count)() const) const {
    uint64_t bytes = 0;
    for (const Array& array : arrays_) bytes += (array.bytes.*count)();
    return bytes;
  }

  Row decode(size_t row, Event& event) const;
  void skip(size_t rows);
  void end_early();
  Result<void> end();

  std::string_view format_;
  std::vector<Array> arrays_;
  EventColumns columns_;
  uint64_t rows_;      // of the arrays
  uint64_t read_ = 0;  // of them
  int exponent_;
};

ArraySource::Row ArraySource::decode(size_t row, Event& event) const {
  const auto t = load_time(columns_.t.type, exponent_, at_row(arrays_, columns_.t, row));
  const auto x = load_integer(columns_.x.type, at_row(arrays_, columns_.x, row));
  const auto y = load_integer(columns_.y.type, at_row(arrays_, columns_.y, row));
  const auto p = load_integer(columns_.p.type, at_row(arrays_, columns_.p, row));
  if (!t || !x || !y) return Row::unknown;
  // A number that is no whole one is undefined, too.
  const auto polarity = p ? polarity_from(*p) : std::nullopt;
  if (!polarity) return Row::undefined;
  const auto fits = [](int64_t v) { return v >= 0 && v <= std::numeric_limits<uint16_t>::max(); };
  event.t = *t;
  if (!fits(*x) || !fits(*y)) return Row::outside;
  event = {*t, static_cast<uint16_t>(*x), static_cast<uint16_t>(*y), *polarity};
  return Row::event;
}

void ArraySource::skip(size_t rows) {
  for (Array& array : arrays_) array.bytes.skip(rows * array.row_bytes);
  read_ += rows;
}

// The input ends before the array does.
void ArraySource::end_early() {
  for (Array& array : arrays_) {
    const size_t rest = array.bytes.available().size();
    if (rest >= array.row_bytes) continue;
    tally_.report.truncated_bytes += rest;
    array.bytes.skip(rest);
  }
  tally_.note_damage(bytes_read(), text("the array ends after ", read_, " of ", rows_, " rows"));
}

// Behind the last row: only at its end does a member of an archive tell whether its checksum is right.
Result<void> ArraySource::end() {
  for (Array& array : arrays_) {
    uint64_t rest = 0;
    for (;;) {
      if (const auto filled = array.bytes.fill(1); !filled) {
        if (filled.error().code != ErrorCode::bad_input) return filled.error();
        tally_.note_damage(bytes_read(), filled.error().message);
        break;
      }
      const size_t more = array.bytes.available().size();
      if (more == 0) break;
      rest += more;
      array.bytes.skip(more);
    }
    if (rest > 0) tally_.note_damage(bytes_read() - rest, text(rest, " bytes follow the array's last row"));
  }
  return {};
}

Result<bool> ArraySource::next(std::vector<Event>& block) {
  if (read_ == rows_) {
    if (const auto ended = end(); !ended) return ended.error();
    return false;
  }
  size_t rows = static_cast<size_t>(std::min<uint64_t>(rows_ - read_, kBlockRows));
  for (Array& array : arrays_) {
    if (const auto filled = array.bytes.fill(array.row_bytes); !filled) {
      if (filled.error().code != ErrorCode::bad_input) return filled.error();
      tally_.note_damage(bytes_read(), filled.error().message);
      return false;
    }
    rows = std::min(rows, array.bytes.available().size() / array.row_bytes);
  }
  if (rows == 0) {
    end_early();
    return false;
  }
  for (size_t row = 0; row < rows; ++row) {
    Event event;
    const Row kind = decode(row, event);
    if (kind == Row::event) {
      block.push_back(event);
      continue;
    }
    // What is no event is counted when all events before it are handed out.
    if (row > 0) {
      skip(row);
      return true;
    }
    if (kind == Row::outside) {
      tally_.drop(event.t);
    } else if (kind == Row::undefined) {
      tally_.leave_out_polarity("row", read_);
    } else {
      ++tally_.report.unknown_words;
      if (tally_.strict()) {
        tally_.fail(bad(text("row ", read_, " is no event; leave out ReadOptions::strict to pass over it")));
      }
    }
    skip(1);
    return true;
  }
  skip(rows);
  return true;
}

// What the rows at the beginning say of one column, whose numbers lie `row_bytes` apart.
ColumnLook look_at(const uint8_t* first, size_t row_bytes, const NumpyType& type, size_t rows) {
  ColumnLook look;
  for (size_t row = 0; row < rows; ++row) {
    const uint8_t* const at = first + row * row_bytes;
    look.add(is_float(type) ? load_float(type, at) : static_cast<double>(load_integer(type, at).value_or(0)));
  }
  return look;
}

// Of an array whose columns nobody has named.
std::vector<ColumnLook> looks_of(std::span<const uint8_t> bytes, const NumpyHeader& header, size_t columns) {
  const size_t row_bytes = columns * header.item_bytes;
  const size_t rows = std::min(bytes.size() / row_bytes, kBlockRows);
  std::vector<ColumnLook> looks;
  for (size_t i = 0; i < columns; ++i) {
    looks.push_back(look_at(bytes.data() + i * header.item_bytes, row_bytes, header.fields[0].type, rows));
  }
  return looks;
}

// An array that is not what the columns say: of events in another order, or of something else.
Error other_columns(const std::vector<ColumnLook>& looks, const std::string& what) {
  const std::string order = likely_order(looks);
  if (order.empty()) {
    return {
        ErrorCode::unrecognised,
        text(what,
             "; if it holds events, name the order of the columns with ReadOptions::columns, such as xytp, "
             "with _ for columns to skip")};
  }
  return bad(text(what,
                  "; name the order of the columns with ReadOptions::columns; the first rows would allow "
                  "ReadOptions::columns ",
                  order));
}

Result<int> unit_of_times(const EventArrays& arrays, size_t rows, const ReadOptions& options) {
  const EventColumns columns(arrays.columns);
  const auto given = time_exponent_from(options.time_unit);
  if (!given) return given.error();
  if (*given) return **given;
  if (!columns.t.type.unit.empty()) {
    const auto own = time_exponent_from(columns.t.type.unit);
    if (!own) return bad(own.error().message);
    return own->value_or(0);
  }
  if (!is_float(columns.t.type)) return 0;
  const Array& array = arrays.arrays[columns.t.array];
  const ColumnLook look =
      look_at(array.bytes.available().data() + columns.t.offset, array.row_bytes, columns.t.type, rows);
  if (!look.has_fractions() && !look.is_zero()) {
    return bad(
        "the times are floating-point numbers without fractions, so that seconds and microseconds look "
        "alike; name the unit with ReadOptions::time_unit");
  }
  return 6;
}

// The unit that a column's name says, as NumpyType::unit.
std::string_view unit_named(const ColumnName& name) {
  switch (name.time_exponent.value_or(1)) {
    case 6:
      return "s";
    case 3:
      return "ms";
    case 0:
      return "us";
    case -3:
      return "ns";
    default:
      return "";
  }
}

// The numbers of a row, if there are as many as columns; 0 if they are not all of one event each.
size_t columns_in_row(const NumpyHeader& header) {
  if (header.named || header.shape.size() != 2 || !is_number(header.fields[0].type)) return 0;
  return static_cast<size_t>(std::min<uint64_t>(header.shape[1], 1 << 16));
}

std::vector<ArrayColumn> known_columns(const NumpyHeader& header) {
  std::vector<ArrayColumn> columns;
  for (const NumpyField& field : header.fields) {
    const ColumnName name = column_name(field.name);
    const bool usable = name.column != Column::skipped && name.column != Column::camera;
    if (usable && field.count == 1 && is_number(field.type)) {
      columns.push_back({name.column, 0, field.offset, field.type});
      add_unit(columns.back(), field.name);
    }
  }
  return columns;
}

bool are_complete(const std::vector<ArrayColumn>& columns) {
  std::vector<Column> contents;
  for (const ArrayColumn& column : columns) contents.push_back(column.content);
  return scarf::are_complete(contents);
}

}  // namespace

void add_unit(ArrayColumn& column, std::string_view name) {
  if (column.content == Column::t && column.type.unit.empty()) {
    column.type.unit = unit_named(column_name(name));
  }
}

bool holds_events(const NumpyHeader& header, size_t columns) {
  if (header.named) return header.shape.size() == 1 && are_complete(known_columns(header));
  return columns_in_row(header) == columns;
}

bool may_hold_events(const NumpyHeader& header) {
  return header.named ? holds_events(header, 0) : columns_in_row(header) >= 4;
}

Result<void> require_row_order(const NumpyHeader& header) {
  if (!header.fortran_order || header.shape.size() < 2) return {};
  return bad(
      "the array is stored column by column (Fortran order); save it row by row, with "
      "numpy.ascontiguousarray");
}

Result<EventArrays> columns_of_array(ByteReader bytes, const NumpyHeader& header,
                                     const ReadOptions& options) {
  if (names_columns(options.columns)) {
    std::vector<NamedArray> arrays;
    arrays.push_back({"", header, std::move(bytes)});
    return columns_by_name(std::move(arrays), options.columns);
  }
  EventArrays events;
  events.named = header.named;
  events.rows = header.shape.empty() ? 0 : header.shape[0];
  size_t row_bytes = header.item_bytes;
  if (header.named) {
    if (!options.columns.empty()) {
      return Error{ErrorCode::illegal_parameter,
                   "the array names its columns; leave ReadOptions::columns out, or name fields, such as "
                   "t=ts,x=x,y=y,p=on"};
    }
    events.columns = known_columns(header);
    if (!holds_events(header, 0)) {
      return Error{ErrorCode::unrecognised,
                   "the array's fields are not one each for t, x, y and p; rename them, or name them with "
                   "ReadOptions::columns, "
                   "such as t=ts,x=x,y=y,p=on"};
    }
  } else {
    const auto columns = columns_from(options.columns.empty() ? "txyp" : options.columns);
    if (!columns) return columns.error();
    if (std::find(columns->begin(), columns->end(), Column::camera) != columns->end()) {
      return Error{ErrorCode::illegal_parameter, "arrays have no column of cameras: use _ instead of c"};
    }
    const size_t found = columns_in_row(header);
    if (!may_hold_events(header)) {
      return Error{ErrorCode::unrecognised,
                   "the array has neither named fields nor a row of four numbers or more per event"};
    }
    if (auto r = require_row_order(header); !r) return r.error();
    // The first rows decide, where nobody has named the columns.
    const size_t bytes_wanted = std::min(kBlockRows * found * header.item_bytes, ByteReader::kCapacity);
    const auto filled = bytes.fill(bytes_wanted);
    if (!filled && filled.error().code != ErrorCode::bad_input) return filled.error();
    const auto looks = looks_of(bytes.available(), header, found);
    if (found != columns->size()) {
      return other_columns(looks, text("the array has ", found, " columns, not ", columns->size()));
    }
    const bool any = bytes.available().size() >= found * header.item_bytes;
    if (options.columns.empty() && any && !(allows(looks, *columns) && has_times(looks, *columns))) {
      return other_columns(looks, "the first rows do not read as t, x, y, p");
    }
    for (size_t i = 0; i < found; ++i) {
      if ((*columns)[i] == Column::skipped) continue;
      events.columns.push_back({(*columns)[i], 0, i * header.item_bytes, header.fields[0].type});
    }
    row_bytes *= found;
  }
  if (row_bytes > ByteReader::kCapacity) return bad("the array's rows are too long");
  events.arrays.push_back({std::move(bytes), row_bytes});
  return events;
}

namespace {

// What may be named in an array, for messages.
std::string columns_in(const NamedArray& array) {
  if (!array.header.named) return array.name.empty() ? "[0] and so on" : array.name;
  std::string list;
  for (const NumpyField& field : array.header.fields) {
    if (field.name.empty()) continue;
    list += text(list.empty() ? "" : ", ", array.name, array.name.empty() ? "" : "/", field.name);
  }
  return list;
}

// The name of a field within the array that a name is of, empty for the array itself; nullopt: of another.
std::optional<std::string_view> field_in(const NamedArray& array, std::string_view name) {
  if (name == array.name) return std::string_view();
  if (array.name.empty()) return name;
  if (!name.starts_with(array.name) || name[array.name.size()] != '/') return std::nullopt;
  return name.substr(array.name.size() + 1);
}

Result<ArrayColumn> column_in(const NamedArray& array, std::string_view field, std::optional<size_t> index) {
  const NumpyHeader& header = array.header;
  const std::string what = array.name.empty() ? "the array" : text("the array ", array.name);
  if (auto r = require_row_order(header); !r) return r.error();
  const auto found = std::find_if(header.fields.begin(), header.fields.end(),
                                  [&](const NumpyField& f) { return f.name == field; });
  const bool rows = header.shape.size() == 1 || (header.shape.size() == 2 && !header.named);
  if (found == header.fields.end() || header.named == field.empty() || !rows || !is_number(found->type)) {
    return bad(text(what, " has no column of numbers", field.empty() ? "" : " called ", field, "; there are ",
                    columns_in(array)));
  }
  const uint64_t columns = header.named ? found->count : header.shape.size() == 2 ? header.shape[1] : 1;
  if ((columns != 1 && !index) || index.value_or(0) >= columns) {
    return bad(text(what, field.empty() ? "" : ", field ", field, ", has ", columns,
                    " columns; name one by its number, such as ", array.name, field, "[0]"));
  }
  const size_t bytes = found->type.bytes;
  return ArrayColumn{Column::skipped, 0, found->offset + index.value_or(0) * bytes, found->type};
}

}  // namespace

Result<EventArrays> columns_by_name(std::vector<NamedArray> arrays, const std::string& columns) {
  const auto named = named_columns_from(columns);
  if (!named) return named.error();
  EventArrays events;
  events.named = true;
  std::vector<size_t> taken;  // of `arrays`, in the order of events.arrays
  for (size_t i = 0; i < named->size(); ++i) {
    constexpr Column kOrder[] = {Column::t, Column::x, Column::y, Column::p};
    const NamedColumn& wanted = (*named)[i];
    const auto array = std::find_if(arrays.begin(), arrays.end(), [&](const NamedArray& a) {
      return field_in(a, wanted.name).has_value();
    });
    if (array == arrays.end()) {
      std::string list;
      for (const NamedArray& a : arrays) list += text(list.empty() ? "" : ", ", columns_in(a));
      return bad(text("there is no array or field ", wanted.name, "; there are ", list));
    }
    auto column = column_in(*array, *field_in(*array, wanted.name), wanted.index);
    if (!column) return column.error();
    const auto number = static_cast<size_t>(array - arrays.begin());
    const auto before = std::find(taken.begin(), taken.end(), number);
    column->array = static_cast<size_t>(before - taken.begin());
    column->content = kOrder[i];
    add_unit(*column, wanted.name.substr(wanted.name.rfind('/') + 1));
    if (before == taken.end()) taken.push_back(number);
    events.columns.push_back(*std::move(column));
  }
  events.rows = arrays[taken[0]].header.shape[0];
  for (const size_t number : taken) {
    NamedArray& array = arrays[number];
    const std::vector<uint64_t>& shape = array.header.shape;
    if (shape[0] != events.rows) {
      return bad(text("the columns have different lengths: ", arrays[taken[0]].name, " ", events.rows, ", ",
                      array.name, " ", shape[0]));
    }
    const uint64_t columns_of_row = shape.size() == 2 ? shape[1] : 1;
    if (columns_of_row > ByteReader::kCapacity / std::max<size_t>(array.header.item_bytes, 1)) {
      return bad("the array's rows are too long");
    }
    events.arrays.push_back(
        {std::move(array.bytes), array.header.item_bytes * static_cast<size_t>(columns_of_row)});
  }
  return events;
}

Result<std::unique_ptr<EventSource>> open_arrays(std::string_view format, const std::string& name,
                                                 EventArrays arrays, const ReadOptions& options) {
  const auto sensor = agreed_sensor(std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  size_t rows = static_cast<size_t>(std::min<uint64_t>(arrays.rows, kBlockRows));
  for (Array& array : arrays.arrays) {
    const size_t bytes = std::min(rows * array.row_bytes, ByteReader::kCapacity);
    // What is broken here is met again, and reported, by reading.
    const auto filled = array.bytes.fill(bytes);
    if (!filled && filled.error().code != ErrorCode::bad_input) return filled.error();
    rows = std::min(rows, array.bytes.available().size() / array.row_bytes);
  }
  const auto exponent = unit_of_times(arrays, rows, options);
  if (!exponent) return exponent.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<ArraySource>(format, name, std::move(arrays), *exponent, *sensor, options));
}

}  // namespace scarf
