// Reader of EVT3 words.

#include <utility>

#include "core/little_endian.h"
#include "io/base/buffered_source.h"
#include "io/base/decoded_triggers.h"
#include "io/base/known_formats.h"
#include "io/base/writers.h"
#include "io/evt/evt3.h"
#include "io/evt/evt3_decoder.h"
#include "io/evt/evt_format.h"
#include "io/evt/word_check.h"
#include "io/evt/word_guess.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "evt3";

class Evt3Reader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  evt3::EventDecoder decoder_;
};

BufferedSource::Decoded Evt3Reader::decode(std::span<const uint8_t> bytes, bool /*last*/,
                                           std::span<Event> out) {
  const auto decoded = decoder_.decode(bytes, out);
  tally_.report.unknown_words = decoder_.unknown_words();
  tally_.report.gaps = decoder_.clock().gaps();
  if (const auto first = decoder_.clock().first_high()) tally_.set_first_high(*first);
  return {decoded.bytes, tally_.keep(out.first(decoded.events)), decoded.events < out.size()};
}

Result<std::unique_ptr<TriggerSource>> open_evt3_triggers(Input input, const ReadOptions& options) {
  return make_decoded_triggers(std::move(input), options, evt3::TriggerDecoder());
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

const Format kEvt3Format =
    evt_format<kName>("Prophesee RAW, EVT3", open_evt<Evt3Reader>, create_evt3, open_evt3_triggers);

}  // namespace scarf
