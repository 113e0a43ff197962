// Reader of EVT2 words.

#include <optional>
#include <utility>

#include "core/little_endian.h"
#include "io/base/buffered_source.h"
#include "io/base/decoded_triggers.h"
#include "io/base/known_formats.h"
#include "io/base/put_event.h"
#include "io/base/writers.h"
#include "io/evt/evt2.h"
#include "io/evt/evt_format.h"
#include "io/evt/word_check.h"
#include "io/evt/word_guess.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "evt2";

class Evt2Reader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  // Copied into decode() and back, so that the compiler can hold it in registers while events are written.
  struct State {
    evt2::Clock clock;
    uint32_t skip = 0;  // words left of an IMU block
    uint64_t unknown = 0;

    void other_word(uint32_t word) {
      switch (word >> 28) {
        case evt2::kTimeHigh:
          clock.set_high(word);
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
    } else if (type <= evt2::kOn && s.clock.started()) {
      put_event(out[count++], s.clock.time(word >> 22), word >> 11 & evt2::kCoordinateMask,
                word & evt2::kCoordinateMask, type);
    } else if (type == evt2::kTimeHigh || s.clock.started()) {
      s.other_word(word);
    }
  }
  state_ = s;
  tally_.report.unknown_words = s.unknown;
  if (s.clock.started()) tally_.set_first_high(s.clock.first_high());
  return {at, tally_.keep(out.first(count)), count < out.size()};
}

class Evt2Triggers {
 public:
  std::optional<Trigger> take(uint32_t word) {
    if (skip_ > 0) return --skip_, std::nullopt;
    const uint32_t type = word >> 28;
    if (type == evt2::kTimeHigh) clock_.set_high(word);
    if (type == evt2::kImu && clock_.started()) skip_ = evt2::kImuWords - 1;
    if (type != evt2::kTrigger || !clock_.started()) return std::nullopt;
    return evt2_trigger(clock_, word);
  }

 private:
  evt2::Clock clock_;
  uint32_t skip_ = 0;  // words left of an IMU block
};

Result<std::unique_ptr<TriggerSource>> open_evt2_triggers(Input input, const ReadOptions& options) {
  return make_decoded_triggers(std::move(input), options,
                               TriggersByWord<uint32_t, Evt2Triggers>(Evt2Triggers()));
}

}  // namespace

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
  return check.plausible(evt2::kTimeHighsPerSecond);
}

bool time_highs_at_every_place(std::span<const uint8_t> bytes) {
  uint64_t count[2] = {0, 0};
  for (size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    const auto word = load_little_endian<uint32_t>(bytes.data() + at);
    count[at / 4 % 2] += word >> 28 == evt2::kTimeHigh ? 1 : 0;
  }
  return count[0] > 0 && count[0] <= 3 * count[1] && count[1] <= 3 * count[0];
}

const Format kEvt2Format =
    evt_format<kName>("Prophesee RAW, EVT2", open_evt<Evt2Reader>, create_evt2, open_evt2_triggers);

}  // namespace scarf
