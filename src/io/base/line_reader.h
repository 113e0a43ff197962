// Text line by line, for lists: of bounded memory, whatever the file holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/base/byte_reader.h"
#include "scarf/core/result.h"

namespace scarf {

class LineReader {
 public:
  /// `max_line`: characters that a line may have, less than ByteReader::kCapacity.
  LineReader(ByteReader bytes, size_t max_line);
  /// A regular file. Errors: io.
  static Result<LineReader> open(const std::string& path, size_t max_line);

  /// The next line without its end, \n or \r\n; nullopt behind the last one. It lives until the next call.
  /// Errors: io; bad_input, naming the line that is too long.
  Result<std::optional<std::string_view>> next();
  /// Of the last line, from 1.
  uint64_t number() const { return number_; }

 private:
  ByteReader bytes_;
  size_t max_line_;
  size_t taken_ = 0;  // bytes of the line that was handed out
  uint64_t number_ = 0;
};

}  // namespace scarf
