// A dataset that is read row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/library.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf::hdf5 {

/// Chunks that lie side by side and have more bytes than this are refused, so that memory does not depend on
/// what a file says.
inline constexpr uint64_t kMaxChunkBytes = uint64_t{64} << 20;

class Dataset {
 public:
  /// Whether there is a dataset of this name in the file itself.
  static bool exists(const Handle& file, const std::string& path);
  /// Errors: bad_input: none of this name, more than three dimensions or none, data in other files, chunks
  /// that are too large, a filter that is not installed. Chunks whose only filter is ECF come as they are.
  /// `across` says of two dimensions whether the second one counts the rows, as MATLAB writes columns; none:
  /// the first always does.
  using Across = std::function<bool(const std::vector<hsize_t>& shape, bool by_matlab)>;
  static Result<Dataset> open(const Handle& file, const std::string& path, const Across& across = {});

  const std::string& path() const { return path_; }
  hid_t id() const { return dataset_.id(); }
  uint64_t rows() const { return shape_[axis_]; }
  /// Whether the second dimension counts the rows: read() then gives column after column.
  bool across() const { return axis_ == 1; }
  /// All dimensions.
  const std::vector<hsize_t>& shape() const { return shape_; }
  /// Values of a row.
  uint64_t row_values() const;
  /// The file's type of a value; owned by the caller.
  Handle type() const {
    const Turn turn;
    return Handle(H5Dget_type(dataset_.id()));
  }
  bool ecf() const { return ecf_; }

  /// The first row behind the chunk that holds `row`; rows() if there are no chunks.
  uint64_t chunk_end(uint64_t row) const;
  /// The rows from `first` on, all their values. Errors: bad_input.
  Result<void> read(uint64_t first, uint64_t count, hid_t memory_type, void* out) const;
  /// The stored bytes of the chunk that begins with row `first`, in place of what `bytes` held; `filtered`:
  /// they are compressed. Errors: bad_input.
  Result<void> read_chunk(uint64_t first, std::vector<uint8_t>& bytes, bool& filtered) const;
  /// Whether all chunks of these rows were written.
  bool written(uint64_t first, uint64_t count) const;
  /// Where the chunk with that row lies in the file; 0 if that is not known.
  uint64_t byte_of(uint64_t row) const;

 private:
  Result<void> look_at_layout(const Across& across);
  Result<void> check_chunks(uint64_t first, uint64_t count) const;
  // The stored size of each chunk of these rows.
  template <class Use>
  void for_each_chunk(uint64_t first, uint64_t count, Use use) const;

  Handle dataset_;
  std::string path_;
  std::vector<hsize_t> shape_;
  size_t axis_ = 0;             // the dimension that counts the rows
  std::vector<hsize_t> chunk_;  // empty: not in chunks
  uint64_t chunk_bytes_ = 0;    // when decompressed
  uint64_t cache_bytes_ = 0;
  bool ecf_ = false;
  bool compressed_ = false;
};

/// A few whole numbers that a file says once: a scalar or short dataset, or an attribute of the root. nullopt
/// if there is none, or not of numbers, or more than 8.
std::optional<std::vector<int64_t>> short_dataset(const Handle& file, const std::string& path);
std::optional<std::vector<int64_t>> root_attribute(const Handle& file, const std::string& name);
/// An attribute of the root that is text.
std::optional<std::string> root_text(const Handle& file, const std::string& name);

}  // namespace scarf::hdf5
