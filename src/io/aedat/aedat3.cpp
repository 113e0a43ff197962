#include "io/aedat/aedat3.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "core/text.h"
#include "io/aedat/aedat_header.h"
#include "io/base/blocks.h"
#include "io/base/streams.h"

namespace scarf::aedat3 {
namespace {

constexpr size_t kHeaderBytes = 28;
// More than any camera sends at once.
constexpr uint64_t kMaxPacketBytes = uint64_t{256} << 20;

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

struct KnownSize {
  std::string_view name;  // the beginning of a source's name
  SensorSize sensor;
};
constexpr KnownSize kSizes[] = {
    {"DVS128", {128, 128}},   {"eDVS4337", {128, 128}}, {"DVS132S", {132, 104}},  {"DAVIS128", {128, 128}},
    {"DAVIS240", {240, 180}}, {"DAVIS346", {346, 260}}, {"DAVIS640", {640, 480}}, {"DVXplorer", {640, 480}},
};

std::optional<SensorSize> size_of(std::string_view name) {
  for (const KnownSize& known : kSizes) {
    if (name.starts_with(known.name)) return known.sensor;
  }
  return std::nullopt;
}

// "Source 0: DVS128". Lines of a recording that this one was made from begin with a minus.
std::optional<Source> source_in(std::string_view line) {
  constexpr std::string_view kKey = "Source ";
  if (!line.starts_with(kKey)) return std::nullopt;
  line.remove_prefix(kKey.size());
  Source source;
  const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), source.id);
  if (failure != std::errc()) return std::nullopt;
  source.name = aedat_value(line, line.substr(0, static_cast<size_t>(end - line.data())));
  source.sensor = size_of(source.name);
  return source;
}

Result<std::vector<Source>> take_header(ByteReader& input) {
  constexpr size_t kMaxSources = 1024;
  std::vector<Source> sources;
  std::string format;
  bool whole = false;
  const auto taken = take_aedat_lines(input, [&](std::string_view line) {
    if (const auto value = aedat_value(line, "Format"); !value.empty()) format = value;
    if (auto source = source_in(line); source && sources.size() < kMaxSources) {
      sources.push_back(*std::move(source));
    }
    whole = line.starts_with("!END-HEADER");
    return whole;
  });
  if (!taken) return taken.error();
  if (!whole) return bad("the header does not end with #!END-HEADER");
  if (!format.empty() && format != "RAW") {
    return bad(text("the packets have the format ", format.substr(0, 40), "; scarf reads RAW"));
  }
  if (sources.empty()) return bad("the header names no camera (#Source 0: ...)");
  return sources;
}

std::optional<Packet> broken(uint64_t byte, std::string damage, uint64_t truncated = 0) {
  Packet packet;
  packet.byte = byte;
  packet.damage = std::move(damage);
  packet.truncated = truncated;
  return packet;
}

}  // namespace

Result<Packets> Packets::open(ByteReader input, const ReadOptions& options) {
  auto sources = take_header(input);
  if (!sources) return sources.error();
  std::vector<StreamName> names;
  for (const Source& source : *sources) names.push_back({text(source.id), source.name});
  const auto chosen = choose_stream(options.stream, names, "cameras");
  if (!chosen) return chosen.error();
  return Packets(std::move(input), *std::move(sources), *chosen);
}

Packets::Packets(ByteReader input, std::vector<Source> sources, size_t chosen)
    : input_(std::move(input)), sources_(std::move(sources)), source_(sources_[chosen]) {}

Result<std::optional<Packet>> Packets::next(Type wanted, size_t least) {
  while (!ended_) {
    const uint64_t byte = input_.consumed();
    if (const auto filled = input_.fill(kHeaderBytes); !filled) return filled.error();
    const auto start = input_.available();
    if (start.empty()) {
      ended_ = true;
      break;
    }
    if (start.size() < kHeaderBytes) return cut_short(byte, "the file ends within a packet");
    const auto id = load_little_endian<int16_t>(start.data() + 2);
    const auto record_bytes = load_little_endian<int32_t>(start.data() + 4);
    const auto turns = load_little_endian<int32_t>(start.data() + 12);
    const auto capacity = load_little_endian<int32_t>(start.data() + 16);
    const auto count = load_little_endian<int32_t>(start.data() + 20);
    const auto size =
        static_cast<uint64_t>(std::max(record_bytes, 0)) * static_cast<uint64_t>(std::max(capacity, 0));
    if (record_bytes <= 0 || capacity < 0 || count < 0 || count > capacity || turns < 0 ||
        size > kMaxPacketBytes) {
      return cut_short(
          byte, text("a packet claims ", count, " records of ", record_bytes, " bytes in the place of ",
                     capacity, "; what follows cannot be told apart"));
    }
    Packet packet;
    packet.byte = byte;
    packet.type = load_little_endian<int16_t>(start.data());
    packet.count = static_cast<uint32_t>(count);
    packet.record_bytes = static_cast<size_t>(record_bytes);
    packet.turns = int64_t{turns} << 31;
    input_.skip(kHeaderBytes);
    const bool ours = id == source_.id;
    uint64_t done = 0;
    if (ours && packet.type == wanted) {
      const auto whole = read_block(input_, size, records_);
      if (!whole) return whole.error();
      done = records_.size();
    } else {
      const auto skipped = skip_block(input_, size);
      if (!skipped) return skipped.error();
      done = *skipped;
    }
    if (done < size) {
      ended_ = true;
      return broken(byte, "the file ends within a packet", kHeaderBytes + done);
    }
    if (!ours) {
      const auto named = [id](const Source& source) { return source.id == id; };
      if (std::any_of(sources_.begin(), sources_.end(), named)) continue;
      return broken(byte, text("the packet is of camera ", id, ", which the header does not name"));
    }
    if (packet.type == wanted) {
      if (packet.record_bytes < least) {
        return broken(byte, text("the packet's records have ", record_bytes, " bytes, which is too few"));
      }
      packet.records = records_;
    }
    return std::optional(std::move(packet));
  }
  return std::optional<Packet>();
}

// The end of what can be read: the rest of the file is counted.
Result<std::optional<Packet>> Packets::cut_short(uint64_t byte, std::string damage) {
  ended_ = true;
  const auto rest = skip_block(input_, std::numeric_limits<uint64_t>::max());
  if (!rest) return rest.error();
  return broken(byte, std::move(damage), *rest);
}

}  // namespace scarf::aedat3
