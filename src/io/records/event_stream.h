// Event Stream 2: its header and the codes of its DVS and ATIS events, for reader and writer.
// Source: neuromorphicsystems/event_stream, "The Event Stream file format".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scarf::event_stream {

inline constexpr std::string_view kMagic = "Event Stream";
inline constexpr uint8_t kMajorVersion = 2;

/// Magic, three bytes of the version, type; types but generic have width and height behind it.
inline constexpr size_t kTypeAt = kMagic.size() + 3;
inline constexpr size_t kSizeAt = kTypeAt + 1;
inline constexpr size_t kHeaderBytes = kSizeAt + 4;

enum Type : uint8_t { kGeneric = 0, kDvs = 1, kAtis = 2, kAmd = 3, kColor = 4 };

/// An event is a byte, x and y; y counts from the bottom row.
inline constexpr size_t kEventBytes = 5;

inline constexpr uint8_t kDvsReset = 0xFE;
inline constexpr uint8_t kDvsOverflow = 0xFF;
/// Microseconds of one overflow byte; an event's own byte holds less.
inline constexpr int64_t kDvsOverflowTime = 127;

/// ATIS: a byte with these bits all set is an overflow of 63 us times its lower bits, or a reset if those are
/// 0.
inline constexpr uint8_t kAtisOverflowMask = 0xFC;
inline constexpr int64_t kAtisOverflowTime = 63;

}  // namespace scarf::event_stream
