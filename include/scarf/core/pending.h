// Results that are on their way.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "scarf/core/result.h"

namespace scarf {

/// A Result that a device is still working on. It may outlive the object it came from, and may be dropped
/// without waiting.
template <class T>
class [[nodiscard]] Pending {
 public:
  /// Without a result, as one that was waited for or moved from.
  Pending() = default;
  /// A result that is there already.
  Pending(Result<T> result) : result_(std::move(result)) {}       // NOLINT(google-explicit-constructor)
  Pending(T value) : Pending(Result<T>(std::move(value))) {}      // NOLINT(google-explicit-constructor)
  Pending(Error error) : Pending(Result<T>(std::move(error))) {}  // NOLINT(google-explicit-constructor)
  Pending(std::function<bool()> ready, std::function<Result<T>()> wait)
      : ready_(std::move(ready)), wait_(std::move(wait)) {}
  Pending(Pending&& other) noexcept { swap(other); }
  Pending& operator=(Pending&& other) noexcept {
    Pending(std::move(other)).swap(*this);
    return *this;
  }

  /// Whether wait() would return at once.
  bool ready() const { return !ready_ || ready_(); }
  /// Waits for the result and hands it over, once. Errors: those of the result; out_of_memory, if the host
  /// has no room for it: it is then lost, and may be asked for again; illegal_parameter, if there is none,
  /// since it was handed over before or moved away.
  Result<T> wait() {
    Pending taken = std::move(*this);
    if (taken.result_) return *std::move(taken.result_);
    if (taken.wait_) return as_result(taken.wait_);
    return as_result([]() -> Result<T> {
      return Error{ErrorCode::illegal_parameter,
                   "there is no result to wait for: it was handed over before, or moved away; ask again"};
    });
  }

  /// The result of `function(value)` for the value that this one brings; errors stay as they are.
  template <class U, class Function>
  Pending<U> then(Function function) && {
    return as_result([&]() -> Pending<U> {
      const auto first = std::make_shared<Pending>(std::move(*this));
      return Pending<U>([first] { return first->ready(); },
                        [first, function]() -> Result<U> {
                          Result<T> value = first->wait();
                          if (!value) return value.error();
                          return function(std::move(value).value());
                        });
    });
  }

 private:
  void swap(Pending& other) noexcept {
    std::swap(result_, other.result_);
    std::swap(ready_, other.ready_);
    std::swap(wait_, other.wait_);
  }

  std::optional<Result<T>> result_;  // that is there already; else it is asked for by the functions
  std::function<bool()> ready_;
  std::function<Result<T>()> wait_;
};

}  // namespace scarf
