// Results that are on their way.
#pragma once

#include <functional>
#include <utility>

#include "scarf/result.h"

namespace scarf {

/// A Result that a device is still working on. It may outlive the object it came from, and may be dropped
/// without waiting.
template <class T>
class [[nodiscard]] Pending {
 public:
  /// A result that is there already.
  Pending(Result<T> result)  // NOLINT(google-explicit-constructor)
      : ready_([] { return true; }), wait_([r = std::move(result)]() mutable { return std::move(r); }) {}
  Pending(T value) : Pending(Result<T>(std::move(value))) {}      // NOLINT(google-explicit-constructor)
  Pending(Error error) : Pending(Result<T>(std::move(error))) {}  // NOLINT(google-explicit-constructor)
  Pending(std::function<bool()> ready, std::function<Result<T>()> wait)
      : ready_(std::move(ready)), wait_(std::move(wait)) {}

  /// Whether wait() would return at once.
  bool ready() const { return ready_(); }
  /// Waits for the result and hands it over; to be called once.
  Result<T> wait() { return wait_(); }

  /// The result of `function(value)` for the value that this one brings; errors stay as they are.
  template <class U, class Function>
  Pending<U> then(Function function) && {
    return Pending<U>(std::move(ready_), [wait = std::move(wait_), function]() mutable -> Result<U> {
      Result<T> value = wait();
      if (!value) return value.error();
      return function(std::move(value).value());
    });
  }

 private:
  std::function<bool()> ready_;
  std::function<Result<T>()> wait_;
};

}  // namespace scarf
