// NumPy arrays on disk that grow row by row.
// Source: NumPy, "NEP 1: A simple file format for NumPy arrays", version 1.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/byte_writer.h"
#include "scarf/result.h"

namespace scarf::tools {

class NpyFile {
 public:
  /// `type`: of an element, as NumPy writes it, such as "<f4" or "|u1". `row`: shape of one row, empty for
  /// numbers. Errors: io.
  static Result<NpyFile> create(const std::string& path, std::string type, std::vector<size_t> row);

  /// Whole rows, row-major, little-endian. Errors: io.
  template <class T>
  Result<void> append(std::span<const T> values) {
    return append_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  uint64_t bytes() const { return bytes_; }
  /// Writes the number of rows and puts the file in its place; without it there is none. Errors: io.
  Result<void> finish();

 private:
  NpyFile(ByteWriter file, std::string type, std::vector<size_t> row);
  Result<void> append_bytes(std::span<const char> bytes);
  std::string header(uint64_t rows) const;

  std::string type_;
  std::vector<size_t> row_;
  std::unique_ptr<ByteWriter> file_;
  uint64_t bytes_ = 0;  // of the rows
};

}  // namespace scarf::tools
