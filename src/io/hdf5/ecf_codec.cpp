#include "io/hdf5/ecf_codec.h"

#include <algorithm>

#include "core/little_endian.h"
#include "core/text.h"

namespace scarf::hdf5 {
namespace {

// Bytes from the front of a chunk; beyond its end there are zeros, and ok() is false.
class Bytes {
 public:
  explicit Bytes(std::span<const uint8_t> bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  template <class T>
  T take() {
    if (rest_.size() < sizeof(T)) [[unlikely]] {
      ok_ = false;
      rest_ = {};
      return 0;
    }
    const T value = load_little_endian<T>(rest_.data());
    rest_ = rest_.subspan(sizeof(T));
    return value;
  }

 private:
  std::span<const uint8_t> rest_;
  bool ok_ = true;
};

// Each of these ends: a turn takes bytes, and bytes beyond the end of the chunk set ok() to false.

bool decode_times(Bytes& bytes, std::span<Event> events) {
  // Unsigned: hostile steps wrap around.
  auto t = bytes.take<uint64_t>();
  for (size_t i = 0; i < events.size() && bytes.ok();) {
    auto v = bytes.take<uint8_t>();
    if (v >> 4 == 15) {
      // A long step in nibbles, the low one first; the byte behind them is an ordinary one.
      uint64_t step = 0;
      for (unsigned shift = 0; v >> 4 == 15 && bytes.ok(); shift += 4) {
        if (shift < 64) step |= uint64_t{v & 15U} << shift;
        v = bytes.take<uint8_t>();
      }
      t += step;
    }
    t += v >> 4;
    size_t count = v & 15U;
    if (count == 15) count = bytes.take<uint16_t>();
    if (count > events.size() - i) return false;
    for (const size_t end = i + count; i < end; ++i) events[i].t = static_cast<int64_t>(t);
  }
  return bytes.ok();
}

void set_xp(Event& e, uint32_t packed) {
  e.x = (packed >> 1) & 0x7FF;
  e.p = packed & 1;
}

void set_yxp(Event& e, uint32_t packed) {
  set_xp(e, packed);
  e.y = (packed >> 12) & 0xFFF;
}

// Groups of four values in three words of `Word`, the last group padded.
template <class Word, class Set>
bool decode_groups(Bytes& bytes, std::span<Event> events, Set set) {
  constexpr unsigned kBits = sizeof(Word) * 8;
  constexpr unsigned kPart = kBits / 4;  // a value has three of these
  for (size_t i = 0; i < events.size(); i += 4) {
    const uint32_t a = bytes.take<Word>();
    const uint32_t b = bytes.take<Word>();
    const uint32_t c = bytes.take<Word>();
    constexpr uint32_t kLow = (1U << kPart) - 1;
    constexpr uint32_t kLow2 = (1U << 2 * kPart) - 1;
    constexpr uint32_t kLow3 = (1U << 3 * kPart) - 1;
    const uint32_t values[4] = {a >> kPart, (a & kLow) | (b >> 2 * kPart << kPart),
                                (b & kLow2) | (c >> 3 * kPart << 2 * kPart), c & kLow3};
    const size_t count = std::min<size_t>(4, events.size() - i);
    for (size_t k = 0; k < count; ++k) set(events[i + k], values[k]);
  }
  return bytes.ok();
}

bool decode_rows(Bytes& bytes, std::span<Event> events) {
  for (size_t i = 0; i < events.size() && bytes.ok();) {
    const auto v = bytes.take<uint16_t>();
    size_t count = v & 31U;
    if (count == 31) count = bytes.take<uint16_t>();
    if (count > events.size() - i) return false;
    for (const size_t end = i + count; i < end; ++i) events[i].y = v >> 5;
  }
  return bytes.ok();
}

bool decode_columns(Bytes& bytes, std::span<Event> events) {
  for (size_t i = 0; i < events.size() && bytes.ok();) {
    const auto v = bytes.take<uint16_t>();
    const auto x = static_cast<uint16_t>(v >> 5);
    events[i++].x = x;
    for (uint16_t j = 0; j < 5; ++j) {
      if ((v >> (4 - j) & 1) == 0) continue;
      if (i == events.size()) return false;
      events[i++].x = static_cast<uint16_t>(x + j + 1);
    }
  }
  return bytes.ok();
}

bool decode_polarities(Bytes& bytes, std::span<Event> events) {
  for (size_t i = 0; i < events.size() && bytes.ok();) {
    const auto v = bytes.take<uint8_t>();
    size_t count = v & 127U;
    if (count == 127) count = bytes.take<uint16_t>();
    if (count > events.size() - i) return false;
    for (const size_t end = i + count; i < end; ++i) events[i].p = v >> 7;
  }
  return bytes.ok();
}

bool decode_coordinates(Bytes& bytes, uint32_t header, std::span<Event> events) {
  const bool packed_yxp = (header & 2) != 0;
  const bool packed_xp = (header & 1) != 0;
  if (packed_yxp) return decode_groups<uint32_t>(bytes, events, set_yxp);
  if (!decode_rows(bytes, events)) return false;
  if (packed_xp) return decode_groups<uint16_t>(bytes, events, set_xp);
  return decode_columns(bytes, events) && decode_polarities(bytes, events);
}

}  // namespace

Result<void> decode_ecf(std::span<const uint8_t> chunk, std::vector<Event>& events) {
  events.clear();
  Bytes bytes(chunk);
  const auto header = bytes.take<uint32_t>();
  const size_t count = header >> 2;
  if (!bytes.ok() || count > kEcfMaxEvents) {
    return Error{ErrorCode::bad_input, text("no ECF chunk of 0 to ", kEcfMaxEvents, " events")};
  }
  events.resize(count);
  const std::span<Event> all(events);
  const bool good = decode_times(bytes, all) && decode_coordinates(bytes, header, all);
  if (good) return {};
  events.clear();
  return Error{ErrorCode::bad_input, text("its ECF runs do not give the ", count, " events it announces")};
}

}  // namespace scarf::hdf5
