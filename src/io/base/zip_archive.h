// Members of a zip archive as streams of bytes; memory does not depend on their size. Needs libzip.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_reader.h"
#include "scarf/core/result.h"

namespace scarf {

/// What this build lacks to read archives; empty if it can.
#ifdef SCARF_HAS_LIBZIP
inline constexpr std::string_view kZipMissing = {};
#else
inline constexpr std::string_view kZipMissing = "libzip (Debian: libzip-dev)";
#endif

/// Whether a file begins as archives do.
bool looks_like_zip(std::span<const uint8_t> bytes);

class ZipArchive {
 public:
  /// Errors: bad_input, for a file that is no archive, is broken, or if this build has no libzip.
  static Result<ZipArchive> open(const std::string& path);

  struct Member {
    std::string name;
    uint64_t bytes = 0;  ///< as the archive says
    uint64_t index = 0;
  };
  /// Files, no folders, in the order of the archive.
  const std::vector<Member>& members() const { return members_; }

  /// A member of members(); several may be read at a time, also after the ZipArchive is gone. Broken data
  /// is one bad_input error of its ByteReader, and then the end. Errors: bad_input.
  Result<ByteReader> read(const Member& member) const;

  /// Errors: also bad_input, for a member of more than `limit` bytes.
  Result<std::vector<uint8_t>> read_whole(const Member& member, uint64_t limit) const;

 private:
  struct Handle;

  std::shared_ptr<Handle> handle_;
  std::vector<Member> members_;
};

}  // namespace scarf
