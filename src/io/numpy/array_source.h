// Events out of NumPy arrays: one with named fields, one with a row per event, or one per column.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_reader.h"
#include "io/base/columns.h"
#include "io/numpy/numpy_header.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// An array, behind its header.
struct Array {
  ByteReader bytes;
  size_t row_bytes = 0;
};

/// A column of one of several arrays.
struct ArrayColumn {
  Column content = Column::skipped;
  size_t array = 0;
  size_t offset = 0;  ///< in the array's row
  NumpyType type;
};

struct EventArrays {
  std::vector<Array> arrays;
  std::vector<ArrayColumn> columns;  ///< t, x, y and p, each once
  uint64_t rows = 0;
  bool named = false;  ///< what the columns hold is told by names, not by their order
};

/// Notes the unit of times that a column's name says, if its type says none.
void add_unit(ArrayColumn& column, std::string_view name);

/// Whether the array can hold all of an event, by names or, if it has `columns` columns, by their order.
bool holds_events(const NumpyHeader& header, size_t columns);

/// Whether it could, with the right ReadOptions::columns.
bool may_hold_events(const NumpyHeader& header);

/// The columns of one array, by its names or else by ReadOptions::columns (its own order: t, x, y, p).
/// Errors: unrecognised, if no options would make events of it; bad_input, illegal_parameter.
Result<EventArrays> columns_of_array(ByteReader bytes, const NumpyHeader& header, const ReadOptions& options);

/// An array of several.
struct NamedArray {
  std::string name;
  NumpyHeader header;
  ByteReader bytes;  ///< behind the header
};

/// The columns that ReadOptions::columns names: arrays, fields of arrays ("events/ts"; of an array without a
/// name just "ts") or columns of arrays and fields ("xy[0]"). Errors: bad_input, illegal_parameter.
Result<EventArrays> columns_by_name(std::vector<NamedArray> arrays, const std::string& columns);

/// Errors: bad_input, if the array is in column order (Fortran), naming what to do.
Result<void> require_row_order(const NumpyHeader& header);

/// A source that calls itself `format`. Errors: io; bad_input, if the first rows contradict the order of
/// columns or leave the unit of times open; illegal_parameter.
Result<std::unique_ptr<EventSource>> open_arrays(std::string_view format, const std::string& name,
                                                 EventArrays arrays, const ReadOptions& options);

}  // namespace scarf
