// Bytes into a file, through a buffer; the file appears when it is finished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/little_endian.h"
#include "io/atomic_file.h"
#include "scarf/result.h"

namespace scarf {

class ByteWriter {
 public:
  /// Creates or replaces a file; "-" is standard output. Errors: io.
  static Result<ByteWriter> create(const std::string& path);
  ~ByteWriter();
  ByteWriter(ByteWriter&& other) noexcept;
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;
  ByteWriter& operator=(ByteWriter&&) = delete;

  /// The name for messages.
  const std::string& path() const { return path_; }

  void append(std::string_view bytes) { buffer_.insert(buffer_.end(), bytes.begin(), bytes.end()); }
  /// A little-endian word.
  template <class Word>
  void append_word(Word word) {
    append_little_endian(buffer_, word);
  }

  /// Writes the buffer out if it is large. Errors: io.
  Result<void> flush_if_large() { return buffer_.size() >= kLarge ? flush() : Result<void>(); }
  /// Writes everything so far and replaces bytes of it, which are there. Errors: io, for pipes too.
  Result<void> overwrite(uint64_t offset, std::string_view bytes);
  /// Writes the rest, closes the file and puts it in its place. Errors: io.
  Result<void> finish();

 private:
  static constexpr size_t kLarge = 256 * 1024;

  ByteWriter(int fd, std::string path, std::unique_ptr<AtomicFile> file);
  static Result<ByteWriter> standard_output();
  Result<void> flush();

  int fd_;
  std::string path_;
  std::unique_ptr<AtomicFile> file_;  // none: standard output
  std::vector<char> buffer_;
};

}  // namespace scarf
