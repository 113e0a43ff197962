// AEDAT4: packets of events, frames and triggers as FlatBuffers, each compressed on its own. Source:
// iniVation, "AEDAT 4.0"; the schemas of dv-processing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/aedat/flat_buffer.h"
#include "io/base/decompressor.h"
#include "io/base/format.h"

namespace scarf::aedat4 {

inline constexpr std::string_view kMagic = "#!AER-DAT4.0\r\n";
inline constexpr std::string_view kTitle = "AEDAT4";

/// What the file's header says of one of its streams.
struct Stream {
  int32_t id = 0;
  std::string type;  ///< the identifier of its packets: EVTS, FRME, IMUS, TRIG
  std::optional<SensorSize> sensor;
  std::string source;  ///< the camera
};

struct Header {
  Compression compression = Compression::none;
  int64_t table_position = -1;  ///< where the packets end; -1: not known, as of a recording that was cut off
  std::vector<Stream> streams;
};

/// Takes magic and header off the input. Errors: io; bad_input.
Result<Header> read_header(ByteReader& input);

/// A packet of the chosen stream.
struct Packet {
  uint64_t byte = 0;   ///< of its header in the file
  std::string damage;  ///< what is wrong with it; there is no `content` then
  uint64_t truncated =
      0;  ///< bytes that cannot be read because of the damage, as nothing says where packets begin
  std::optional<FlatTable> content;  ///< lives until the next packet
};

/// The packets of one stream.
class Packets {
 public:
  /// Chooses the stream with packets `type` that the options name. `what`: "event streams".
  static Result<Packets> open(Input input, const ReadOptions& options, std::string_view type,
                              std::string_view what);

  const Stream& stream() const { return stream_; }
  uint64_t consumed() const { return input_.consumed(); }
  uint64_t total() const { return input_.total(); }

  /// The next packet of the stream, whole or broken; nullopt at the end. Errors: io.
  Result<std::optional<Packet>> next();

 private:
  Packets(ByteReader input, Header header, Stream stream, Decompressor decompressor);

  Result<std::optional<Packet>> cut_short(uint64_t byte, std::string damage);
  std::optional<Packet> unpacked(uint64_t byte);

  ByteReader input_;
  Header header_;
  Stream stream_;
  Decompressor decompressor_;
  std::vector<uint8_t> packed_;
  bool ended_ = false;
};

/// The error of readers that have no report in which damage could stand.
Error damage_error(const std::string& name, const Packet& packet);

Result<std::unique_ptr<FrameSource>> open_frames(Input input, const ReadOptions& options);
Result<std::unique_ptr<TriggerSource>> open_triggers(Input input, const ReadOptions& options);

}  // namespace scarf::aedat4
