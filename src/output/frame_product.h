// What is made of every frame of a recording: asked for when the frame is due, written when its result is
// there.
#pragma once

#include <deque>
#include <functional>
#include <utility>

#include "scarf/core/pending.h"
#include "session/instants.h"

namespace scarf {

class FrameProduct {
 public:
  virtual ~FrameProduct() = default;
  /// Asks for the frame that the state shows now.
  virtual Result<void> ask(const Frame& frame) = 0;
  /// Writes what is still on its way, and completes the output.
  virtual Result<void> finish() = 0;
};

/// A product whose results may be on their way while later events are pushed.
template <class T>
class PendingProduct final : public FrameProduct {
 public:
  using Ask = std::function<Pending<T>(const Frame&)>;
  using Write = std::function<Result<void>(const Frame&, const T&)>;
  using Finish = std::function<Result<void>()>;

  PendingProduct(Ask ask, Write write, Finish finish)
      : ask_(std::move(ask)), write_(std::move(write)), finish_(std::move(finish)) {}

  Result<void> ask(const Frame& frame) override {
    in_flight_.push_back({frame, ask_(frame)});
    // Enough for a device to work while earlier frames are encoded.
    constexpr size_t kInFlight = 4;
    return in_flight_.size() > kInFlight ? write_oldest() : Result<void>();
  }

  Result<void> finish() override {
    while (!in_flight_.empty()) {
      if (auto r = write_oldest(); !r) return r;
    }
    return finish_();
  }

 private:
  Result<void> write_oldest() {
    auto [frame, pending] = std::move(in_flight_.front());
    in_flight_.pop_front();
    const auto result = pending.wait();
    return result ? write_(frame, *result) : Result<void>(result.error());
  }

  const Ask ask_;
  const Write write_;
  const Finish finish_;
  std::deque<std::pair<Frame, Pending<T>>> in_flight_;
};

}  // namespace scarf
