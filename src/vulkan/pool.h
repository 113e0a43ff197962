// Objects with commands of their own, used again when the device is done with them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "scarf/core/result.h"

namespace scarf {

/// Objects that are either idle (perhaps still in flight on the device) or lent out. compute_of(T&) are the
/// commands that say when one is done.
template <class T>
class Pool {
 public:
  static constexpr size_t kIdleLimit = 32;  ///< idle objects in flight before a call waits for one
  using Make = std::function<Result<std::unique_ptr<T>>()>;

  /// An object whose last submission is done; a new one if there is none and fewer than the limit are idle.
  Result<std::unique_ptr<T>> take(const Make& make) {
    for (size_t i = 0; i < idle_.size(); ++i) {
      const auto done = compute_of(*idle_[i]).done();
      if (!done) return done.error();
      if (*done) return take_at(i);
    }
    if (idle_.size() < kIdleLimit) {
      if (idle_.capacity() <= made_) idle_.reserve(2 * made_ + 1);  // for give_back()
      auto made = make();
      if (made) ++made_;
      return made;
    }
    if (auto r = compute_of(*idle_.front()).wait(); !r) return r.error();
    return take_at(0);
  }
  /// Of an object that take() made. Allocates nothing: it has its place already, so that destructors may call
  /// this.
  void give_back(std::unique_ptr<T> object) noexcept { idle_.push_back(std::move(object)); }
  const std::vector<std::unique_ptr<T>>& idle() const { return idle_; }

 private:
  std::unique_ptr<T> take_at(size_t i) {
    std::unique_ptr<T> object = std::move(idle_[i]);
    idle_.erase(idle_.begin() + static_cast<std::ptrdiff_t>(i));
    return object;
  }

  std::vector<std::unique_ptr<T>> idle_;
  size_t made_ = 0;  // idle or lent out
};

}  // namespace scarf
