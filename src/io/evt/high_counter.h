// The upper bits of a camera's clock, which wrap.
#pragma once

#include <cstdint>
#include <optional>

namespace scarf {

/// Loops of a clock that a file's writer is willing to count: 19 hours of EVT3, 2.2 years of EVT2.
inline constexpr uint64_t kMaxLoops = 4096;

/// Counter of kBits bits, unwrapped: a decrease by half the range or more is a wrap, a smaller one a
/// back-step.
template <int kBits>
class HighCounter {
 public:
  static constexpr uint32_t kRange = uint32_t{1} << kBits;

  void set(uint32_t value) {
    if (value < value_ && value_ - value >= kRange / 2) loops_ += kRange;
    value_ = value;
  }
  uint64_t unwrapped() const { return loops_ + value_; }
  uint32_t value() const { return value_; }

 private:
  uint64_t loops_ = 0;  // times kRange
  uint32_t value_ = 0;
};

/// The inverse for writers: calls `emit` with the counter values that carry a reader from `from` (nullopt: no
/// value emitted yet) to `to` >= from. Each wrap is passed as maximum, 0, which every known reader
/// understands.
template <int kBits, class Emit>
void carry_high_counter(std::optional<uint64_t> from, uint64_t to, Emit emit) {
  constexpr uint64_t kMaximum = HighCounter<kBits>::kRange - 1;
  uint64_t now = from.value_or(0);
  bool emitted = from.has_value();
  while (now >> kBits < to >> kBits) {
    if (!emitted || (now & kMaximum) != kMaximum) emit(static_cast<uint32_t>(kMaximum));
    emit(uint32_t{0});
    emitted = true;
    now = ((now >> kBits) + 1) << kBits;
  }
  if (!emitted || now != to) emit(static_cast<uint32_t>(to & kMaximum));
}

/// What a reader's counter holds, as the writer of its file keeps it.
template <int kBits>
class HeldHigh {
 public:
  /// Calls `emit` with what must be written for the reader to hold `to`, wraps included; nothing if it does.
  template <class Emit>
  void carry_to(uint64_t to, Emit emit) {
    if (to == held_) return;
    carry_high_counter<kBits>(held_, to, emit);
    held_ = to;
  }

 private:
  std::optional<uint64_t> held_;
};

}  // namespace scarf
