#include "io/hdf5/library.h"

#include "core/text.h"
#include "io/hdf5/file_driver.h"
#include "io/hdf5/lzf_filter.h"

namespace scarf::hdf5 {
namespace {

// Keeps the innermost description: the walk goes from the call outwards.
herr_t keep_description(unsigned, const H5E_error2_t* entry, void* kept) {
  // No exception may pass through libhdf5; without memory there is no description.
  try {
    if (entry->desc != nullptr) *static_cast<std::string*>(kept) = entry->desc;
  } catch (const std::bad_alloc&) {
    return -1;
  }
  return 0;
}

}  // namespace

std::recursive_mutex& library_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

Error error_of(ErrorCode code, const std::string& what) {
  std::string why;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &why);
  for (char& c : why) c = c == '\n' ? ' ' : c;
  return {code, why.empty() ? what : text(what, ": libhdf5 says: ", why)};
}

Result<Handle> open_file(const std::string& path) {
  const Turn turn;
  register_lzf();
  const auto bytes = DriverFile::open(path);
  if (!bytes) return bytes.error();
  const Handle access = driven_by(*bytes);  // closed behind the error, which it would make libhdf5 forget
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()));
  if (file) return file;
  if (const auto r = (*bytes)->check(); !r) return r.error();
  return error_of(ErrorCode::bad_input, "cannot be opened as HDF5");
}

Result<void> check_reading(const Handle& file) {
  const Turn turn;
  void* bytes = nullptr;
  if (H5Fget_vfd_handle(file.id(), H5P_DEFAULT, &bytes) < 0 || bytes == nullptr) return {};
  return static_cast<const DriverFile*>(bytes)->check();
}

}  // namespace scarf::hdf5
