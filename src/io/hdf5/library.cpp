#include "io/hdf5/library.h"

#include "core/text.h"
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
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file) return error_of(ErrorCode::bad_input, "cannot be opened as HDF5");
  return file;
}

Result<Handle> create_file(const std::string& path) {
  const Turn turn;
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!file) return error_of(ErrorCode::io, "cannot create the file");
  return file;
}

Result<void> close_file(Handle& file) {
  const Turn turn;
  if (H5Fflush(file.id(), H5F_SCOPE_GLOBAL) < 0 || !file.close())
    return error_of(ErrorCode::io, "cannot write");
  return {};
}

}  // namespace scarf::hdf5
