// Bytes into a file, through a buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scarf/result.h"

namespace scarf {

class ByteWriter {
 public:
  /// Creates or overwrites a file. Errors: io.
  static Result<ByteWriter> create(const std::string& path);
  ~ByteWriter();
  ByteWriter(ByteWriter&& other) noexcept;
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;
  ByteWriter& operator=(ByteWriter&&) = delete;

  const std::string& path() const { return path_; }

  void append(std::string_view bytes) { buffer_.insert(buffer_.end(), bytes.begin(), bytes.end()); }
  /// A little-endian word.
  template <class Word>
  void append_word(Word word) {
    for (size_t i = 0; i < sizeof(Word); ++i) buffer_.push_back(static_cast<char>(word >> (8 * i)));
  }

  /// Writes the buffer out if it is large. Errors: io.
  Result<void> flush_if_large() { return buffer_.size() >= kLarge ? flush() : Result<void>(); }
  /// Writes the rest and closes the file. Errors: io.
  Result<void> finish();

 private:
  static constexpr size_t kLarge = 256 * 1024;

  ByteWriter(int fd, std::string path);
  Result<void> flush();

  int fd_;
  std::string path_;
  std::vector<char> buffer_;
};

}  // namespace scarf
