// libhdf5 with owners for what it opens, and its errors as values.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

#include "scarf/core/result.h"

namespace scarf::hdf5 {

/// Debian builds libhdf5 without its own lock: threads take turns.
std::recursive_mutex& library_mutex();

/// While one lives, no other thread calls libhdf5, and it prints nothing. What calls libhdf5 has one.
class Turn {
 public:
  Turn() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Turn() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  const std::lock_guard<std::recursive_mutex> lock_{library_mutex()};
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Owns anything that libhdf5 has opened: a file, a dataset, a type, a property list.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  ~Handle() { close(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) close(), id_ = std::exchange(other.id_, H5I_INVALID_HID);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  explicit operator bool() const { return id_ >= 0; }
  hid_t id() const { return id_; }
  /// Whether that went well; files and datasets may write while they are closed.
  bool close() {
    if (id_ < 0) return true;
    const Turn turn;
    return H5Idec_ref(std::exchange(id_, H5I_INVALID_HID)) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// `what`, and why libhdf5's last call failed.
Error error_of(ErrorCode code, const std::string& what);

/// Opens a regular file for reading. Errors: io; bad_input.
Result<Handle> open_file(const std::string& path);
/// Whether all that libhdf5 has read of such a file so far could be read. It passes over much of what cannot,
/// as if it were not there. Errors: io.
Result<void> check_reading(const Handle& file);

}  // namespace scarf::hdf5
