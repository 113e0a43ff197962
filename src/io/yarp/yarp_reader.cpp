// Reader of YARP event-driven logs, versions 1 and 2: data.log, or the folder with data.log and info.log.
// Source: robotology/event-driven; the log is the one of YARP's dumper.

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/block_source.h"
#include "io/base/columns.h"
#include "io/base/known_formats.h"
#include "io/base/look_ahead.h"
#include "io/base/rounding.h"
#include "io/base/sensor_size.h"
#include "io/yarp/yarp_packet.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "yarp";
constexpr std::string_view kData = "data.log";
constexpr std::string_view kInfo = "info.log";

// Of a line: a packet of a million records. Longer lines are passed over.
constexpr size_t kMaxPacket = size_t{16} << 20;

constexpr std::array<std::string_view, 2> kCameras = {"left", "right"};

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

// The camera's clock: ticks that wrap after 30 bits, or 31 if it was seen to have as many.
class Ticks {
 public:
  int64_t unwrapped(uint32_t ticks) {
    constexpr int64_t kRange = int64_t{1} << 30;
    const int64_t now = ticks & 0x7FFFFFFF;
    const int64_t range = last_ >= kRange ? 2 * kRange : kRange;
    if (last_ - now >= range / 2) turns_ += range;
    last_ = now;
    return turns_ + now;
  }

 private:
  int64_t last_ = 0;
  int64_t turns_ = 0;
};

// Lines of any length up to kMaxPacket.
class LogLines {
 public:
  explicit LogLines(ByteReader bytes) : bytes_(std::move(bytes)) {}

  struct Line {
    std::string text;
    uint64_t place = 0;  // of its first byte
    uint64_t bytes = 0;  // without its end
    bool whole = true;   // it has an end
  };

  // nullopt at the end of the log.
  Result<std::optional<Line>> next() {
    Line line;
    line.place = bytes_.consumed();
    for (;;) {
      if (const auto filled = bytes_.fill(1); !filled) return filled.error();
      const auto bytes = bytes_.available();
      const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      const size_t newline = all.find('\n');
      const std::string_view piece = all.substr(0, newline);
      line.bytes += piece.size();
      if (line.bytes <= kMaxPacket) line.text += piece;
      bytes_.skip(std::min(piece.size() + 1, all.size()));
      if (newline != all.npos) return std::optional(std::move(line));
      if (!all.empty()) continue;
      line.whole = false;
      return line.bytes > 0 ? std::optional(std::move(line)) : std::nullopt;
    }
  }

  const ByteReader& bytes() const { return bytes_; }

 private:
  ByteReader bytes_;
};

struct YarpOptions {
  YarpCoding coding = YarpCoding::plain;
  bool spread = false;
  bool microsecond_ticks = false;
  std::optional<size_t> camera;  // of kCameras, if one was chosen
};

class YarpReader final : public BlockSource {
 public:
  YarpReader(Input input, std::optional<SensorSize> sensor, const YarpOptions& yarp,
             const ReadOptions& options)
      : BlockSource(std::move(input.name), sensor, options),
        lines_(std::move(input.bytes)),
        yarp_(yarp),
        camera_(yarp.camera) {}

  std::string_view format() const override { return kName; }
  uint64_t bytes_read() const override { return lines_.bytes().consumed(); }
  uint64_t bytes_total() const override { return lines_.bytes().total(); }

 protected:
  Result<bool> next(std::vector<Event>& block) override {
    auto line = lines_.next();
    if (!line) return line.error();
    if (!*line) return false;
    read_line(**line, block);
    return true;
  }

 private:
  void read_line(const LogLines::Line& line, std::vector<Event>& block);
  void read_records(const LogLines::Line& line, std::vector<Event>& block);
  int64_t time_of(size_t record) const;
  int64_t microseconds(uint32_t ticks);

  LogLines lines_;
  YarpOptions yarp_;
  std::optional<size_t> camera_;  // chosen, or that of the first event
  YarpPacket packet_;
  Ticks ticks_;
};

void YarpReader::read_line(const LogLines::Line& line, std::vector<Event>& block) {
  if (line.bytes > kMaxPacket) {
    tally_.note_damage(line.place, text("a line of ", line.bytes, " bytes is too long for a packet"));
    return;
  }
  if (line.text.find_first_not_of(" \r") == std::string::npos) return;
  const YarpLine kind = parse_yarp_line(line.text, packet_);
  if (kind == YarpLine::broken) {
    if (!line.whole) tally_.report.truncated_bytes += line.bytes;
    tally_.note_damage(line.place, line.whole ? "this line is no packet" : "the log ends within a packet");
  }
  if (kind == YarpLine::packet) read_records(line, block);
}

void YarpReader::read_records(const LogLines::Line& line, std::vector<Event>& block) {
  auto& records = packet_.records;
  if (packet_.escaped) {
    const size_t size = yarp_.coding == YarpCoding::timed ? 8 : 4;
    if (packet_.bytes.size() % size != 0) {
      tally_.note_damage(
          line.place, text("a packet of ", packet_.bytes.size(), " bytes has not whole records of ", size));
    }
    const auto* at = reinterpret_cast<const uint8_t*>(packet_.bytes.data());
    for (size_t n = packet_.bytes.size() / size; n > 0; --n, at += size) {
      YarpRecord record{load_little_endian<uint32_t>(at + size - 4), {}};
      if (size == 8) record.ticks = load_little_endian<uint32_t>(at);
      records.push_back(record);
    }
  }
  const auto undefined = [](const YarpRecord& record) { return (record.word & kYarpFill) != 0; };
  if (std::any_of(records.begin(), records.end(), undefined)) {
    tally_.note_damage(line.place, "a packet has records that are no events");
  }
  for (size_t i = 0; i < records.size(); ++i) {
    if (undefined(records[i])) continue;
    const uint32_t word = records[i].word;
    const int64_t t = records[i].ticks ? microseconds(*records[i].ticks) : time_of(i);
    const size_t camera = word >> 22 & 1;
    if (!camera_) camera_ = camera;
    if (camera_ != camera) {
      if (yarp_.camera) continue;
      tally_.fail(
          bad("the log has events of both cameras; choose one with ReadOptions::stream, left or right"));
      return;
    }
    block.push_back({t, static_cast<uint16_t>(word >> 1 & 0x7FF), static_cast<uint16_t>(word >> 12 & 0x3FF),
                     static_cast<uint8_t>(1 - (word & 1))});
  }
}

// Of a record without a time: the packet's, which is that of its end, or its share of the duration.
int64_t YarpReader::time_of(size_t record) const {
  if (!yarp_.spread) return packet_.stamp;
  const auto count = static_cast<int64_t>(packet_.records.size());
  const auto left = count - 1 - static_cast<int64_t>(record);
  return packet_.stamp + rounded_quotient(-packet_.duration * left, count);
}

int64_t YarpReader::microseconds(uint32_t ticks) {
  const int64_t unwrapped = ticks_.unwrapped(ticks);
  return yarp_.microsecond_ticks ? unwrapped : rounded_quotient(unwrapped * 2, 25);  // 80 ns
}

struct LogStart {
  bool lines = false;    // the first one is one of a log
  bool escaped = false;  // there are packets of version 2
  YarpCoding coding = YarpCoding::plain;
};

// `last`: nothing follows `bytes`.
LogStart look_at(std::span<const uint8_t> bytes, bool last) {
  std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  LogStart start;
  std::vector<YarpPacket> packets;
  for (bool first = true; !all.empty(); first = false) {
    const size_t newline = all.find('\n');
    if (newline == all.npos && !last) break;
    YarpPacket packet;
    const YarpLine kind = parse_yarp_line(all.substr(0, newline), packet);
    if (first) start.lines = kind != YarpLine::broken;
    if (kind == YarpLine::packet && packet.escaped) packets.push_back(std::move(packet));
    all.remove_prefix(newline == all.npos ? all.size() : newline + 1);
  }
  start.escaped = !packets.empty();
  start.coding = guess_yarp_coding(packets);
  return start;
}

Result<YarpOptions> options_for(const LogStart& start, const ReadOptions& options) {
  const auto illegal = [](std::string message) {
    return Error{ErrorCode::illegal_parameter, std::move(message)};
  };
  YarpOptions yarp;
  yarp.coding = start.coding;
  const bool timed = !start.escaped || start.coding == YarpCoding::timed;
  if (!options.yarp_time.empty()) {
    if (options.yarp_time != "packet" && options.yarp_time != "spread") {
      return illegal(text("ReadOptions::yarp_time is packet or spread, not '", options.yarp_time, "'"));
    }
    if (timed) return illegal("the log has times of its events; leave ReadOptions::yarp_time out");
    yarp.spread = options.yarp_time == "spread";
  }
  if (!options.time_unit.empty()) {
    if (options.time_unit != "us")
      return illegal("ticks of YARP are 80 ns, or with ReadOptions::time_unit us 1 us");
    if (!timed) return illegal("the log has no ticks; leave ReadOptions::time_unit out");
    yarp.microsecond_ticks = true;
  }
  if (!options.stream.empty()) {
    const auto found = std::find(kCameras.begin(), kCameras.end(), options.stream);
    if (found == kCameras.end()) {
      return illegal(text("there is no camera '", options.stream, "'; ReadOptions::stream is left or right"));
    }
    yarp.camera = static_cast<size_t>(found - kCameras.begin());
  }
  return yarp;
}

Result<std::unique_ptr<EventSource>> open_yarp(Input input, const ReadOptions& options) {
  if (input.folder) {
    auto data = input.files->open_regular(text(input.path, "/", kData));
    if (!data) return Error{data.error().code, text(kData, ": ", data.error().message)};
    input.bytes = *std::move(data);
  }
  // All that the buffer holds: packets are long, and a few records tell little.
  if (const auto filled = input.bytes.fill(ByteReader::kCapacity); !filled) return filled.error();
  const auto yarp = options_for(look_at(input.bytes.available(), input.bytes.ended()), options);
  if (!yarp) return yarp.error();
  const auto sensor = agreed_sensor(std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<YarpReader>(std::move(input), *sensor, *yarp, options));
}

bool recognise_yarp(const Beginning& beginning) {
  if (!beginning.folder) return look_at(beginning.bytes, beginning.ended).lines;
  std::error_code ignored;
  const auto has = [&](std::string_view file) {
    return std::filesystem::is_regular_file(text(beginning.path, "/", file), ignored);
  };
  return has(kData) && has(kInfo);
}

}  // namespace

const Format kYarpFormat = {.name = kName,
                            .title = "YARP event-driven log, versions 1 and 2 (data.log, or its folder)",
                            .options = kTakesStream | kTakesTimeUnit | kTakesYarpTime,
                            .recognise = recognise_yarp,
                            .open = open_yarp};

}  // namespace scarf
