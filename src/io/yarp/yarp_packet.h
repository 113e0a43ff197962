// Packets of YARP event-driven logs: a line of the log as events.
// Source: robotology/event-driven, codec.h and comms.h (version 2); bimvee's importIitYarp (version 1).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scarf {

/// A record of a packet. Words are little-endian: p b0 (0 is brighter), x b11..1, y b21..12, channel b22.
struct YarpRecord {
  uint32_t word = 0;
  std::optional<uint32_t> ticks;  ///< of 80 ns, 31 bits
};

struct YarpPacket {
  int64_t stamp = 0;                ///< microseconds: when the packet was complete
  int64_t duration = 0;             ///< microseconds; version 2 only
  bool escaped = false;             ///< version 2
  std::vector<YarpRecord> records;  ///< of version 1
  std::string bytes;                ///< of version 2: the records as they are
};

enum class YarpLine {
  packet,
  other,   ///< what else the log holds: IMU samples, skin, flow, ...
  broken,  ///< none of the log's lines, or cut short
};

/// Reads a line, without its end.
YarpLine parse_yarp_line(std::string_view line, YarpPacket& packet);

/// How the records of a log of version 2 are coded: all of it alike.
enum class YarpCoding { plain, timed };

/// Bits of a record's word that are always 0.
inline constexpr uint32_t kYarpFill = 0xFC000000;

/// Finds the coding from the beginning of a log: 8 bytes with times if every packet reads so, with times in
/// order, and either there are many records or they do not read as 4 bytes.
YarpCoding guess_yarp_coding(std::span<const YarpPacket> packets);

}  // namespace scarf
