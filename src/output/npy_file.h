// NumPy arrays on disk that grow row by row.
// Source: NumPy, "NEP 1: A simple file format for NumPy arrays", version 1.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/files/byte_writer.h"
#include "scarf/core/result.h"

namespace scarf {

class NpyFile {
 public:
  /// `type`: of an element, as NumPy writes it, such as "<f4" or "|u1". `row`: shape of one row, empty for
  /// numbers. Errors: as OutputFile::create.
  static Result<NpyFile> create(const std::string& path, std::string type, std::vector<size_t> row,
                                const OutputRule& rule);

  /// Whole rows, row-major, little-endian. Errors: io.
  template <class T>
  Result<void> append(std::span<const T> values) {
    return append_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  uint64_t bytes() const { return bytes_; }
  /// Writes the number of rows and puts the file in its place; without it there is none. Errors: io.
  Result<void> finish();

 private:
  NpyFile(ByteWriter file, std::string type, std::vector<size_t> row)
      : file_(std::move(file)), type_(std::move(type)), row_(std::move(row)) {}
  Result<void> append_bytes(std::string_view bytes);
  std::string header(uint64_t rows) const;

  ByteWriter file_;
  std::string type_;
  std::vector<size_t> row_;
  uint64_t bytes_ = 0;  // of the rows
};

}  // namespace scarf
