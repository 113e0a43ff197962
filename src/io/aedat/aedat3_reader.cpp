// Reader of the events of AEDAT 3.1.

#include <utility>

#include "io/aedat/aedat3.h"
#include "io/base/block_source.h"
#include "io/base/known_formats.h"
#include "io/base/sensor_size.h"

namespace scarf {
namespace {

using aedat3::Packets;

constexpr std::string_view kName = "aedat3";
constexpr size_t kEventBytes = 8;  // a word and a time

class Aedat3Reader final : public BlockSource {
 public:
  Aedat3Reader(std::string name, std::optional<SensorSize> sensor, const ReadOptions& options,
               Packets packets)
      : BlockSource(std::move(name), sensor, options), packets_(std::move(packets)) {}

  std::string_view format() const override { return kName; }
  uint64_t bytes_read() const override { return packets_.consumed(); }
  uint64_t bytes_total() const override { return packets_.total(); }

 protected:
  Result<bool> next(std::vector<Event>& block) override {
    const auto packet = packets_.next(aedat3::kPolarity, kEventBytes);
    if (!packet) return packet.error();
    if (!*packet) return false;
    const aedat3::Packet& p = **packet;
    tally_.report.truncated_bytes += p.truncated;
    if (!p.damage.empty()) {
      tally_.note_damage(p.byte, p.damage);
    } else if (p.type == aedat3::kPolarity) {
      decode(p, block);
    } else {
      tally_.report.skipped += p.count;
    }
    return true;
  }

 private:
  void decode(const aedat3::Packet& packet, std::vector<Event>& block) {
    block.reserve(packet.count);
    for (uint32_t i = 0; i < packet.count; ++i) {
      const auto record = packet.record(i);
      if (!aedat3::is_valid(record)) {
        ++tally_.report.skipped;
        continue;
      }
      const auto t = packet.time(record, sizeof(uint32_t));
      if (!t) {
        ++tally_.report.unknown_words;
        continue;
      }
      const auto word = load_little_endian<uint32_t>(record.data());
      block.push_back({*t, static_cast<uint16_t>(word >> 17), static_cast<uint16_t>(word >> 2 & 0x7FFF),
                       static_cast<uint8_t>(word >> 1 & 1)});
    }
  }

  Packets packets_;
};

Result<std::unique_ptr<EventSource>> open_aedat3(Input input, const ReadOptions& options) {
  auto packets = Packets::open(std::move(input.bytes), options);
  if (!packets) return packets.error();
  const auto sensor = agreed_sensor(packets->source().sensor, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<Aedat3Reader>(std::move(input.name), *sensor, options, *std::move(packets)));
}

}  // namespace

const Format kAedat3Format = {
    .name = kName,
    .title = aedat3::kTitle,
    .options = kTakesStream,
    .recognise = [](const Beginning& beginning) { return starts_with(beginning.bytes, aedat3::kMagic); },
    .open = open_aedat3,
    .open_frames = aedat3::open_frames,
    .open_triggers = aedat3::open_triggers};

}  // namespace scarf
