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

#include "io/hdf5/family.h"
#include "io/hdf5/library.h"
#include "scarf/event.h"
#include "scarf/result.h"

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

/// The first layout of the family whose datasets the file has.
const Layout* find_layout(const Handle& file, Family family);

/// Layout::place with the stream put in. `wanted`: ReadOptions::stream. Errors: illegal_parameter, listing
/// the streams, if there are several and none is wanted, or another one than there is.
Result<std::string> place_of(const Handle& file, const Layout& layout, const std::string& wanted);

/// The dataset of field `i` (0 to 3: x, y, t, p).
std::string dataset_of(const Layout& layout, const std::string& place, size_t i);

}  // namespace scarf::hdf5
