#include "io/hdf5/dataset.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/text.h"
#include "io/hdf5/filters.h"

namespace scarf::hdf5 {
namespace {

constexpr size_t kMaxShortValues = 8;
constexpr size_t kMaxText = 4096;

// A file must not make scarf read other files.
herr_t refuse_external_link(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) {
  return -1;
}

Handle access_properties() {
  Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_elink_cb(access.id(), refuse_external_link, nullptr);
  return access;
}

Handle open_object(const Handle& file, const std::string& path) {
  const Handle access = access_properties();
  Handle object(H5Oopen(file.id(), path.c_str(), access.id()));
  return H5Iget_type(object.id()) == H5I_DATASET ? std::move(object) : Handle();
}

// To be asked of a dataset before anything else: to say how large a virtual one is, libhdf5 opens the files
// that it names, and waits if one is a pipe.
bool lies_elsewhere(const Handle& dataset) {
  const Handle creation(H5Dget_create_plist(dataset.id()));
  return H5Pget_layout(creation.id()) == H5D_VIRTUAL || H5Pget_external_count(creation.id()) != 0;
}

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

std::optional<size_t> short_size(const Handle& space) {
  const hssize_t points = space ? H5Sget_simple_extent_npoints(space.id()) : -1;
  if (points < 1 || points > static_cast<hssize_t>(kMaxShortValues)) return std::nullopt;
  return static_cast<size_t>(points);
}

bool is_number(const Handle& type) {
  const H5T_class_t kind = H5Tget_class(type.id());
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

}  // namespace

bool Dataset::exists(const Handle& file, const std::string& path) {
  const Turn turn;
  return static_cast<bool>(open_object(file, path));
}

Result<Dataset> Dataset::open(const Handle& file, const std::string& path, const Across& across) {
  const Turn turn;
  Dataset made;
  made.path_ = path;
  made.dataset_ = open_object(file, path);
  if (!made.dataset_) return bad(text("has no dataset ", path));
  if (auto r = made.look_at_layout(across); !r) return r.error();
  // Opened again with a cache that holds a row of chunks; they would be decompressed again for each block of
  // rows.
  const Handle access = access_properties();
  constexpr size_t kSlots = 521;
  H5Pset_chunk_cache(access.id(), kSlots, made.cache_bytes_, 1.0);
  made.dataset_ = Handle();
  made.dataset_ = Handle(H5Dopen2(file.id(), path.c_str(), access.id()));
  if (!made.dataset_) return error_of(ErrorCode::bad_input, text("cannot open ", path));
  return made;
}

Result<void> Dataset::look_at_layout(const Across& across) {
  if (lies_elsewhere(dataset_)) {
    return bad(text(path_, " keeps its data in other files, which are not read; copy it with h5repack"));
  }
  const Handle space(H5Dget_space(dataset_.id()));
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank < 1 || rank > 3) return bad(text(path_, " has ", rank, " dimensions, not 1 to 3"));
  shape_.resize(static_cast<size_t>(rank));
  H5Sget_simple_extent_dims(space.id(), shape_.data(), nullptr);

  const Handle creation(H5Dget_create_plist(dataset_.id()));
  const bool by_matlab = H5Aexists(dataset_.id(), "MATLAB_class") > 0;
  axis_ = rank == 2 && across && across(shape_, by_matlab) ? 1 : 0;
  cache_bytes_ = 0;
  if (H5Pget_layout(creation.id()) != H5D_CHUNKED) return {};

  chunk_.resize(shape_.size());
  if (H5Pget_chunk(creation.id(), rank, chunk_.data()) != rank)
    return bad(text(path_, " has no shape of chunks"));
  const Handle value_type = type();
  // Each below 2^32, and the product checked at every step: no overflow.
  chunk_bytes_ = H5Tget_size(value_type.id());
  for (const hsize_t n : chunk_) {
    if (n == 0 || chunk_bytes_ > kMaxChunkBytes || n > kMaxChunkBytes)
      chunk_bytes_ = kMaxChunkBytes + 1;
    else
      chunk_bytes_ *= n;
  }
  cache_bytes_ = chunk_bytes_;
  for (size_t i = 0; i < shape_.size(); ++i) {
    if (i == axis_) continue;
    const uint64_t beside = shape_[i] == 0 ? 1 : (shape_[i] - 1) / std::max<hsize_t>(chunk_[i], 1) + 1;
    cache_bytes_ =
        beside > kMaxChunkBytes || cache_bytes_ > kMaxChunkBytes ? kMaxChunkBytes + 1 : cache_bytes_ * beside;
  }
  if (cache_bytes_ > kMaxChunkBytes) {
    return bad(text(path_, " has chunks of more than ", kMaxChunkBytes >> 20,
                    " MiB; write it again with smaller ones, as h5repack does"));
  }
  compressed_ = H5Pget_nfilters(creation.id()) > 0;
  ecf_ = only_ecf(creation);
  return ecf_ ? Result<void>() : check_filters(creation, path_);
}

uint64_t Dataset::row_values() const {
  uint64_t values = 1;
  for (size_t i = 0; i < shape_.size(); ++i) values *= i == axis_ ? 1 : shape_[i];
  return values;
}

uint64_t Dataset::chunk_end(uint64_t row) const {
  if (chunk_.empty()) return rows();
  const uint64_t begin = row - row % chunk_[axis_];
  return chunk_[axis_] < rows() - begin ? begin + chunk_[axis_] : rows();
}

template <class Use>
void Dataset::for_each_chunk(uint64_t first, uint64_t count, Use use) const {
  std::vector<hsize_t> at(shape_.size(), 0);
  for (at[axis_] = first - first % chunk_[axis_]; at[axis_] < first + count; at[axis_] += chunk_[axis_]) {
    for (bool more = true; more;) {
      hsize_t size = 0;
      const bool found = H5Dget_chunk_storage_size(dataset_.id(), at.data(), &size) >= 0;
      if (!use(found ? size : 0)) return;
      // The next chunk beside it, the last dimension first.
      more = false;
      for (size_t i = shape_.size(); i-- > 0 && !more;) {
        if (i == axis_) continue;
        at[i] += chunk_[i];
        more = at[i] < shape_[i];
        if (!more) at[i] = 0;
      }
    }
  }
}

bool Dataset::written(uint64_t first, uint64_t count) const {
  const Turn turn;
  if (chunk_.empty()) return H5Dget_storage_size(dataset_.id()) > 0;
  bool all = true;
  for_each_chunk(first, count, [&](hsize_t size) { return all = size > 0; });
  return all;
}

// No chunk may be stored in many more bytes than it has; that is a broken size.
Result<void> Dataset::check_chunks(uint64_t first, uint64_t count) const {
  if (!compressed_) return {};
  const uint64_t most = chunk_bytes_ + chunk_bytes_ / 8 + 64 * 1024;
  hsize_t largest = 0;
  for_each_chunk(first, count, [&](hsize_t size) {
    largest = std::max(largest, size);
    return true;
  });
  if (largest > most) return bad(text("a chunk of ", chunk_bytes_, " bytes is stored in ", largest));
  return {};
}

Result<void> Dataset::read(uint64_t first, uint64_t count, hid_t memory_type, void* out) const {
  const Turn turn;
  if (auto r = check_chunks(first, count); !r) return r;
  std::vector<hsize_t> start(shape_.size(), 0);
  start[axis_] = first;
  std::vector<hsize_t> extent = shape_;
  extent[axis_] = count;
  const Handle memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
  const Handle place(H5Dget_space(dataset_.id()));
  if (H5Sselect_hyperslab(place.id(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0 ||
      H5Dread(dataset_.id(), memory_type, memory.id(), place.id(), H5P_DEFAULT, out) < 0) {
    return error_of(ErrorCode::bad_input, "cannot be read");
  }
  return {};
}

Result<void> Dataset::read_chunk(uint64_t first, std::vector<uint8_t>& bytes, bool& filtered) const {
  const Turn turn;
  if (auto r = check_chunks(first, 1); !r) return r;
  std::vector<hsize_t> start(shape_.size(), 0);
  start[0] = first;
  hsize_t size = 0;
  uint32_t skipped_filters = 0;
  bytes.clear();
  if (H5Dget_chunk_storage_size(dataset_.id(), start.data(), &size) < 0) {
    return error_of(ErrorCode::bad_input, "cannot be read");
  }
  bytes.resize(size);
  if (H5Dread_chunk(dataset_.id(), H5P_DEFAULT, start.data(), &skipped_filters, bytes.data()) < 0) {
    return error_of(ErrorCode::bad_input, "cannot be read");
  }
  filtered = skipped_filters == 0;
  return {};
}

uint64_t Dataset::byte_of(uint64_t row) const {
  const Turn turn;
  haddr_t address = HADDR_UNDEF;
  if (chunk_.empty()) {
    address = H5Dget_offset(dataset_.id());
  } else {
    std::vector<hsize_t> start(shape_.size(), 0);
    start[axis_] = row - row % chunk_[axis_];
    unsigned mask = 0;
    hsize_t size = 0;
    H5Dget_chunk_info_by_coord(dataset_.id(), start.data(), &mask, &address, &size);
  }
  return address == HADDR_UNDEF ? 0 : address;
}

std::optional<std::vector<int64_t>> short_dataset(const Handle& file, const std::string& path) {
  const Turn turn;
  const Handle dataset = open_object(file, path);
  if (!dataset || lies_elsewhere(dataset)) return std::nullopt;
  const auto count = short_size(Handle(H5Dget_space(dataset.id())));
  if (!count || !is_number(Handle(H5Dget_type(dataset.id())))) return std::nullopt;
  std::vector<int64_t> values(*count);
  if (H5Dread(dataset.id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    return std::nullopt;
  return values;
}

std::optional<std::vector<int64_t>> root_attribute(const Handle& file, const std::string& name) {
  const Turn turn;
  const Handle attribute(H5Aopen(file.id(), name.c_str(), H5P_DEFAULT));
  if (!attribute) return std::nullopt;
  const auto count = short_size(Handle(H5Aget_space(attribute.id())));
  if (!count || !is_number(Handle(H5Aget_type(attribute.id())))) return std::nullopt;
  std::vector<int64_t> values(*count);
  if (H5Aread(attribute.id(), H5T_NATIVE_INT64, values.data()) < 0) return std::nullopt;
  return values;
}

std::optional<std::string> root_text(const Handle& file, const std::string& name) {
  const Turn turn;
  const Handle attribute(H5Aopen(file.id(), name.c_str(), H5P_DEFAULT));
  if (!attribute) return std::nullopt;
  const Handle type(H5Aget_type(attribute.id()));
  const auto count = short_size(Handle(H5Aget_space(attribute.id())));
  if (count != size_t{1} || H5Tget_class(type.id()) != H5T_STRING) return std::nullopt;
  if (H5Tis_variable_str(type.id()) > 0) {
    char* value = nullptr;
    if (H5Aread(attribute.id(), type.id(), &value) < 0 || value == nullptr) return std::nullopt;
    std::string result(value, strnlen(value, kMaxText));
    H5free_memory(value);
    return result;
  }
  const size_t size = H5Tget_size(type.id());
  if (size == 0 || size > kMaxText) return std::nullopt;
  std::string result(size, '\0');
  if (H5Aread(attribute.id(), type.id(), result.data()) < 0) return std::nullopt;
  result.resize(strnlen(result.data(), size));
  return result;
}

}  // namespace scarf::hdf5
