// Tables of a FlatBuffer, read without a schema; every access is checked against the bytes.
// Source: Google, "FlatBuffers internals".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/little_endian.h"

namespace scarf {

class FlatTable {
 public:
  /// The root table of the bytes behind a size prefix; nullopt if they hold none.
  static std::optional<FlatTable> root(std::span<const uint8_t> bytes) { return at_offset(bytes, 0); }

  /// A field that is a number; `absent` where the table has none; nullopt if it lies outside the bytes.
  template <std::integral T>
  std::optional<T> number(size_t field, T absent) const {
    const auto place = find(field);
    if (place == 0) return absent;
    return load<T>(bytes_, place);
  }

  /// A vector of numbers or structs of `size` bytes each, or a string: its bytes. Empty where the table has
  /// none; nullopt if it lies outside the bytes.
  std::optional<std::span<const uint8_t>> vector(size_t field, size_t size) const {
    const auto found = vector_place(field, size);
    if (!found) return std::nullopt;
    return bytes_.subspan(found->place, found->count * size);
  }

  /// A vector of tables: their number, and one of them (nullopt if it lies outside the bytes).
  std::optional<size_t> table_count(size_t field) const {
    const auto found = vector_place(field, sizeof(uint32_t));
    if (!found) return std::nullopt;
    return found->count;
  }
  std::optional<FlatTable> table(size_t field, size_t index) const {
    const auto found = vector_place(field, sizeof(uint32_t));
    if (!found || index >= found->count) return std::nullopt;
    return at_offset(bytes_, found->place + index * sizeof(uint32_t));
  }

 private:
  struct Vector {
    size_t place = 0;
    size_t count = 0;
  };

  template <class T>
  static std::optional<T> load(std::span<const uint8_t> bytes, size_t place) {
    if (place > bytes.size() || bytes.size() - place < sizeof(T)) return std::nullopt;
    return load_little_endian<T>(bytes.data() + place);
  }

  // The table that the offset at `place` leads to. Sums of a place and 32 bits do not overflow 64.
  static std::optional<FlatTable> at_offset(std::span<const uint8_t> bytes, size_t place) {
    const auto offset = load<uint32_t>(bytes, place);
    if (!offset) return std::nullopt;
    FlatTable table;
    table.bytes_ = bytes;
    table.place_ = place + *offset;
    const auto back = load<int32_t>(bytes, table.place_);
    if (!back) return std::nullopt;
    const int64_t fields = static_cast<int64_t>(table.place_) - *back;
    if (fields < 0) return std::nullopt;
    table.fields_ = static_cast<size_t>(fields);
    const auto size = load<uint16_t>(bytes, table.fields_);
    if (!size) return std::nullopt;
    table.fields_size_ = *size;
    return table;
  }

  // Where a field is; 0, where none can be, if the table has none of it.
  size_t find(size_t field) const {
    const size_t entry = 4 + 2 * field;
    if (entry + 2 > fields_size_) return 0;
    const auto offset = load<uint16_t>(bytes_, fields_ + entry);
    // An entry outside the bytes leads to a place outside them.
    if (!offset) return bytes_.size();
    return *offset == 0 ? 0 : place_ + *offset;
  }

  std::optional<Vector> vector_place(size_t field, size_t size) const {
    const size_t place = find(field);
    if (place == 0) return Vector{};
    const auto offset = load<uint32_t>(bytes_, place);
    if (!offset) return std::nullopt;
    const auto count = load<uint32_t>(bytes_, place + *offset);
    if (!count) return std::nullopt;
    const size_t begin = place + *offset + sizeof(uint32_t);
    if (*count > (bytes_.size() - begin) / size) return std::nullopt;
    return Vector{begin, *count};
  }

  std::span<const uint8_t> bytes_;
  size_t place_ = 0;
  size_t fields_ = 0;  // of the list of its fields
  size_t fields_size_ = 0;
};

}  // namespace scarf
