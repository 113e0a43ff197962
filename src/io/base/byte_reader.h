// Bytes of a file, a pipe or memory, through a buffer of bounded size; never seeks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "scarf/core/result.h"

namespace scarf {

class ByteReader {
 public:
  /// Reads some bytes into the span, at least one unless the input has ended. Errors: io; bad_input once, for
  /// compressed data that is broken, behind which the input has ended.
  using ReadSome = std::function<Result<size_t>(std::span<uint8_t>)>;

  /// Most bytes that available() can hold.
  static constexpr size_t kCapacity = 256 * 1024;

  /// `total`: size of the input in bytes, 0 if unknown.
  ByteReader(ReadSome read_some, uint64_t total);
  /// A file; "-" is standard input. Errors: io.
  static Result<ByteReader> open(const std::string& path);
  /// A regular file: where nobody means a pipe, none may make the program wait. Errors: io.
  static Result<ByteReader> open_regular(const std::string& path);
  /// Memory that outlives the reader.
  static ByteReader over(std::span<const uint8_t> bytes);

  using Seen = std::function<void(std::span<const uint8_t>)>;
  /// `seen` gets all bytes that are read from now on, in order and each once.
  void observe(Seen seen);

  /// The bytes read and not yet skipped.
  std::span<const uint8_t> available() const { return {buffer_.get() + begin_, end_ - begin_}; }
  /// Whether the input holds nothing behind available().
  bool ended() const { return ended_; }
  /// One read: returns as soon as a pipe has something. available() must be shorter than kCapacity.
  Result<void> refill();
  /// Reads until available() holds `count` bytes (at most kCapacity) or the input ends.
  Result<void> fill(size_t count);
  void skip(size_t count);

  uint64_t consumed() const { return consumed_; }
  uint64_t total() const { return total_; }

 private:
  class Descriptor;
  static Result<ByteReader> over_descriptor(std::shared_ptr<const Descriptor> file);

  ReadSome read_some_;
  size_t capacity_;  // of the buffer, which is only as large as the input needs
  std::unique_ptr<uint8_t[]> buffer_;
  size_t begin_ = 0;
  size_t end_ = 0;
  bool ended_ = false;
  uint64_t consumed_ = 0;
  uint64_t total_ = 0;
};

}  // namespace scarf
