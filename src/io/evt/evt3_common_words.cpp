#include "io/evt/evt3_common_words.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/little_endian.h"
#include "io/base/put_event.h"
#include "io/evt/evt3.h"

namespace scarf::evt3 {
namespace {

constexpr size_t kWordBytes = 2;

// The event of the last column, in the form of event_fields, and above it the lower bits of the time: one
// number, of which a word replaces some bits.
constexpr int kRowShift = 16;
constexpr int kPolarityShift = 32;
constexpr int kTimeShift = 40;
constexpr uint64_t kFieldsMask = (uint64_t{1} << kTimeShift) - 1;
constexpr uint64_t kRowMask = uint64_t{0xFFFF} << kRowShift;

// What a word does, by its upper five bits.
struct Rule {
  uint64_t keep = ~uint64_t{0};  // the bits that it leaves
  uint64_t scale = 0;            // the word times this and plus the next are the others
  uint64_t add = 0;
  uint32_t bytes = 0;         // of output: sizeof(Event) or 0
  uint32_t stop = kTypeMask;  // no common word if it differs in these bits from a repeated TIME_HIGH
  static constexpr uint32_t kTypeMask = 0xF000;
};

constexpr std::array<Rule, 32> make_rules() {
  std::array<Rule, 32> rules;
  for (uint32_t upper = 0; upper < rules.size(); ++upper) {
    const uint64_t type = uint64_t{upper} >> 1 << 12;
    const uint64_t bit_11 = upper & 1;
    // The type is subtracted where it has been shifted to, and bit 11 where it is not part of the payload.
    const uint64_t not_coordinate = type | bit_11 << 11;
    Rule& rule = rules[upper];
    switch (upper >> 1) {
      case kAddrY:
        rule = {~kRowMask, uint64_t{1} << kRowShift, 0 - (not_coordinate << kRowShift), 0, 0};
        break;
      case kAddrX:
        rule = {~(kFieldsMask ^ kRowMask), 1, (bit_11 << kPolarityShift) - not_coordinate, sizeof(Event), 0};
        break;
      case kTimeLow:
        rule = {kFieldsMask, uint64_t{1} << kTimeShift, 0 - (type << kTimeShift), 0, 0};
        break;
      case kTimeHigh:
        rule.stop = kPayloadMask;
        break;
      case kContinued4:
      case kTrigger:
      case kImu:
      case kOthers:
      case kContinued12:
        rule.stop = 0;
        break;
      default:
        break;
    }
  }
  return rules;
}

constexpr std::array<Rule, 32> kRules = make_rules();

struct Place {
  const uint8_t* word;
  Event* event;
  uint64_t state;
};

// The words of kRules, up to `end`. Each writes an event, though only columns step beyond it.
Place decode_singles(Place at, const uint8_t* end, int64_t base, uint32_t repeated_high) {
  const uint8_t* word_at = at.word;
  auto* event = reinterpret_cast<unsigned char*>(at.event);
  uint64_t state = at.state;
  for (; word_at < end; word_at += kWordBytes) {
    const uint32_t word = load_little_endian<uint16_t>(word_at);
    const Rule& rule = kRules[word >> 11];
    if (((word ^ repeated_high) & rule.stop) != 0) break;
    state = (state & rule.keep) | (word * rule.scale + rule.add);
    put_event(*reinterpret_cast<Event*>(event), base | static_cast<int64_t>(state >> kTimeShift),
              state & kFieldsMask);
    event += rule.bytes;
  }
  return {word_at, reinterpret_cast<Event*>(event), state};
}

constexpr uint32_t kVect12Pixels = 12;
constexpr uint32_t kVect8Pixels = 8;

// VECT_12, VECT_12, VECT_8: how cameras send the pixels of 32 columns.
constexpr size_t kGroupBytes = 3 * kWordBytes;
constexpr uint32_t kGroupPixels = 2 * kVect12Pixels + kVect8Pixels;

// What decode_vectors needs: a base and eight bytes behind it, and room for all pixels of a group.
constexpr ptrdiff_t kBytesLoaded = kWordBytes + sizeof(uint64_t);
constexpr ptrdiff_t kEventsWritten = kGroupPixels;

bool is_group(uint64_t words) {
  constexpr uint64_t kTypes = 0xF000'F000'F000;
  constexpr uint64_t kGroup = uint64_t{kVect8} << 44 | uint64_t{kVect12} << 28 | uint64_t{kVect12} << 12;
  return (words & kTypes) == kGroup;
}

uint32_t group_bits(uint64_t words) {
  return static_cast<uint32_t>((words & 0xFFF) | (words >> 16 & 0xFFF) << 12 | (words >> 32 & 0xFF) << 24);
}

// Writes an event for each bit; `fields` are those of bit 0. Returns the number of events.
size_t write_vector(uint32_t bits, int64_t t, uint64_t fields, Event* out) {
  // Most vectors have few events, whose number no branch predictor learns: hence some at once, without a
  // branch. What is written for no bit is not counted.
  constexpr size_t kAtOnce = 4;
  static_assert(kEventsWritten % kAtOnce == 0, "else more is written than there are pixels");
  size_t count = 0;
  do {
    for (size_t i = 0; i < kAtOnce; ++i) {
      put_event(out[count], t, fields + static_cast<uint64_t>(std::countr_zero(bits)));
      count += bits != 0 ? 1 : 0;
      bits &= bits - 1;
    }
  } while (bits != 0);
  return count;
}

// A base and a group behind it, or one of the two, or a vector that belongs to no group. Returns whether
// there was one of these.
bool decode_vectors(Place& at, Said& said) {
  uint32_t word = load_little_endian<uint16_t>(at.word);
  const bool is_base = word >> 12 == kVectBaseX;
  if (is_base) {
    said.vector_x = word & kCoordinateMask;
    said.vector_p = word >> 11 & 1;
    at.word += kWordBytes;
    word = load_little_endian<uint16_t>(at.word);
  }
  const uint32_t type = word >> 12;
  if ((type != kVect12 && type != kVect8) || said.vector_x + kGroupPixels > kLastVectorX) return is_base;
  const auto words = load_little_endian<uint64_t>(at.word);
  const int64_t t = said.base | static_cast<int64_t>(at.state >> kTimeShift);
  const uint64_t fields = (at.state & kRowMask) | event_fields(said.vector_x, 0, said.vector_p);
  if (is_group(words)) {
    at.event += write_vector(group_bits(words), t, fields, at.event);
    said.vector_x += kGroupPixels;
    at.word += kGroupBytes;
  } else {
    at.event += write_vector(word & (type == kVect12 ? 0xFFF : 0xFF), t, fields, at.event);
    said.vector_x += type == kVect12 ? kVect12Pixels : kVect8Pixels;
    at.word += kWordBytes;
  }
  return true;
}

}  // namespace

CommonWords decode_common_words(std::span<const uint8_t> bytes, std::span<Event> out, Said& said) {
  const uint32_t repeated_high = uint32_t{kTimeHigh} << 12 | said.high;
  const uint8_t* const words_end = bytes.data() + bytes.size() / kWordBytes * kWordBytes;
  const Event* const events_end = out.data() + out.size();
  Place at = {bytes.data(), out.data(), uint64_t{said.low} << kTimeShift | event_fields(0, said.y, 0)};
  for (;;) {
    // Each of these is at most one event, so that there is room.
    const ptrdiff_t singles = std::min((words_end - at.word) / ptrdiff_t{kWordBytes}, events_end - at.event);
    if (singles == 0) break;
    const uint8_t* const singles_end = at.word + singles * ptrdiff_t{kWordBytes};
    at = decode_singles(at, singles_end, said.base, repeated_high);
    if (at.word == singles_end) continue;
    if (words_end - at.word < kBytesLoaded || events_end - at.event < kEventsWritten) break;
    if (!decode_vectors(at, said)) break;
  }
  said.y = static_cast<uint32_t>((at.state & kRowMask) >> kRowShift);
  said.low = static_cast<uint32_t>(at.state >> kTimeShift);
  return {static_cast<size_t>(at.word - bytes.data()), static_cast<size_t>(at.event - out.data())};
}

}  // namespace scarf::evt3
