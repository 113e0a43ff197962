// Bytes into a file, through a buffer; the file appears when it is finished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/little_endian.h"
#include "io/files/output_files.h"
#include "scarf/core/result.h"

namespace scarf {

class ByteWriter {
 public:
  /// "-" is standard output. Errors: as OutputFile::create.
  static Result<ByteWriter> create(const std::string& path, const OutputRule& rule);

  /// The name for messages.
  const std::string& path() const { return file_.path(); }

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

  explicit ByteWriter(OutputFile file) : file_(std::move(file)) {}
  Result<void> flush();

  OutputFile file_;
  bool finished_ = false;
  std::vector<char> buffer_;
};

}  // namespace scarf
