#include "io/hdf5/growing_dataset.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace scarf::hdf5 {
namespace {

// Behind the shuffle filter higher levels gain little, and cost more time than the computation of most
// frames.
constexpr unsigned kDeflateLevel = 1;

}  // namespace

Result<GrowingDataset> GrowingDataset::create(const WrittenFile& file, const std::string& path, hid_t type,
                                              std::span<const size_t> row_shape, size_t rows_per_chunk) {
  const Turn turn;
  GrowingDataset made;
  made.bytes_ = file.bytes();
  made.path_ = path;
  made.shape_ = {0};
  made.shape_.insert(made.shape_.end(), row_shape.begin(), row_shape.end());
  std::vector<hsize_t> limit = made.shape_;
  limit[0] = H5S_UNLIMITED;
  std::vector<hsize_t> chunk = made.shape_;
  chunk[0] = rows_per_chunk;
  const Handle space(H5Screate_simple(static_cast<int>(limit.size()), made.shape_.data(), limit.data()));
  const Handle links(H5Pcreate(H5P_LINK_CREATE));
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE));
  // Without the time of its making: the same events make the same file.
  if (H5Pset_create_intermediate_group(links.id(), 1) >= 0 &&
      H5Pset_obj_track_times(layout.id(), false) >= 0 &&
      H5Pset_chunk(layout.id(), static_cast<int>(chunk.size()), chunk.data()) >= 0 &&
      H5Pset_shuffle(layout.id()) >= 0 && H5Pset_deflate(layout.id(), kDeflateLevel) >= 0) {
    made.dataset_ =
        Handle(H5Dcreate2(file.id(), path.c_str(), type, space.id(), links.id(), layout.id(), H5P_DEFAULT));
  }
  if (!made.dataset_) return made.bytes_->error(path);
  return made;
}

Result<void> GrowingDataset::append(hid_t type, const void* values, size_t count) {
  const Turn turn;
  if (auto r = bytes_->check(); !r) return r;  // libhdf5 knows nothing of it
  const hsize_t row = std::accumulate(shape_.begin() + 1, shape_.end(), hsize_t{1}, std::multiplies<>());
  std::vector<hsize_t> start(shape_.size(), 0);
  start[0] = shape_[0];
  std::vector<hsize_t> added = shape_;
  added[0] = count / row;
  if (added[0] == 0) return {};
  shape_[0] += added[0];
  if (H5Dset_extent(dataset_.id(), shape_.data()) < 0) return bytes_->error(path_);
  const Handle memory(H5Screate_simple(static_cast<int>(added.size()), added.data(), nullptr));
  const Handle place(H5Dget_space(dataset_.id()));
  if (H5Sselect_hyperslab(place.id(), H5S_SELECT_SET, start.data(), nullptr, added.data(), nullptr) < 0 ||
      H5Dwrite(dataset_.id(), type, memory.id(), place.id(), H5P_DEFAULT, values) < 0) {
    return bytes_->error(path_);
  }
  return bytes_->check();
}

Result<void> GrowingDataset::close() {
  const Turn turn;
  if (!dataset_.close()) return bytes_->error(path_);
  return bytes_->check();
}

}  // namespace scarf::hdf5
