// An HDF5 file that is written. Its errors are told by what writes its datasets, and by close().
#pragma once

#include <memory>
#include <string>

#include "io/hdf5/file_driver.h"
#include "io/hdf5/library.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

class WrittenFile {
 public:
  WrittenFile() = default;
  /// Creates or replaces the file `name`, which every libhdf5 since 1.8 reads and which messages call
  /// `shown`. Errors: io.
  static Result<WrittenFile> create(const std::string& name, const std::string& shown);

  explicit operator bool() const { return static_cast<bool>(file_); }
  hid_t id() const { return file_.id(); }
  const std::shared_ptr<DriverFile>& bytes() const { return bytes_; }

  /// Closes the file behind its datasets, which are closed. Errors: io, also for a disk that is full.
  Result<void> close();

 private:
  std::shared_ptr<DriverFile> bytes_;
  Handle file_;
};

}  // namespace scarf::hdf5
