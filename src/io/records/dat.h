// DAT: Prophesee's format of records of 8 bytes, a time of 32 bits and a word.
// Source: OpenEB's DAT reader; prophesee-automotive-dataset-toolbox.
#pragma once

#include <cstdint>

namespace scarf::dat {

/// The first byte behind the header says what the records are, the second one how long they are.
enum Type : uint8_t {
  kEvent2d = 0,  // the old name of kEventCd
  kEventCd = 12,
  kTrigger = 14,
};

inline constexpr uint64_t kRecordBytes = 8;

/// The clock of 32 bits, unwrapped: a fall by half its range or more is a wrap, a smaller one a back-step.
class Clock {
 public:
  int64_t unwrap(uint32_t t) {
    constexpr uint32_t kHalf = uint32_t{1} << 31;
    loops_ += static_cast<int64_t>(uint64_t{t < previous_ && previous_ - t >= kHalf} << 32);
    previous_ = t;
    return loops_ | t;
  }

 private:
  int64_t loops_ = 0;  // times 2^32
  uint32_t previous_ = 0;
};

}  // namespace scarf::dat
