#include "io/evt2_reader.h"

#include <utility>

#include "core/little_endian.h"
#include "io/buffered_source.h"
#include "io/evt2.h"
#include "io/word_check.h"

namespace scarf {
namespace {

class Evt2Reader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return "EVT2"; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  // Copied into decode() and back, so that the compiler can hold it in registers while events are written.
  struct State {
    evt2::TimeHigh time_high;
    int64_t time = -1;  // of time_high, microseconds; negative before the first word of it
    uint32_t skip = 0;  // words left of an IMU block
    uint64_t unknown = 0;

    void other_word(uint32_t word) {
      switch (word >> 28) {
        case evt2::kTimeHigh:
          time_high.set(word & (evt2::TimeHigh::kRange - 1));
          time = static_cast<int64_t>((time_high.unwrapped() << evt2::kTimeLowBits) & INT64_MAX);
          break;
        case evt2::kImu:
          skip = evt2::kImuWords - 1;
          break;
        case evt2::kTrigger:
        case evt2::kOthers:
        case evt2::kContinued:
          break;
        default:
          ++unknown;
      }
    }
  };

  State state_;
};

BufferedSource::Decoded Evt2Reader::decode(std::span<const uint8_t> bytes, bool /*last*/,
                                           std::span<Event> out) {
  State s = state_;
  size_t count = 0;
  size_t at = 0;
  for (; count < out.size() && at + 4 <= bytes.size(); at += 4) {
    const auto word = load_little_endian<uint32_t>(bytes.data() + at);
    const uint32_t type = word >> 28;
    if (s.skip > 0) [[unlikely]] {
      --s.skip;
    } else if (type <= evt2::kOn && s.time >= 0) {
      out[count++] = {s.time | (word >> 22 & 63), static_cast<uint16_t>(word >> 11 & evt2::kCoordinateMask),
                      static_cast<uint16_t>(word & evt2::kCoordinateMask), static_cast<uint8_t>(type)};
    } else if (type == evt2::kTimeHigh || s.time >= 0) {
      s.other_word(word);
    }
  }
  state_ = s;
  tally_.report.unknown_words = s.unknown;
  return {at, tally_.keep(out.first(count)), count < out.size()};
}

}  // namespace

std::unique_ptr<EventSource> make_evt2_reader(ByteReader input, std::string name,
                                              std::optional<SensorSize> sensor) {
  return std::make_unique<Evt2Reader>(std::move(input), std::move(name), sensor);
}

bool looks_like_evt2(std::span<const uint8_t> bytes) {
  WordCheck<evt2::kTimeHighBits> check;
  for (size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    const auto word = load_little_endian<uint32_t>(bytes.data() + at);
    switch (word >> 28) {
      case evt2::kOff:
      case evt2::kOn:
        check.event();
        break;
      case evt2::kTimeHigh:
        check.time_high(word & (evt2::TimeHigh::kRange - 1));
        break;
      case evt2::kTrigger:
      case evt2::kImu:
      case evt2::kOthers:
      case evt2::kContinued:
        check.other();
        break;
      default:
        check.undefined();
    }
  }
  constexpr uint32_t kOneSecond = 1'000'000 >> evt2::kTimeLowBits;
  return check.plausible(kOneSecond);
}

}  // namespace scarf
