// Reader of EVT2 words.

#include <utility>

#include "core/little_endian.h"
#include "io/buffered_source.h"
#include "io/evt2.h"
#include "io/known_formats.h"
#include "io/sensor_size.h"
#include "io/word_check.h"
#include "io/word_guess.h"
#include "io/writers.h"

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
    evt2::TimeHigh time_high;
    int64_t time = -1;        // of time_high, microseconds; negative before the first word of it
    int64_t first_high = -1;  // the first value of `time`
    uint32_t skip = 0;        // words left of an IMU block
    uint64_t unknown = 0;

    void other_word(uint32_t word) {
      switch (word >> 28) {
        case evt2::kTimeHigh:
          time_high.set(word & (evt2::TimeHigh::kRange - 1));
          time = static_cast<int64_t>((time_high.unwrapped() << evt2::kTimeLowBits) & INT64_MAX);
          if (first_high < 0) first_high = time;
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
  if (s.first_high >= 0) tally_.set_first_high(s.first_high);
  return {at, tally_.keep(out.first(count)), count < out.size()};
}

Result<std::unique_ptr<EventSource>> open_evt2(Input input, const ReadOptions& options) {
  const auto sensor = agreed_sensor(input.header ? input.header->sensor : std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<Evt2Reader>(std::move(input.bytes), std::move(input.name), *sensor, options));
}

bool recognise_evt2(const Beginning& beginning) {
  return beginning.last && guess_words(beginning.bytes) == kName;
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
  constexpr uint32_t kOneSecond = 1'000'000 >> evt2::kTimeLowBits;
  return check.plausible(kOneSecond);
}

const Format kEvt2Format = {.name = kName,
                            .title = "Prophesee RAW, EVT2",
                            .options = kTakesFirstHigh,
                            .prophesee = true,
                            .recognise = recognise_evt2,
                            .open = open_evt2,
                            .create = create_evt2};

}  // namespace scarf
