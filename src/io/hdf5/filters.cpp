#include "io/hdf5/filters.h"

#include <string_view>

#include "core/text.h"
#include "io/hdf5/ecf_codec.h"

namespace scarf::hdf5 {
namespace {

// Source: the list of registered filters of the HDF Group.
struct Filter {
  H5Z_filter_t id;
  std::string_view name;
  std::string_view package;  // of Debian; none has it if empty
};

constexpr Filter kFilters[] = {
    {307, "bzip2", "hdf5-filter-plugin"},
    {32001, "Blosc", "hdf5-filter-plugin-blosc-serial"},
    {32004, "LZ4", "hdf5-filter-plugin"},
    {32008, "Bitshuffle", "hdf5-filter-plugin"},
    {32013, "ZFP", "hdf5-filter-plugin-zfp-serial"},
    {32015, "Zstandard", ""},
    {32026, "Blosc2", ""},
    {kEcfFilter, "ECF behind or before other filters", ""},
};

H5Z_filter_t filter_at(const Handle& creation, unsigned index) {
  unsigned flags = 0;
  size_t values = 0;
  return H5Pget_filter2(creation.id(), index, &flags, &values, nullptr, 0, nullptr, nullptr);
}

std::string advice(H5Z_filter_t id) {
  for (const Filter& filter : kFilters) {
    if (filter.id != id) continue;
    return text(filter.name, " (HDF5 filter ", id, "), which is not installed; ",
                filter.package.empty()
                    ? "write the file again with gzip, or set HDF5_PLUGIN_PATH to its plugin"
                    : text("install the package ", filter.package));
  }
  return text("HDF5 filter ", id, ", which is not installed; set HDF5_PLUGIN_PATH to its plugin");
}

}  // namespace

bool only_ecf(const Handle& creation) {
  return H5Pget_nfilters(creation.id()) == 1 && filter_at(creation, 0) == kEcfFilter;
}

Result<void> check_filters(const Handle& creation, const std::string& path) {
  const int count = H5Pget_nfilters(creation.id());
  for (int i = 0; i < count; ++i) {
    const H5Z_filter_t id = filter_at(creation, static_cast<unsigned>(i));
    if (id < 0 || H5Zfilter_avail(id) <= 0) {
      return Error{ErrorCode::bad_input, text(path, " is compressed by ", advice(id))};
    }
  }
  return {};
}

}  // namespace scarf::hdf5
