// Errors as values: a function that can fail because of its caller or of the world returns a Result.
//
// No function of scarf that returns a Result or a Pending throws for lack of memory: it returns
// out_of_memory. Others may throw std::bad_alloc. Then they have changed nothing, but for simulations and
// digests, which are to be made anew.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace scarf {

enum class ErrorCode {
  illegal_parameter,  ///< a parameter is outside its legal range; the message names both
  unrecognised,       ///< a file or folder is in no format that scarf knows, or holds no events
  bad_input,          ///< a file or an event stream is not what it should be
  refused_batch,      ///< a batch of events was refused as a whole; the state is unchanged
  would_block,        ///< every staging slot is in flight and the caller asked not to wait
  io,                 ///< the operating system refused to read or write
  device,             ///< no suitable device, or the device failed
  device_lost,        ///< the device is gone; every later call on it says so
  out_of_memory,      ///< host or device memory is exhausted, or a size is beyond the device's limits
};

/// What went wrong, in one line that says what to do about it.
struct Error {
  ErrorCode code = ErrorCode::illegal_parameter;
  std::string message;
};

/// A value or the Error that prevented it. Whoever takes the value without having looked, or the error of
/// what went well, ends the program (std::terminate): nothing is thrown, and nothing goes on with a value
/// that is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : content_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return *sure(std::get_if<0>(&content_)); }
  const T& value() const& { return *sure(std::get_if<0>(&content_)); }
  T&& value() && { return std::move(*sure(std::get_if<0>(&content_))); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return *sure(std::get_if<1>(&content_)); }

  /// The value, or another one in place of an error.
  T value_or(T other) const& { return ok() ? value() : std::move(other); }
  T value_or(T other) && { return ok() ? std::move(*this).value() : std::move(other); }

  /// `function(value)` as a Result; an error stays as it is.
  template <class Function>
  auto map(Function&& function) && -> Result<std::invoke_result_t<Function, T&&>> {
    if (!ok()) return std::move(*sure(std::get_if<1>(&content_)));
    return std::forward<Function>(function)(std::move(*this).value());
  }
  /// `function(value)`, which is a Result itself; an error stays as it is.
  template <class Function>
  auto and_then(Function&& function) && -> std::invoke_result_t<Function, T&&> {
    if (!ok()) return std::move(*sure(std::get_if<1>(&content_)));
    return std::forward<Function>(function)(std::move(*this).value());
  }

 private:
  template <class Held>
  static Held* sure(Held* held) {
    if (held == nullptr) std::terminate();
    return held;
  }

  std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Error& error() const { return error_; }

 private:
  Error error_;
  bool ok_ = true;
};

/// The host has no more memory, as an Error. Needs none itself: without room for the sentence, the message is
/// shorter.
inline Error host_out_of_memory() noexcept {
  try {
    return {ErrorCode::out_of_memory,
            "the host has no more memory; use smaller batches or geometries, or fewer streams at a time"};
  } catch (const std::bad_alloc&) {
    return {ErrorCode::out_of_memory, "out of memory"};  // held by the string itself
  }
}

/// A copy of an error that is to be remembered. Keeps the code if there is no memory for the message.
inline Error copy_of(const Error& error) noexcept {
  try {
    return error;
  } catch (const std::bad_alloc&) {
    return {error.code, "out of memory"};
  }
}

/// What `function` returns, which is a Result or a Pending; out_of_memory if it throws for lack of memory.
template <class Function>
std::invoke_result_t<Function&> as_result(Function&& function) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return host_out_of_memory();
  } catch (const std::length_error&) {  // of a container that is to be larger than any memory
    return host_out_of_memory();
  }
}

}  // namespace scarf
