// How events lie in HDF5 files: one table.
// Sources: prophesee-ai/openeb (hdf5_event_file), daniilidis-group/mvsec and m3ed, uzh-rpg/DSEC and RVT,
// TimoStoff/event_utils.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/columns.h"
#include "io/hdf5/dataset.h"
#include "io/hdf5/family.h"
#include "io/hdf5/library.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

enum class Shape {
  columns,   ///< a dataset for each of x, y, t, p
  array,     ///< one dataset of rows of four numbers
  compound,  ///< one dataset of records
};

struct Layout {
  Family family;
  Shape shape;
  /// The group of the columns with a / behind it, or the dataset. A * in it stands for the stream.
  std::string_view place;
  /// Of x, y, t and p: the names of columns or members; of arrays, one character each, in the order of the
  /// columns (none: --columns says).
  std::array<std::string_view, 4> names = {"x", "y", "t", "p"};
  /// A further dataset by which the family is known.
  std::string_view mark = {};
  /// Streams of which at least one is there.
  std::span<const std::string_view> streams = {};
  /// The sensor size that the file says; `place`: that of the stream.
  std::optional<SensorSize> (*sensor)(const Handle& file, const std::string& place) = nullptr;
};

/// Where the values of a field are.
struct FieldPlace {
  std::string dataset;
  std::string member = {};            ///< of records
  std::optional<size_t> column = {};  ///< of a dataset of several
  size_t columns = 0;                 ///< that the dataset has; 0: not known
};

/// Where events are.
struct EventPlaces {
  std::array<FieldPlace, 4> fields;  ///< x, y, t and p
  std::string where;                 ///< the group or the dataset
  std::optional<int> time_exponent;  ///< the unit of times as a name says it, see column_name
};

/// Which dimension counts the rows of `columns` columns (0: not known): the one that is left, or the longer
/// one. Of two that suit, the first, but for MATLAB, which writes columns one after the other.
Dataset::Across across_of(size_t columns);

/// An array with columns in this order.
EventPlaces places_of_array(const std::string& dataset, const std::vector<Column>& order);

/// Those of a layout. `columns`: ReadOptions::columns, which only arrays have a use for. Errors:
/// illegal_parameter.
Result<EventPlaces> places_of(const Layout& layout, const std::string& place, const std::string& columns);

/// What `width` and `height` beside columns say.
std::optional<SensorSize> sensor_beside(const Handle& file, const std::string& place);

/// The first layout of the family whose datasets the file has.
const Layout* find_layout(const Handle& file, Family family);

/// Layout::place with the stream put in. `wanted`: ReadOptions::stream. Errors: illegal_parameter, listing
/// the streams, if there are several and none is wanted, or another one than there is.
Result<std::string> place_of(const Handle& file, const Layout& layout, const std::string& wanted);

}  // namespace scarf::hdf5
