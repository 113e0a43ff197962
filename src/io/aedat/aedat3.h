// AEDAT 3.1, of cAER and early DV: packets of one kind of record, all numbers little-endian.
// Sources: iniVation, "AEDAT 3.1"; inivation/libcaer (events/common.h, polarity.h, special.h, frame.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/little_endian.h"
#include "io/base/format.h"

namespace scarf::aedat3 {

inline constexpr std::string_view kMagic = "#!AER-DAT3.1";
inline constexpr std::string_view kTitle = "AEDAT 3.1";

enum Type : int16_t { kSpecial = 0, kPolarity = 1, kFrame = 2 };

/// A camera that the header names.
struct Source {
  int16_t id = 0;
  std::string name;
  std::optional<SensorSize> sensor;  ///< of its chip; nullopt if scarf does not know that
};

/// A packet of the chosen source.
struct Packet {
  uint64_t byte = 0;       ///< of its header in the file
  std::string damage;      ///< what is wrong with it; there are no records then
  uint64_t truncated = 0;  ///< bytes that cannot be read because of the damage
  int16_t type = kPolarity;
  uint32_t count = 0;       ///< of records
  size_t record_bytes = 0;  ///< of each
  int64_t turns = 0;        ///< of the clock of 31 bits, in microseconds: times of records count from here
  std::span<const uint8_t> records;  ///< of types that were asked for; live until the next packet

  std::span<const uint8_t> record(uint32_t i) const {
    return records.subspan(i * record_bytes, record_bytes);
  }
  /// The time at a place of a record; nullopt for what no clock shows.
  std::optional<int64_t> time(std::span<const uint8_t> record, size_t at) const {
    const auto t = load_little_endian<int32_t>(record.data() + at);
    return t < 0 ? std::nullopt : std::optional(turns + t);
  }
};

/// Bit 0 of the first word of every record.
inline bool is_valid(std::span<const uint8_t> record) {
  return (record[0] & 1) != 0;
}

/// The packets of one source.
class Packets {
 public:
  /// Takes the header off the input and chooses the source that the options name. Errors: io; bad_input;
  /// illegal_parameter.
  static Result<Packets> open(ByteReader input, const ReadOptions& options);

  const Source& source() const { return source_; }
  uint64_t consumed() const { return input_.consumed(); }
  uint64_t total() const { return input_.total(); }

  /// The next packet of the source, whole or broken; nullopt at the end. Records come with packets of the
  /// type `wanted` only, whose records have `least` bytes or more (else the packet is broken). Errors: io.
  Result<std::optional<Packet>> next(Type wanted, size_t least);

 private:
  Packets(ByteReader input, std::vector<Source> sources, size_t chosen);

  Result<std::optional<Packet>> cut_short(uint64_t byte, std::string damage);

  ByteReader input_;
  std::vector<Source> sources_;
  Source source_;
  std::vector<uint8_t> records_;
  bool ended_ = false;
};

Result<std::unique_ptr<FrameSource>> open_frames(Input input, const ReadOptions& options);
Result<std::unique_ptr<TriggerSource>> open_triggers(Input input, const ReadOptions& options);

}  // namespace scarf::aedat3
