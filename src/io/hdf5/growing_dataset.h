// A dataset that is written row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/written_file.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

template <class T>
hid_t native_type();
template <>
inline hid_t native_type<uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
inline hid_t native_type<uint16_t>() {
  return H5T_NATIVE_UINT16;
}
template <>
inline hid_t native_type<uint32_t>() {
  return H5T_NATIVE_UINT32;
}
template <>
inline hid_t native_type<uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
inline hid_t native_type<int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t native_type<float>() {
  return H5T_NATIVE_FLOAT;
}

class GrowingDataset {
 public:
  GrowingDataset() = default;

  /// Creates the dataset with no rows, in chunks of `rows_per_chunk` rows, compressed by deflate, which every
  /// libhdf5 reads. `row_shape`: dimensions of a row, none for a column of numbers. Groups on the way to
  /// `path` are made. Errors: io.
  template <class T>
  static Result<GrowingDataset> create(const WrittenFile& file, const std::string& path,
                                       std::span<const size_t> row_shape, size_t rows_per_chunk) {
    return create(file, path, native_type<T>(), row_shape, rows_per_chunk);
  }

  /// Appends whole rows. Errors: io.
  template <class T>
  Result<void> append(std::span<const T> values) {
    return append(native_type<T>(), values.data(), values.size());
  }

  /// Errors: io, also for a disk that is full.
  Result<void> close();

 private:
  static Result<GrowingDataset> create(const WrittenFile& file, const std::string& path, hid_t type,
                                       std::span<const size_t> row_shape, size_t rows_per_chunk);
  Result<void> append(hid_t type, const void* values, size_t count);

  std::shared_ptr<DriverFile> bytes_;  // of its file
  Handle dataset_;
  std::string path_;
  std::vector<hsize_t> shape_;  // all dimensions; the first is the number of rows so far
};

/// Writes one number. Errors: io.
template <class T>
Result<void> write_scalar(const WrittenFile& file, const std::string& path, T value) {
  const Turn turn;
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(creation.id(), false);  // see GrowingDataset::create
  const Handle dataset(H5Dcreate2(file.id(), path.c_str(), native_type<T>(), space.id(), H5P_DEFAULT,
                                  creation.id(), H5P_DEFAULT));
  if (!dataset || H5Dwrite(dataset.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) < 0) {
    return file.bytes()->error(path);
  }
  return file.bytes()->check();
}

}  // namespace scarf::hdf5
