#include "io/aedat/aedat4.h"

#include <charconv>
#include <limits>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/blocks.h"
#include "io/base/sensor_size.h"
#include "io/base/streams.h"

#ifdef SCARF_HAS_PUGIXML
#include <pugixml.hpp>
#endif

namespace scarf::aedat4 {
namespace {

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

std::optional<Packet> broken(uint64_t byte, std::string damage, uint64_t truncated = 0) {
  return Packet{byte, std::move(damage), truncated, {}};
}

Result<Compression> compression_of(int32_t number) {
  switch (number) {
    case 0:
      return Compression::none;
    case 1:
    case 2:
      return Compression::lz4;
    case 3:
    case 4:
      return Compression::zstd;
    default:
      return bad(text("the header names the compression ", number, ", which AEDAT4 does not define"));
  }
}

#ifdef SCARF_HAS_PUGIXML
std::string_view attribute(const pugi::xml_node& node, const char* key) {
  return node.find_child_by_attribute("attr", "key", key).text().get();
}

template <class T>
std::optional<T> number(std::string_view digits) {
  T value{};
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

Result<std::vector<Stream>> streams_of(std::span<const uint8_t> xml) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml.data(), xml.size());
  if (!parsed) return bad(text("the XML of the header is broken: ", parsed.description()));
  std::vector<Stream> streams;
  const auto list = document.child("dv").find_child_by_attribute("node", "name", "outInfo");
  for (const pugi::xml_node& node : list.children("node")) {
    const auto id = number<int32_t>(node.attribute("name").value());
    if (!id) continue;
    const auto info = node.find_child_by_attribute("node", "name", "info");
    Stream stream{*id, std::string(attribute(node, "typeIdentifier")), std::nullopt,
                  std::string(attribute(info, "source"))};
    const auto width = number<int32_t>(attribute(info, "sizeX"));
    const auto height = number<int32_t>(attribute(info, "sizeY"));
    if (width && height) {
      const auto sensor = checked_sensor(*width, *height, text("stream ", *id, " of the header"));
      if (!sensor) return sensor.error();
      stream.sensor = *sensor;
    }
    streams.push_back(std::move(stream));
  }
  return streams;
}
#else
Result<std::vector<Stream>> streams_of(std::span<const uint8_t>) {
  return bad("this build of scarf has no pugixml");  // open_as has refused before
}
#endif

}  // namespace

Result<Header> read_header(ByteReader& input) {
  constexpr size_t kSizeBytes = sizeof(uint32_t);
  if (const auto filled = input.fill(kMagic.size() + kSizeBytes); !filled) return filled.error();
  const auto start = input.available();
  const std::string_view words(reinterpret_cast<const char*>(start.data()), start.size());
  if (!words.starts_with(kMagic)) {
    return bad(words.starts_with("#!AER-DAT")
                   ? "this is an older AEDAT than AEDAT4: leave out ReadOptions::format, or name its own"
                   : "this is no AEDAT4: it does not begin with #!AER-DAT4.0");
  }
  if (start.size() < kMagic.size() + kSizeBytes) return bad("the file ends within its header");
  const auto size = load_little_endian<uint32_t>(start.data() + kMagic.size());
  constexpr uint32_t kLargest = uint32_t{16} << 20;
  if (size > kLargest)
    return bad(text("the header claims ", size, " bytes; no more than ", kLargest, " are read"));
  input.skip(kMagic.size() + kSizeBytes);
  std::vector<uint8_t> bytes;
  const auto whole = read_block(input, size, bytes);
  if (!whole) return whole.error();
  if (!*whole) return bad("the file ends within its header");

  const auto root = FlatTable::root(bytes);
  if (!root) return bad("the header is broken");
  const auto compression = root->number<int32_t>(0, 0);
  const auto table_position = root->number<int64_t>(1, -1);
  const auto xml = root->vector(2, 1);
  if (!compression || !table_position || !xml) return bad("the header is broken");
  const auto known = compression_of(*compression);
  if (!known) return known.error();
  auto streams = streams_of(*xml);
  if (!streams) return streams.error();
  return Header{*known, *table_position, *std::move(streams)};
}

Result<Packets> Packets::open(Input input, const ReadOptions& options, std::string_view type,
                              std::string_view what) {
  auto header = read_header(input.bytes);
  if (!header) return header.error();
  std::vector<StreamName> names;
  std::vector<Stream> streams;
  for (const Stream& stream : header->streams) {
    if (stream.type != type) continue;
    streams.push_back(stream);
    names.push_back(
        {text(stream.id), text(stream.sensor ? size_text(*stream.sensor) : "unknown size", " from ",
                               stream.source.empty() ? "an unnamed camera" : stream.source)});
  }
  const auto chosen = choose_stream(options.stream, names, what);
  if (!chosen) return chosen.error();
  auto decompressor = Decompressor::make(header->compression);
  if (!decompressor) return decompressor.error();
  return Packets(std::move(input.bytes), *std::move(header), std::move(streams[*chosen]),
                 *std::move(decompressor));
}

Packets::Packets(ByteReader input, Header header, Stream stream, Decompressor decompressor)
    : input_(std::move(input)),
      header_(std::move(header)),
      stream_(std::move(stream)),
      decompressor_(std::move(decompressor)) {}

Result<std::optional<Packet>> Packets::next() {
  constexpr size_t kHeaderBytes = 2 * sizeof(int32_t);
  while (!ended_) {
    const uint64_t byte = input_.consumed();
    const auto end = static_cast<uint64_t>(header_.table_position);  // beyond all files if it is -1
    if (byte == end) {
      ended_ = true;
      // The table of packets is behind them: it says nothing that the packets do not.
      if (const auto skipped = skip_block(input_, std::numeric_limits<uint64_t>::max()); !skipped)
        return skipped.error();
      break;
    }
    if (const auto filled = input_.fill(kHeaderBytes); !filled) return filled.error();
    const auto start = input_.available();
    if (start.empty()) {
      ended_ = true;
      if (header_.table_position < 0) break;
      return cut_short(byte, text("the file ends before its last packets, which reach to byte ", end));
    }
    if (start.size() < kHeaderBytes) return cut_short(byte, "the file ends within a packet");
    const auto id = load_little_endian<int32_t>(start.data());
    const auto size = load_little_endian<int32_t>(start.data() + sizeof(int32_t));
    if (size < 0 || static_cast<uint64_t>(size) > Decompressor::kLimit) {
      return cut_short(byte, text("a packet claims ", size, " bytes; what follows cannot be told apart"));
    }
    input_.skip(kHeaderBytes);
    if (id != stream_.id) {
      const auto skipped = skip_block(input_, static_cast<uint64_t>(size));
      if (!skipped) return skipped.error();
      if (*skipped < static_cast<uint64_t>(size)) {
        ended_ = true;
        return broken(byte, "the file ends within a packet", kHeaderBytes + *skipped);
      }
      continue;
    }
    const auto whole = read_block(input_, static_cast<uint64_t>(size), packed_);
    if (!whole) return whole.error();
    if (!*whole) {
      ended_ = true;
      return broken(byte, "the file ends within a packet", kHeaderBytes + packed_.size());
    }
    return unpacked(byte);
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

std::optional<Packet> Packets::unpacked(uint64_t byte) {
  const auto bytes = decompressor_.unpack(packed_);
  if (!bytes) return broken(byte, text("a packet cannot be unpacked: ", bytes.error().message));
  constexpr size_t kIdentifier = 8;  // behind the size prefix and the offset of the root
  constexpr size_t kIdentifierEnd = kIdentifier + 4;
  if (bytes->size() < kIdentifierEnd) return broken(byte, "the packet is too short");
  const std::string_view identifier(reinterpret_cast<const char*>(bytes->data()) + kIdentifier, 4);
  if (identifier != stream_.type) return broken(byte, text("the packet is not of type ", stream_.type));
  const auto content = FlatTable::root(bytes->subspan(sizeof(uint32_t)));
  if (!content) return broken(byte, "the packet is broken");
  return Packet{byte, "", 0, content};
}

Error damage_error(const std::string& name, const Packet& packet) {
  return bad(text(name, ": byte ", packet.byte, ": ", packet.damage));
}

}  // namespace scarf::aedat4
