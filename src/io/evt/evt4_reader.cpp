// Reader of EVT4 words.

#include <optional>
#include <utility>

#include "core/little_endian.h"
#include "io/base/buffered_source.h"
#include "io/base/decoded_triggers.h"
#include "io/base/known_formats.h"
#include "io/base/writers.h"
#include "io/evt/evt4.h"
#include "io/evt/evt_format.h"
#include "io/evt/pixel_mask.h"
#include "io/evt/word_check.h"
#include "io/evt/word_guess.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "evt4";

bool announces_mask(uint32_t type) {
  return type == evt4::kVectorOff || type == evt4::kVectorOn;
}

class Evt4Reader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  Event event_of(uint32_t word, uint32_t polarity) const {
    return {clock_.time(word >> 22), static_cast<uint16_t>(word >> 11 & evt2::kCoordinateMask),
            static_cast<uint16_t>(word & evt2::kCoordinateMask), static_cast<uint8_t>(polarity)};
  }

  evt2::Clock clock_;
  bool mask_follows_ = false;
  PixelMask vector_;  // its bits: events of the last mask that did not fit the output yet
};

BufferedSource::Decoded Evt4Reader::decode(std::span<const uint8_t> bytes, bool /*last*/,
                                           std::span<Event> out) {
  size_t count = vector_.write(out);
  size_t at = 0;
  for (; count < out.size() && at + 4 <= bytes.size(); at += 4) {
    const auto word = load_little_endian<uint32_t>(bytes.data() + at);
    if (mask_follows_) {
      mask_follows_ = false;
      vector_.bits = clock_.started() ? word : 0;
      count += vector_.write(out.subspan(count));
      continue;
    }
    switch (const uint32_t type = word >> 28) {
      case evt4::kOff:
      case evt4::kOn:
        if (clock_.started()) out[count++] = event_of(word, type - evt4::kOff);
        break;
      case evt4::kVectorOff:
      case evt4::kVectorOn:
        mask_follows_ = true;
        vector_.first = event_of(word, type - evt4::kVectorOff);
        break;
      case evt4::kTimeHigh:
        clock_.set_high(word);
        break;
      case evt4::kOther:
      case evt4::kContinued:
      case evt4::kTrigger:
      case evt4::kPadding:
        break;
      default:
        tally_.report.unknown_words += clock_.started() ? 1 : 0;
    }
  }
  if (clock_.started()) tally_.set_first_high(clock_.first_high());
  return {at, tally_.keep(out.first(count)), count < out.size()};
}

class Evt4Triggers {
 public:
  std::optional<Trigger> take(uint32_t word) {
    if (std::exchange(mask_follows_, false)) return std::nullopt;
    const uint32_t type = word >> 28;
    mask_follows_ = announces_mask(type);
    if (type == evt4::kTimeHigh) clock_.set_high(word);
    if (type != evt4::kTrigger || !clock_.started()) return std::nullopt;
    return evt2_trigger(clock_, word);
  }

 private:
  evt2::Clock clock_;
  bool mask_follows_ = false;
};

Result<std::unique_ptr<TriggerSource>> open_evt4_triggers(Input input, const ReadOptions& options) {
  return make_decoded_triggers(std::move(input), options,
                               TriggersByWord<uint32_t, Evt4Triggers>(Evt4Triggers()));
}

}  // namespace

bool looks_like_evt4(std::span<const uint8_t> bytes) {
  constexpr uint32_t kPaddingWord = 0xFFFFFFFF;
  WordCheck<evt2::kTimeHighBits> check;
  for (size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    const auto word = load_little_endian<uint32_t>(bytes.data() + at);
    switch (word >> 28) {
      case evt4::kVectorOff:
      case evt4::kVectorOn:
        at += 4;  // the mask
        [[fallthrough]];
      case evt4::kOff:
      case evt4::kOn:
        check.event();
        break;
      case evt4::kTimeHigh:
        check.time_high(word & (evt2::TimeHigh::kRange - 1));
        break;
      case evt4::kOther:
      case evt4::kContinued:
      case evt4::kTrigger:
        check.other();
        break;
      default:
        word == kPaddingWord ? check.other() : check.undefined();
    }
  }
  return check.plausible(evt2::kTimeHighsPerSecond);
}

const Format kEvt4Format =
    evt_format<kName>("Prophesee RAW, EVT4", open_evt<Evt4Reader>, create_evt4, open_evt4_triggers);

}  // namespace scarf
