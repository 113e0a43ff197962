// Reader of ROS 1 bags, from front to back, so that bags without an index are read as well. Source: ROS wiki,
// "Bags/Format/2.0".

#include <array>
#include <map>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/blocks.h"
#include "io/base/known_formats.h"
#include "io/ros/record_bag.h"
#include "io/ros/ros_source.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "rosbag";
constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr uint32_t kMostHeaderBytes = 1 << 20;
constexpr size_t kLengthBytes = sizeof(uint32_t);

enum Op : uint8_t { kMessage = 2, kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

// The field `name` of a record's header; nullopt if it has none.
std::optional<std::span<const uint8_t>> field(std::span<const uint8_t> header, std::string_view name) {
  while (header.size() >= kLengthBytes) {
    const auto size = load_little_endian<uint32_t>(header.data());
    header = header.subspan(kLengthBytes);
    if (size > header.size()) break;
    const std::string_view both(reinterpret_cast<const char*>(header.data()), size);
    if (both.size() > name.size() && both.starts_with(name) && both[name.size()] == '=') {
      return header.first(size).subspan(name.size() + 1);
    }
    header = header.subspan(size);
  }
  return std::nullopt;
}

template <class T>
std::optional<T> number_field(std::span<const uint8_t> header, std::string_view name) {
  const auto value = field(header, name);
  if (!value || value->size() != sizeof(T)) return std::nullopt;
  return load_little_endian<T>(value->data());
}

std::string text_field(std::span<const uint8_t> header, std::string_view name) {
  const auto value = field(header, name);
  return value ? std::string(value->begin(), value->end()) : "";
}

class Rosbag final : public RecordBag {
 public:
  using RecordBag::RecordBag;

 private:
  struct Connection {
    std::string topic;
    RosType type = RosType::event_packet;
  };

  Result<Maybe> next_record() override;
  Result<Maybe> open_chunk(std::span<const uint8_t> header);
  Maybe next_of_chunk() override;
  Maybe take(std::span<const uint8_t> header, std::span<const uint8_t> data);

  std::map<uint32_t, Connection> connections_;  // those with events
  std::vector<uint8_t> header_;
  std::vector<uint8_t> data_;
};

Result<std::optional<RosMessage>> Rosbag::next_record() {
  byte_ = input_.consumed();
  if (const auto filled = input_.fill(kLengthBytes); !filled) return filled.error();
  if (input_.available().empty()) {
    ended_ = true;
    return Maybe();
  }
  if (input_.available().size() < kLengthBytes) return cut_short("the bag ends within a record");
  const auto header_size = load_little_endian<uint32_t>(input_.available().data());
  if (header_size > kMostHeaderBytes) {
    return cut_short(
        text("a record claims a header of ", header_size, " bytes; what follows cannot be told apart"));
  }
  input_.skip(kLengthBytes);
  const auto whole = read_block(input_, header_size, header_);
  if (!whole) return whole.error();
  if (const auto filled = input_.fill(kLengthBytes); !filled) return filled.error();
  if (!*whole || input_.available().size() < kLengthBytes) return cut_short("the bag ends within a record");
  const auto size = load_little_endian<uint32_t>(input_.available().data());
  input_.skip(kLengthBytes);
  const auto op = number_field<uint8_t>(header_, "op");
  if (!op) return cut_short("a record has no type; what follows cannot be told apart");
  if (*op != kChunk && *op != kConnection && *op != kMessage) {
    const auto skipped = skip_block(input_, size);
    if (!skipped) return skipped.error();
    if (*skipped < size) return cut_short("the bag ends within a record");
    return Maybe();
  }
  if (size > Decompressor::kLimit) {
    return cut_short(text("a record claims ", size, " bytes; what follows cannot be told apart"));
  }
  const auto all = read_block(input_, size, data_);
  if (!all) return all.error();
  if (!*all) return cut_short("the bag ends within a chunk or message");
  // A recorder that stopped early leaves messages outside of chunks.
  return *op == kChunk ? open_chunk(header_) : take(header_, data_);
}

Result<std::optional<RosMessage>> Rosbag::open_chunk(std::span<const uint8_t> header) {
  const std::string name = text_field(header, "compression");
  Compression compression = Compression::none;
  if (name == "lz4") {
    compression = Compression::lz4;
  } else if (name == "bz2") {
    compression = Compression::bz2;
  } else if (name != "none") {
    return damage(text("a chunk has the compression '", name.substr(0, 40), "', which ROS does not define"));
  }
  if (data_.empty()) return Maybe();
  auto decompressor = decompressors_.find(compression);
  if (decompressor == decompressors_.end()) {
    auto made = Decompressor::make(compression);
    if (!made) return made.error();
    decompressor = decompressors_.emplace(compression, *std::move(made)).first;
  }
  const auto unpacked = decompressor->second.unpack(data_);
  if (!unpacked) return damage(text("a chunk cannot be unpacked: ", unpacked.error().message));
  chunk_ = *unpacked;
  return Maybe();
}

std::optional<RosMessage> Rosbag::next_of_chunk() {
  const auto block = [&]() -> std::optional<std::span<const uint8_t>> {
    if (chunk_.size() < kLengthBytes) return std::nullopt;
    const auto size = load_little_endian<uint32_t>(chunk_.data());
    if (size > chunk_.size() - kLengthBytes) return std::nullopt;
    const auto bytes = chunk_.subspan(kLengthBytes, size);
    chunk_ = chunk_.subspan(kLengthBytes + size);
    return bytes;
  };
  const auto header = block();
  const auto data = header ? block() : std::nullopt;
  if (!data) {
    chunk_ = {};
    return damage("a chunk ends within a record");
  }
  return take(*header, *data);
}

// A record that is no message gives none.
std::optional<RosMessage> Rosbag::take(std::span<const uint8_t> header, std::span<const uint8_t> data) {
  const auto op = number_field<uint8_t>(header, "op");
  if (op != kConnection && op != kMessage) return std::nullopt;
  const auto number = number_field<uint32_t>(header, "conn");
  if (!number) return damage("a record names no connection");
  if (op == kConnection) {
    const auto type = ros_type(text_field(data, "type"));
    if (!type) return std::nullopt;
    if (connections_.size() >= kMaxRosTopics)
      return damage(text("more than ", kMaxRosTopics, " connections"));
    connections_.insert_or_assign(*number, Connection{text_field(header, "topic"), *type});
    return std::nullopt;
  }
  const auto connection = connections_.find(*number);
  if (connection == connections_.end()) return std::nullopt;
  RosMessage message;
  message.byte = byte_;
  message.topic = connection->second.topic;
  message.type = connection->second.type;
  message.serialization = RosSerialization::ros1;
  message.bytes = data;
  return message;
}

bool recognise_rosbag(const Beginning& beginning) {
  const std::string_view start(reinterpret_cast<const char*>(beginning.bytes.data()), beginning.bytes.size());
  return start.starts_with(kMagic);
}

Result<std::unique_ptr<EventSource>> open_events_of_rosbag(Input input, const ReadOptions& options) {
  auto bag = open_rosbag(std::move(input.bytes));
  if (!bag) return bag.error();
  return ros_events(*std::move(bag), kName, input.name, options);
}

Result<std::unique_ptr<TriggerSource>> open_triggers_of_rosbag(Input input, const ReadOptions& options) {
  auto bag = open_rosbag(std::move(input.bytes));
  if (!bag) return bag.error();
  return ros_triggers(*std::move(bag), input.name, options);
}

}  // namespace

Result<std::unique_ptr<RosBag>> open_rosbag(ByteReader input) {
  if (const auto filled = input.fill(kMagic.size()); !filled) return filled.error();
  const auto start = input.available();
  if (!std::string_view(reinterpret_cast<const char*>(start.data()), start.size()).starts_with(kMagic)) {
    return Error{ErrorCode::bad_input,
                 "this is no ROS 1 bag of version 2.0; `rosbag fix` makes one of older bags"};
  }
  input.skip(kMagic.size());
  return std::unique_ptr<RosBag>(std::make_unique<Rosbag>(std::move(input)));
}

const Format kRosbagFormat = {.name = kName,
                              .title = "ROS 1 bag",
                              .options = kTakesStream,
                              .recognise = recognise_rosbag,
                              .open = open_events_of_rosbag,
                              .open_triggers = open_triggers_of_rosbag};

}  // namespace scarf
