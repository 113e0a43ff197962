// How well bytes fit a word format, for recordings without a header.
#pragma once

#include <cstdint>
#include <vector>

namespace scarf {

template <int kTimeHighBits>
class WordCheck {
 public:
  void event() { ++words_, ++events_; }
  void other() { ++words_; }
  void undefined() { ++words_, ++undefined_; }
  void time_high(uint32_t value) {
    ++words_;
    time_highs_.push_back(value);
  }

  /// At most 1 % undefined words, and a clock that moves on by at most `largest_step` nine times out of ten.
  /// Too few words are never plausible: random bytes would be.
  bool plausible(uint32_t largest_step) const {
    constexpr uint64_t kFewestWords = 32;
    constexpr uint32_t kMask = (uint32_t{1} << kTimeHighBits) - 1;
    uint64_t jumps = 0;
    for (size_t i = 1; i < time_highs_.size(); ++i) {
      jumps += ((time_highs_[i] - time_highs_[i - 1]) & kMask) > largest_step ? 1 : 0;
    }
    return words_ >= kFewestWords && events_ > 0 && !time_highs_.empty() && undefined_ * 100 <= words_ &&
           jumps * 10 <= time_highs_.size();
  }

 private:
  uint64_t words_ = 0;
  uint64_t events_ = 0;
  uint64_t undefined_ = 0;
  std::vector<uint32_t> time_highs_;
};

}  // namespace scarf
