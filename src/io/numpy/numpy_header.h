// The header of a NumPy array file (.npy).
// Source: NumPy, "NEP 1: A simple file format for NumPy arrays", versions 1 to 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_reader.h"
#include "scarf/core/result.h"

namespace scarf {

/// A number of an array.
struct NumpyType {
  char kind = 'V';  ///< b, i, u, f; m and M (times, as integers); all else is no number
  size_t bytes = 0;
  bool big_endian = false;
  std::string unit = {};  ///< of m and M, such as "us"
};

/// Whether it is one that a column of events can have.
bool is_number(const NumpyType& type);

struct NumpyField {
  std::string name;  ///< empty for padding
  NumpyType type;
  size_t count = 1;   ///< of numbers; more for arrays within the field
  size_t offset = 0;  ///< in the item
};

struct NumpyHeader {
  std::vector<NumpyField> fields;  ///< one without a name, unless the array has named fields
  bool named = false;
  size_t item_bytes = 0;
  bool fortran_order = false;
  std::vector<uint64_t> shape;
};

inline constexpr std::string_view kNumpyMagic = "\x93NUMPY";

/// A header of `size` bytes in version 1 for items of `type` and a `shape`, both as Python writes them, such
/// as
/// "'<f4'" and "(3, 2)"; padded, so that the shape can be written again when it is known.
std::string numpy_header_text(std::string_view type, std::string_view shape, size_t size);

/// Takes the header off the front. Errors: io; bad_input, for a header that is none or describes items of
/// more than 64 KiB.
Result<NumpyHeader> read_numpy_header(ByteReader& bytes);

}  // namespace scarf
