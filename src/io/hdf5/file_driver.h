// How libhdf5 reads and writes: through a file driver that remembers what the disk refused. While a file is
// written libhdf5 is not even told: it cannot close what it could not write, and crashes over that when the
// program ends. So it goes on as if all were well; what it writes from then on stays in memory, where it may
// read it again.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/regular_file.h"
#include "io/hdf5/library.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

/// The file behind a driver.
class DriverFile {
 public:
  /// Creates or empties the file `name`, which messages call `shown`. Errors: io.
  static Result<std::shared_ptr<DriverFile>> create(const std::string& name, const std::string& shown);
  /// A regular file, for reading. Errors: io.
  static Result<std::shared_ptr<DriverFile>> open(const std::string& path);

  /// Errors: io, the first thing that went wrong.
  Result<void> check() const;
  /// Remembers an errno, unless there is one already.
  void fail(int number);
  /// Of a call of libhdf5 that failed: what check() says; else `what`, and why libhdf5 refused.
  Error error(const std::string& what) const;
  /// Waits until all of it is on the disk, and closes the file. Errors: as check().
  Result<void> finish();

  /// False if somebody else has locked the file, to write it. Where there are no locks nobody has.
  bool lock_shared() const;

  uint64_t size() const { return size_; }
  void write(uint64_t at, std::span<const uint8_t> bytes);
  /// Zeros behind the end. False if the file cannot be read, which is remembered too.
  bool read(uint64_t at, std::span<uint8_t> out);
  void resize(uint64_t size);

 private:
  struct Kept {
    uint64_t at;
    std::vector<uint8_t> bytes;
  };

  FileDescriptor file_;
  std::string task_;  // "cannot write NAME"
  uint64_t size_ = 0;
  int failure_ = 0;         // errno
  std::vector<Kept> kept_;  // what was written since
};

/// Properties with which H5Fcreate and H5Fopen use `file`, which the open file keeps alive; they do not look
/// at the name that they are given.
Handle driven_by(const std::shared_ptr<DriverFile>& file);

}  // namespace scarf::hdf5
