#include "io/base/decompressor.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/text.h"

#ifdef SCARF_HAS_LZ4
#include <lz4frame.h>
#endif
#ifdef SCARF_HAS_ZSTD
#include <zstd.h>
#endif
#ifdef SCARF_HAS_BZ2
#include <bzlib.h>
#endif

namespace scarf {

/// A library's way to unpack a block piece by piece.
class Decompressor::Codec {
 public:
  struct Step {
    size_t taken = 0;
    size_t given = 0;
    bool whole = false;   ///< a frame ended here
    bool broken = false;  ///< these are no bytes of the format
  };

  virtual ~Codec() = default;
  /// Before each block.
  virtual void restart() = 0;
  virtual Step step(std::span<const uint8_t> in, std::span<uint8_t> out) = 0;
};

namespace {

using Codec = Decompressor::Codec;

#ifdef SCARF_HAS_LZ4
class Lz4Codec final : public Codec {
 public:
  Lz4Codec() {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION))) context_ = nullptr;
  }
  ~Lz4Codec() override { LZ4F_freeDecompressionContext(context_); }
  Lz4Codec(const Lz4Codec&) = delete;
  Lz4Codec& operator=(const Lz4Codec&) = delete;

  void restart() override {
    if (context_ != nullptr) LZ4F_resetDecompressionContext(context_);
  }
  Step step(std::span<const uint8_t> in, std::span<uint8_t> out) override {
    if (context_ == nullptr) return {.broken = true};
    size_t taken = in.size();
    size_t given = out.size();
    const size_t left = LZ4F_decompress(context_, out.data(), &given, in.data(), &taken, nullptr);
    return {taken, given, left == 0, LZ4F_isError(left) != 0};
  }

 private:
  LZ4F_dctx* context_ = nullptr;
};
#endif

#ifdef SCARF_HAS_ZSTD
class ZstdCodec final : public Codec {
 public:
  ZstdCodec() : context_(ZSTD_createDCtx()) {}
  ~ZstdCodec() override { ZSTD_freeDCtx(context_); }
  ZstdCodec(const ZstdCodec&) = delete;
  ZstdCodec& operator=(const ZstdCodec&) = delete;

  void restart() override { ZSTD_DCtx_reset(context_, ZSTD_reset_session_only); }
  Step step(std::span<const uint8_t> in, std::span<uint8_t> out) override {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer to{out.data(), out.size(), 0};
    const size_t left = ZSTD_decompressStream(context_, &to, &from);
    return {from.pos, to.pos, left == 0, ZSTD_isError(left) != 0};
  }

 private:
  ZSTD_DCtx* context_;
};
#endif

#ifdef SCARF_HAS_BZ2
class Bz2Codec final : public Codec {
 public:
  Bz2Codec() = default;
  ~Bz2Codec() override { BZ2_bzDecompressEnd(&stream_); }
  Bz2Codec(const Bz2Codec&) = delete;
  Bz2Codec& operator=(const Bz2Codec&) = delete;

  void restart() override {
    BZ2_bzDecompressEnd(&stream_);
    stream_ = {};
    ready_ = BZ2_bzDecompressInit(&stream_, /*verbosity=*/0, /*small=*/0) == BZ_OK;
  }
  Step step(std::span<const uint8_t> in, std::span<uint8_t> out) override {
    if (!ready_) return {.broken = true};
    constexpr size_t kMost = size_t{1} << 30;  // its lengths have 32 bits
    const auto in_size = static_cast<unsigned>(std::min(in.size(), kMost));
    const auto out_size = static_cast<unsigned>(std::min(out.size(), kMost));
    stream_.next_in = const_cast<char*>(reinterpret_cast<const char*>(in.data()));  // NOLINT: it only reads
    stream_.avail_in = in_size;
    stream_.next_out = reinterpret_cast<char*>(out.data());
    stream_.avail_out = out_size;
    const int state = BZ2_bzDecompress(&stream_);
    const Step step{in_size - stream_.avail_in, out_size - stream_.avail_out, state == BZ_STREAM_END,
                    state != BZ_OK && state != BZ_STREAM_END};
    if (step.whole) restart();
    return step;
  }

 private:
  bz_stream stream_{};
  bool ready_ = false;
};
#endif

[[maybe_unused]] Error lacking(std::string_view compression, std::string_view library) {
  return {ErrorCode::bad_input,
          text("its blocks are compressed with ", compression, ", and this build of scarf has no ", library,
               "; install it and build again")};
}

Error broken(std::string what) {
  return {ErrorCode::bad_input, std::move(what)};
}

}  // namespace

bool looks_like_zstd(std::span<const uint8_t> bytes) {
  constexpr uint8_t kMagic[] = {0x28, 0xB5, 0x2F, 0xFD};
  return bytes.size() >= std::size(kMagic) && std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin());
}

namespace {

// A file of frames that is read as its unpacked bytes.
class PackedFile {
 public:
  PackedFile(std::unique_ptr<Codec> codec, ByteReader packed)
      : codec_(std::move(codec)), packed_(std::move(packed)) {
    codec_->restart();
  }

  Result<size_t> read_some(std::span<uint8_t> out) {
    for (;;) {
      if (const auto filled = packed_.fill(1); !filled) return filled.error();
      const auto bytes = packed_.available();
      if (bytes.empty() && whole_) return size_t{0};
      if (bytes.empty() && ended_) return broken("the compressed bytes end too early");
      ended_ = bytes.empty();
      const auto step = codec_->step(bytes, out);
      if (step.broken) return broken("the compressed bytes are damaged");
      packed_.skip(step.taken);
      whole_ = step.whole;
      given_ += step.given;
      if (given_ > kFreeBytes && given_ / kMaxRatio > packed_.consumed()) {
        return broken(text("unpacks to more than ", kMaxRatio, " times its size"));
      }
      if (step.given > 0) return step.given;
    }
  }

 private:
  static constexpr uint64_t kFreeBytes = uint64_t{64} << 20;
  static constexpr uint64_t kMaxRatio = 1000;

  std::unique_ptr<Codec> codec_;
  ByteReader packed_;
  bool whole_ = false;  // a frame ended here
  bool ended_ = false;  // nothing was left when the codec was asked last
  uint64_t given_ = 0;
};

}  // namespace

Result<ByteReader> Decompressor::unpack_file(Compression compression, ByteReader packed) {
  auto made = make(compression);
  if (!made) return made.error();
  if (!made->codec_) return packed;
  const auto file = std::make_shared<PackedFile>(std::move(made->codec_), std::move(packed));
  return ByteReader([file](std::span<uint8_t> out) { return file->read_some(out); }, 0);
}

Decompressor::Decompressor(std::unique_ptr<Codec> codec) : codec_(std::move(codec)) {}
Decompressor::Decompressor(Decompressor&&) noexcept = default;
Decompressor& Decompressor::operator=(Decompressor&&) noexcept = default;
Decompressor::~Decompressor() = default;

Result<Decompressor> Decompressor::make(Compression compression) {
  switch (compression) {
    case Compression::none:
      return Decompressor(nullptr);
    case Compression::lz4:
#ifdef SCARF_HAS_LZ4
      return Decompressor(std::make_unique<Lz4Codec>());
#else
      return lacking("LZ4", "liblz4 (Debian: liblz4-dev)");
#endif
    case Compression::zstd:
#ifdef SCARF_HAS_ZSTD
      return Decompressor(std::make_unique<ZstdCodec>());
#else
      return lacking("Zstandard", "libzstd (Debian: libzstd-dev)");
#endif
    case Compression::bz2:
      break;
  }
#ifdef SCARF_HAS_BZ2
  return Decompressor(std::make_unique<Bz2Codec>());
#else
  return lacking("bzip2", "libbz2 (Debian: libbz2-dev)");
#endif
}

Result<std::span<const uint8_t>> Decompressor::unpack(std::span<const uint8_t> packed) {
  if (!codec_) {
    if (packed.size() > kLimit) return broken(text("a block of more than ", kLimit >> 20, " MiB"));
    return packed;
  }
  codec_->restart();
  size_t written = 0;
  bool whole = false;
  while (!whole || !packed.empty()) {
    if (written == unpacked_.size()) {
      if (written == kLimit) return broken(text("unpacks to more than ", kLimit >> 20, " MiB"));
      constexpr size_t kFirst = size_t{1} << 16;
      unpacked_.resize(std::clamp(2 * written, kFirst, kLimit));
    }
    const auto step = codec_->step(packed, std::span(unpacked_).subspan(written));
    if (step.broken) return broken("the compressed bytes are damaged");
    packed = packed.subspan(step.taken);
    written += step.given;
    whole = step.whole;
    if (!whole && step.taken == 0 && step.given == 0) return broken("the compressed bytes end too early");
  }
  return std::span<const uint8_t>(unpacked_).first(written);
}

}  // namespace scarf
