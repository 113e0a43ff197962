#include "io/ros/ros_events.h"

#include <array>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/rounding.h"

namespace scarf {
namespace {

constexpr std::string_view kEvt3 = "evt3";
constexpr std::string_view kLibcaer = "libcaer";
constexpr std::string_view kLibcaerCmp = "libcaer_cmp";
constexpr std::string_view kMono = "mono";
constexpr std::string_view kTrigger = "trigger";

// Types of the words of libcaer_cmp, in the upper four bits.
enum LibcaerCmp : uint32_t { kTimeHigh, kTimeLow, kAddrX, kAddrY, kVectBaseY, kVect8 };

std::string objection(const RosEvents& message) {
  if (message.big_endian) return "the message's events are big-endian, which scarf does not read";
  return text("the message's encoding '", message.encoding.substr(0, 40), "' is none that scarf reads");
}

}  // namespace

bool holds_events(const RosEvents& message) {
  return message.type == RosType::event_array || message.encoding != kTrigger;
}

bool holds_triggers(const RosEvents& message) {
  return message.type == RosType::event_packet && message.encoding != kMono && message.encoding != kLibcaer &&
         message.encoding != kLibcaerCmp;
}

std::string RosEventDecoder::decode(const RosEvents& message, std::vector<Event>& events) {
  return message.type == RosType::event_array ? decode_array(message, events)
                                              : decode_packet(message, events);
}

std::string RosEventDecoder::decode_packet(const RosEvents& message, std::vector<Event>& events) {
  if (next_seq_ && *next_seq_ != message.seq) ++gaps_;
  next_seq_ = message.seq + 1;
  if (message.big_endian) return objection(message);
  size_t word = sizeof(uint16_t);
  if (message.encoding == kEvt3) {
    decode_evt3(message.payload, events);
  } else if (message.encoding == kLibcaerCmp) {
    decode_libcaer_cmp(message, events);
  } else if (message.encoding == kLibcaer) {
    word = sizeof(uint64_t);
    decode_libcaer(message, events);
  } else if (message.encoding == kMono) {
    word = sizeof(uint64_t);
    decode_mono(message, events);
  } else {
    return objection(message);
  }
  truncated_ += message.payload.size() % word;
  return "";
}

void RosEventDecoder::decode_evt3(std::span<const uint8_t> words, std::vector<Event>& events) {
  std::array<Event, 1024> piece;
  for (;;) {
    const auto decoded = evt3_.decode(words, piece);
    words = words.subspan(decoded.bytes);
    events.insert(events.end(), piece.begin(), piece.begin() + static_cast<ptrdiff_t>(decoded.events));
    if (decoded.events < piece.size()) break;
  }
}

void RosEventDecoder::decode_libcaer(const RosEvents& message, std::vector<Event>& events) {
  constexpr uint32_t kTimeMask = 0x7FFF'FFFF;
  uint64_t turns = 0;  // of the clock within this message, microseconds
  uint32_t previous = 0;
  for (size_t at = 0; at + 8 <= message.payload.size(); at += 8) {
    const auto data = load_little_endian<uint32_t>(message.payload.data() + at);
    const uint32_t t = load_little_endian<uint32_t>(message.payload.data() + at + 4) & kTimeMask;
    // The clock has 31 bits. A fall by half of them is a wrap, as the time base stays that of the first
    // event.
    if (t < previous && previous - t > kTimeMask / 2) turns += uint64_t{kTimeMask} + 1;
    previous = t;
    if ((data & 1) == 0) continue;  // marked as not valid
    events.push_back({microseconds_of(message.time_base + (turns + t) * 1000),
                      static_cast<uint16_t>(data >> 17), static_cast<uint16_t>(data >> 2 & 0x7FFF),
                      static_cast<uint8_t>(data >> 1 & 1)});
  }
}

void RosEventDecoder::decode_libcaer_cmp(const RosEvents& message, std::vector<Event>& events) {
  constexpr uint32_t kCoordinate = 0x7FF;
  uint32_t high = 0;
  uint32_t low = 0;
  int64_t t = microseconds_of(message.time_base);
  for (size_t at = 0; at + 2 <= message.payload.size(); at += 2) {
    const uint32_t word = load_little_endian<uint16_t>(message.payload.data() + at);
    switch (word >> 12) {
      case kTimeHigh:
        high = (word & 0xFFF) << 12;
        t = microseconds_of(message.time_base + uint64_t{high | low} * 1000);
        break;
      case kTimeLow:
        low = word & 0xFFF;
        t = microseconds_of(message.time_base + uint64_t{high | low} * 1000);
        break;
      case kAddrX:
        x_ = static_cast<uint16_t>(word & kCoordinate);
        break;
      case kAddrY:
        events.push_back(
            {t, x_, static_cast<uint16_t>(word & kCoordinate), static_cast<uint8_t>(word >> 11 & 1)});
        break;
      case kVectBaseY:
        base_y_ = static_cast<uint16_t>(word & kCoordinate);
        base_p_ = static_cast<uint8_t>(word >> 11 & 1);
        break;
      case kVect8:
        for (uint32_t i = 0; i < 8; ++i) {
          if (word >> i & 1) events.push_back({t, x_, static_cast<uint16_t>(base_y_ + i), base_p_});
        }
        // Beyond every sensor the base stops, so that rows never wrap back into it.
        if (base_y_ < 0xF000) base_y_ = static_cast<uint16_t>(base_y_ + 8);
        break;
      default:
        ++unknown_;
    }
  }
}

void RosEventDecoder::decode_mono(const RosEvents& message, std::vector<Event>& events) {
  for (size_t at = 0; at + 8 <= message.payload.size(); at += 8) {
    const auto word = load_little_endian<uint64_t>(message.payload.data() + at);
    events.push_back({microseconds_of(message.time_base + (word & 0xFFFF'FFFF)),
                      static_cast<uint16_t>(word >> 32), static_cast<uint16_t>(word >> 48 & 0x7FFF),
                      static_cast<uint8_t>(word >> 63)});
  }
}

std::string RosEventDecoder::decode_array(const RosEvents& message, std::vector<Event>& events) {
  RosCursor cursor = *message.events;
  for (uint32_t i = 0; i < message.count; ++i) {
    Event event;
    event.x = cursor.number<uint16_t>();
    event.y = cursor.number<uint16_t>();
    const auto seconds = cursor.number<uint32_t>();
    const auto nanoseconds = cursor.number<uint32_t>();
    event.t = microseconds_of(uint64_t{seconds} * 1'000'000'000 + nanoseconds);
    event.p = cursor.number<uint8_t>();
    if (cursor.failed()) return text("the message ends within event ", i, " of ", message.count);
    if (event.p > 1) {
      ++undefined_;
      continue;
    }
    events.push_back(event);
  }
  return "";
}

std::string RosTriggerDecoder::decode(const RosEvents& message, std::vector<Trigger>& triggers) {
  if (message.big_endian) return objection(message);
  if (message.encoding == kEvt3) {
    auto words = message.payload;
    std::array<Trigger, 256> piece;
    for (;;) {
      const auto decoded = evt3_.decode(words, piece);
      words = words.subspan(decoded.bytes);
      triggers.insert(triggers.end(), piece.begin(),
                      piece.begin() + static_cast<ptrdiff_t>(decoded.triggers));
      if (decoded.triggers < piece.size()) break;
    }
    return "";
  }
  if (message.encoding != kTrigger) return objection(message);
  for (size_t at = 0; at + 8 <= message.payload.size(); at += 8) {
    const auto word = load_little_endian<uint64_t>(message.payload.data() + at);
    triggers.push_back({microseconds_of(message.time_base + (word & 0xFFFF'FFFF)),
                        static_cast<uint16_t>(word >> 48 & 0x7FFF), static_cast<uint8_t>(word >> 63)});
  }
  return "";
}

}  // namespace scarf
