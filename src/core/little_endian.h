// Little-endian numbers in bytes.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>

namespace scarf {

/// The number at any address.
template <std::integral T>
T load_little_endian(const uint8_t* from) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

/// `out`: a container of bytes.
template <std::integral T, class Bytes>
void append_little_endian(Bytes& out, T value) {
  for (size_t i = 0; i < sizeof(T); ++i) {
    out.push_back(static_cast<typename Bytes::value_type>(value >> (8 * i)));
  }
}

}  // namespace scarf
