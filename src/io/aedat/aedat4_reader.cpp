// Reader of the events of AEDAT4.

#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/aedat/aedat4.h"
#include "io/base/block_source.h"
#include "io/base/known_formats.h"
#include "io/base/sensor_size.h"

namespace scarf {
namespace {

using aedat4::Packets;

constexpr std::string_view kName = "aedat4";

class Aedat4Reader final : public BlockSource {
 public:
  Aedat4Reader(std::string name, std::optional<SensorSize> sensor, const ReadOptions& options,
               Packets packets)
      : BlockSource(std::move(name), sensor, options), packets_(std::move(packets)) {}

  std::string_view format() const override { return kName; }
  uint64_t bytes_read() const override { return packets_.consumed(); }
  uint64_t bytes_total() const override { return packets_.total(); }

 protected:
  Result<bool> next(std::vector<Event>& block) override;

 private:
  void decode(uint64_t place, std::span<const uint8_t> records, std::vector<Event>& block);

  Packets packets_;
};

constexpr size_t kRecordBytes = 16;  // t, x, y, polarity and padding

Result<bool> Aedat4Reader::next(std::vector<Event>& block) {
  const auto packet = packets_.next();
  if (!packet) return packet.error();
  if (!*packet) return false;
  const aedat4::Packet& p = **packet;
  tally_.report.truncated_bytes += p.truncated;
  if (!p.content) {
    tally_.note_damage(p.byte, p.damage);
    return true;
  }
  const auto records = p.content->vector(0, kRecordBytes);
  if (!records)
    tally_.note_damage(p.byte, "the packet's events lie outside it");
  else
    decode(p.byte, *records, block);
  return true;
}

void Aedat4Reader::decode(uint64_t place, std::span<const uint8_t> records, std::vector<Event>& block) {
  block.reserve(records.size() / kRecordBytes);
  for (size_t at = 0; at < records.size(); at += kRecordBytes) {
    const uint8_t* const record = records.data() + at;
    const auto t = load_little_endian<int64_t>(record);
    if (t <= -kMaxTime || t >= kMaxTime) [[unlikely]] {
      ++tally_.report.unknown_words;
      if (tally_.strict()) {
        tally_.fail(
            {ErrorCode::bad_input,
             text("the packet at byte ", place,
                  " has a time that scarf does not hold; leave out ReadOptions::strict to pass over it")});
      }
      continue;
    }
    if (record[12] > 1) [[unlikely]] {
      tally_.leave_out_polarity("the packet at byte", place);
      continue;
    }
    // Coordinates have a sign in the file. As unsigned numbers negative ones are beyond every sensor.
    block.push_back(
        {t, load_little_endian<uint16_t>(record + 8), load_little_endian<uint16_t>(record + 10), record[12]});
  }
}

Result<std::unique_ptr<EventSource>> open_aedat4(Input input, const ReadOptions& options) {
  const std::string name = input.name;
  auto packets = Packets::open(std::move(input), options, "EVTS", "event streams");
  if (!packets) return packets.error();
  const auto sensor = agreed_sensor(packets->stream().sensor, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<Aedat4Reader>(name, *sensor, options, *std::move(packets)));
}

bool recognise_aedat4(const Beginning& beginning) {
  const std::string_view start(reinterpret_cast<const char*>(beginning.bytes.data()), beginning.bytes.size());
  return start.starts_with(aedat4::kMagic);
}

}  // namespace

const Format kAedat4Format = {.name = kName,
                              .title = aedat4::kTitle,
                              .options = kTakesStream,
#ifndef SCARF_HAS_PUGIXML
                              .missing = "pugixml (Debian: libpugixml-dev)",
#endif
                              .recognise = recognise_aedat4,
                              .open = open_aedat4,
                              .open_frames = aedat4::open_frames,
                              .open_triggers = aedat4::open_triggers};

}  // namespace scarf
