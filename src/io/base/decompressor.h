// Compressed blocks of recordings, unpacked with Debian's libraries, of which a build may lack any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "io/base/byte_reader.h"
#include "scarf/core/result.h"

namespace scarf {

enum class Compression { none, lz4, zstd, bz2 };

/// Whether bytes begin as a Zstandard frame does.
bool looks_like_zstd(std::span<const uint8_t> bytes);

class Decompressor {
 public:
  /// Most bytes of an unpacked block; a larger one is taken for a bomb.
  static constexpr size_t kLimit = size_t{256} << 20;

  /// Errors: bad_input, naming the library and the Debian package that this build lacks.
  static Result<Decompressor> make(Compression compression);

  Decompressor(Decompressor&&) noexcept;
  Decompressor& operator=(Decompressor&&) noexcept;
  ~Decompressor();

  /// Unpacks one block: LZ4 frames, Zstandard frames or a bzip2 stream. The bytes live until the next call
  /// (without compression they are `packed` itself). Errors: bad_input, saying what is wrong with the block.
  Result<std::span<const uint8_t>> unpack(std::span<const uint8_t> packed);

  /// A whole file of frames, unpacked as it is read; memory does not depend on its length. It is broken, too,
  /// if it unpacks to more than 64 MiB and 1,000 times its size. Errors: as make.
  static Result<ByteReader> unpack_file(Compression compression, ByteReader packed);

  class Codec;

 private:
  explicit Decompressor(std::unique_ptr<Codec> codec);

  std::unique_ptr<Codec> codec_;  // none: the blocks are not compressed
  std::vector<uint8_t> unpacked_;
};

}  // namespace scarf
