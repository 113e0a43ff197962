// Reader of EVT3 words.

#include <algorithm>
#include <bit>
#include <utility>

#include "core/little_endian.h"
#include "io/buffered_source.h"
#include "io/evt3.h"
#include "io/known_formats.h"
#include "io/sensor_size.h"
#include "io/word_check.h"
#include "io/word_guess.h"
#include "io/writers.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "evt3";

// `yes` (0 or 1) ? a : b, in a form that compilers do not turn into a branch.
uint32_t select(uint32_t yes, uint32_t a, uint32_t b) {
  return b ^ ((a ^ b) & (0 - yes));
}

class Evt3Reader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  // Copied into decode() and back, so that the compiler can hold it in registers while events are written.
  struct State {
    evt3::TimeHigh time_high;
    bool started = false;     // the first kTimeHigh was seen
    uint32_t brightness = 1;  // rows are of brightness changes, not of kOtherAddrY
    int64_t time_base = 0;    // of time_high, microseconds
    int64_t first_high = -1;  // what TimeShift::first_high subtracts; negative before it is known
    uint32_t time_low = 0;
    uint32_t y = 0;
    uint32_t base_x = 0;
    uint32_t base_p = 0;
    uint32_t vector_mask = 0;  // events of the last vector that did not fit the output yet ...
    uint32_t vector_x = 0;     // ... bit i of it being pixel vector_x + i
    uint64_t unknown = 0;

    int64_t time() const { return time_base | time_low; }

    void set_time_high(uint32_t value) {
      if (started && value == time_high.value()) return;
      started = true;
      time_high.set(value);
      time_low = 0;
      time_base = static_cast<int64_t>((time_high.unwrapped() << evt3::kTimeLowBits) & INT64_MAX);
      // OpenEB's rule: the TIME_HIGH before the first one.
      if (first_high < 0) first_high = std::max<int64_t>(time_base - (int64_t{1} << evt3::kTimeLowBits), 0);
    }

    void set_vector(uint32_t mask, uint32_t length) {
      // Beyond every sensor the base stops, so that coordinates never wrap back into it.
      constexpr uint32_t kLastBase = 0xF000;
      vector_mask = brightness ? mask : 0;
      vector_x = base_x;
      base_x = std::min(base_x + length, kLastBase);
    }

    size_t write_vector(std::span<Event> out) {
      size_t count = 0;
      while (vector_mask != 0 && count < out.size()) {
        const auto x = static_cast<uint16_t>(vector_x + static_cast<uint32_t>(std::countr_zero(vector_mask)));
        out[count++] = {time(), x, static_cast<uint16_t>(y), static_cast<uint8_t>(base_p)};
        vector_mask &= vector_mask - 1;
      }
      return count;
    }
  };

  State state_;
};

BufferedSource::Decoded Evt3Reader::decode(std::span<const uint8_t> bytes, bool /*last*/,
                                           std::span<Event> out) {
  State s = state_;
  size_t at = 0;
  while (!s.started && at + 2 <= bytes.size()) {
    const uint32_t word = load_little_endian<uint16_t>(bytes.data() + at);
    at += 2;
    if (word >> 12 == evt3::kTimeHigh) s.set_time_high(word & evt3::kPayloadMask);
  }
  size_t count = s.write_vector(out);
  for (; count < out.size() && at + 2 <= bytes.size(); at += 2) {
    const uint32_t word = load_little_endian<uint16_t>(bytes.data() + at);
    const uint32_t type = word >> 12;
    // Rows, columns and times come in an order that no branch predictor learns: hence without a branch.
    constexpr uint32_t kSingles = 1 << evt3::kAddrY | 1 << evt3::kAddrX | 1 << evt3::kTimeLow;
    if (kSingles >> type & 1) {
      out[count] = {s.time(), static_cast<uint16_t>(word & evt3::kCoordinateMask), static_cast<uint16_t>(s.y),
                    static_cast<uint8_t>(word >> 11 & 1)};
      count += uint32_t{type == evt3::kAddrX} & s.brightness;
      const uint32_t row = uint32_t{type == evt3::kAddrY};
      s.y = select(row, word & evt3::kCoordinateMask, s.y);
      s.brightness |= row;
      s.time_low = select(uint32_t{type == evt3::kTimeLow}, word & evt3::kPayloadMask, s.time_low);
      continue;
    }
    switch (type) {
      case evt3::kOtherAddrY:
        s.brightness = 0;
        break;
      case evt3::kVectBaseX:
        s.base_x = word & evt3::kCoordinateMask;
        s.base_p = word >> 11 & 1;
        break;
      case evt3::kVect12:
        s.set_vector(word & 0xFFF, 12);
        count += s.write_vector(out.subspan(count));
        break;
      case evt3::kVect8:
        s.set_vector(word & 0xFF, 8);
        count += s.write_vector(out.subspan(count));
        break;
      case evt3::kTimeHigh:
        s.set_time_high(word & evt3::kPayloadMask);
        break;
      case evt3::kContinued4:
      case evt3::kTrigger:
      case evt3::kImu:
      case evt3::kOthers:
      case evt3::kContinued12:
        break;
      default:
        s.unknown += word == evt3::kFillerWord ? 0 : 1;
    }
  }
  state_ = s;
  tally_.report.unknown_words = s.unknown;
  if (s.first_high >= 0) tally_.set_first_high(s.first_high);
  return {at, tally_.keep(out.first(count)), count < out.size()};
}

Result<std::unique_ptr<EventSource>> open_evt3(Input input, const ReadOptions& options) {
  const auto sensor = agreed_sensor(input.header ? input.header->sensor : std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<Evt3Reader>(std::move(input.bytes), std::move(input.name), *sensor, options));
}

bool recognise_evt3(const Beginning& beginning) {
  return beginning.last && guess_words(beginning.bytes) == kName;
}

}  // namespace

bool looks_like_evt3(std::span<const uint8_t> bytes) {
  WordCheck<evt3::kTimeHighBits> check;
  for (size_t at = 0; at + 2 <= bytes.size(); at += 2) {
    const uint32_t word = load_little_endian<uint16_t>(bytes.data() + at);
    switch (word >> 12) {
      case evt3::kAddrX:
      case evt3::kVect12:
      case evt3::kVect8:
        check.event();
        break;
      case evt3::kTimeHigh:
        check.time_high(word & evt3::kPayloadMask);
        break;
      case 0x9:
      case 0xB:
      case 0xC:
        check.undefined();
        break;
      default:
        check.other();
    }
  }
  constexpr uint32_t kSixtyMilliseconds = 60'000 >> evt3::kTimeLowBits;
  return check.plausible(kSixtyMilliseconds);
}

const Format kEvt3Format = {.name = kName,
                            .title = "Prophesee RAW, EVT3",
                            .options = kTakesFirstHigh,
                            .prophesee = true,
                            .recognise = recognise_evt3,
                            .open = open_evt3,
                            .create = create_evt3};

}  // namespace scarf
