// Numbers of the types that datasets have, and their values as 64-bit integers.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "io/base/rounding.h"
#include "io/hdf5/library.h"

namespace scarf::hdf5 {

enum class NumberType { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

/// The type in memory for a type of the file: integers, enumerations (booleans are some) and floating point.
/// nullopt: anything else.
std::optional<NumberType> number_type(hid_t file_type);
hid_t memory_type(NumberType type);
size_t size_of(NumberType type);
bool is_float(NumberType type);

/// Calls `use` with a value of the C++ type.
template <class Use>
auto with_type(NumberType type, Use use) {
  switch (type) {
    case NumberType::u8:
      return use(uint8_t{});
    case NumberType::i8:
      return use(int8_t{});
    case NumberType::u16:
      return use(uint16_t{});
    case NumberType::i16:
      return use(int16_t{});
    case NumberType::u32:
      return use(uint32_t{});
    case NumberType::i32:
      return use(int32_t{});
    case NumberType::u64:
      return use(uint64_t{});
    case NumberType::i64:
      return use(int64_t{});
    case NumberType::f32:
      return use(float{});
    case NumberType::f64:
      break;
  }
  return use(double{});
}

/// What no number of 64 bits or no number at all becomes; no coordinate and no time.
inline constexpr int64_t kNoInteger = std::numeric_limits<int64_t>::max();

/// The nearest integer, halves up; kNoInteger for what is 2^62 or further from 0.
inline int64_t nearest_integer(double value) {
  return std::abs(value) < 0x1p62 ? static_cast<int64_t>(rounded(value)) : kNoInteger;
}

template <class T>
int64_t as_integer(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    return nearest_integer(value);
  } else if constexpr (std::is_same_v<T, uint64_t>) {
    return value > static_cast<uint64_t>(kNoInteger) ? kNoInteger : static_cast<int64_t>(value);
  } else {
    return value;
  }
}

/// Numbers in memory, `stride` bytes apart.
struct Numbers {
  const uint8_t* first = nullptr;
  size_t stride = 0;
  NumberType type = NumberType::u8;

  /// out[i] = f(number i), where `f` takes any of the C++ types.
  template <class F>
  void transform(std::span<int64_t> out, F f) const {
    with_type(type, [&](auto example) {
      using T = decltype(example);
      const uint8_t* at = first;
      for (int64_t& value : out) {
        T number;
        std::memcpy(&number, at, sizeof(T));
        value = f(number);
        at += stride;
      }
    });
  }
};

}  // namespace scarf::hdf5
