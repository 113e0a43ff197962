#include "io/hdf5/number_type.h"

namespace scarf::hdf5 {

std::optional<NumberType> number_type(hid_t file_type) {
  const H5T_class_t kind = H5Tget_class(file_type);
  const size_t size = H5Tget_size(file_type);
  if (kind == H5T_FLOAT) return size <= 4 ? NumberType::f32 : NumberType::f64;
  if (kind == H5T_ENUM) {
    const Handle base(H5Tget_super(file_type));
    return number_type(base.id());
  }
  if (kind != H5T_INTEGER) return std::nullopt;
  const bool is_signed = H5Tget_sign(file_type) == H5T_SGN_2;
  switch (size) {
    case 1:
      return is_signed ? NumberType::i8 : NumberType::u8;
    case 2:
      return is_signed ? NumberType::i16 : NumberType::u16;
    case 4:
      return is_signed ? NumberType::i32 : NumberType::u32;
    case 8:
      return is_signed ? NumberType::i64 : NumberType::u64;
    default:
      return std::nullopt;
  }
}

hid_t memory_type(NumberType type) {
  switch (type) {
    case NumberType::u8:
      return H5T_NATIVE_UINT8;
    case NumberType::i8:
      return H5T_NATIVE_INT8;
    case NumberType::u16:
      return H5T_NATIVE_UINT16;
    case NumberType::i16:
      return H5T_NATIVE_INT16;
    case NumberType::u32:
      return H5T_NATIVE_UINT32;
    case NumberType::i32:
      return H5T_NATIVE_INT32;
    case NumberType::u64:
      return H5T_NATIVE_UINT64;
    case NumberType::i64:
      return H5T_NATIVE_INT64;
    case NumberType::f32:
      return H5T_NATIVE_FLOAT;
    case NumberType::f64:
      break;
  }
  return H5T_NATIVE_DOUBLE;
}

size_t size_of(NumberType type) {
  return with_type(type, [](auto example) { return sizeof(example); });
}

bool is_float(NumberType type) {
  return type == NumberType::f32 || type == NumberType::f64;
}

}  // namespace scarf::hdf5
