// SHA-256 digests by which two programs, machines or versions can be compared with one line of text.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scarf/core/image.h"
#include "scarf/core/patch_state.h"

namespace scarf {

/// SHA-256 over bytes that come in pieces.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  void add(std::span<const uint8_t> bytes);
  /// The digest of all bytes so far in lower-case hexadecimal; the Digest starts anew.
  std::string hex();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Event digest: over (t u64, x u16, y u16, p u8) of each event, little-endian, 13 bytes, in stream order.
/// Add only events inside the sensor.
class EventDigest {
 public:
  void add(const Event& event);
  std::string hex();

 private:
  void flush();
  Digest digest_;
  std::vector<uint8_t> buffer_;
};

/// State digest: for each patch in id order its total (u64), then for each filled slot in slot order
/// (x u16, y u16, p u8, active u8, t i64), little-endian.
std::string state_digest(const Snapshot& snapshot);

/// Image digest: over the 8-bit pixels, row-major, no header.
std::string image_digest(const Image<uint8_t>& image);

}  // namespace scarf
