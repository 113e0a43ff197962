// The datasets that together hold the events of a file, read in blocks of rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/hdf5/dataset.h"
#include "io/hdf5/layouts.h"
#include "io/hdf5/number_type.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf::hdf5 {

/// Where reading failed.
struct BrokenRows {
  uint64_t end = 0;   ///< the first row behind the broken chunk
  uint64_t byte = 0;  ///< of the file
  std::string what;
};

class EventTable {
 public:
  enum Field { x, y, t, p };

  /// Errors: bad_input.
  static Result<EventTable> open(const Handle& file, const EventPlaces& places);

  /// Rows that all datasets have.
  uint64_t rows() const { return rows_; }
  /// Set if the datasets do not have the same number of rows.
  const std::optional<std::string>& disagreement() const { return disagreement_; }
  NumberType time_type() const { return fields_[t].type; }

  /// The end of the first chunk of any dataset that ends behind `row`.
  uint64_t chunk_end(uint64_t row) const;
  /// Whether rows are to be read chunk by chunk.
  bool by_chunk() const { return parts_.front().dataset.ecf(); }
  /// Reads rows; they stay until the next call. What failed, else nullopt.
  std::optional<BrokenRows> read(uint64_t first, size_t count);
  /// Whether all chunks of these rows were written.
  bool written(uint64_t first, uint64_t count) const;

  /// A field of the rows read.
  Numbers numbers(Field field) const;
  /// The rows read, of a file that is read by chunk: it has whole events.
  std::vector<Event>& events() { return events_; }

 private:
  struct Part {
    Dataset dataset;
    Handle record;  // of records: their type in memory
    hid_t type = H5I_INVALID_HID;
    size_t row_bytes = 0;
    std::vector<uint8_t> rows;
  };
  struct Place {
    size_t part = 0;
    size_t offset = 0;  // in the row; across rows, of the column's first value if the rows read were one
    NumberType type = NumberType::u8;
  };

  using Fields = std::vector<std::pair<size_t, const FieldPlace*>>;  // of one dataset, with their numbers

  Result<void> open_part(const Handle& file, const Fields& fields);
  Result<void> add_numbers(Dataset dataset, const Fields& fields);
  Result<void> add_records(Dataset dataset, const Fields& fields);
  void compare_rows();
  Result<void> read_ecf(const Part& part, uint64_t first, size_t count);

  std::vector<Part> parts_;
  size_t count_ = 0;  // rows read
  std::array<Place, 4> fields_;
  uint64_t rows_ = 0;
  std::optional<std::string> disagreement_;
  std::vector<uint8_t> chunk_;
  std::vector<Event> events_;
};

}  // namespace scarf::hdf5
