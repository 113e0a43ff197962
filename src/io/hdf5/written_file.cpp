#include "io/hdf5/written_file.h"

namespace scarf::hdf5 {

Result<WrittenFile> WrittenFile::create(const std::string& name, const std::string& shown) {
  const Turn turn;
  WrittenFile made;
  auto bytes = DriverFile::create(name, shown);
  if (!bytes) return bytes.error();
  made.bytes_ = *std::move(bytes);
  const Handle access = driven_by(made.bytes_);
  made.file_ = Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()));
  if (!made.file_) return made.bytes_->error("the file");
  return made;
}

Result<void> WrittenFile::close() {
  const Turn turn;
  if (H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) < 0 || !file_.close())
    return bytes_->error("it cannot be closed");
  return bytes_->finish();
}

}  // namespace scarf::hdf5
