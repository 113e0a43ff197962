// Reader of MCAP, from front to back, so that files without an index are read as well. Source: Foxglove,
// "MCAP Format Specification".

#include <limits>
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

using namespace std::string_view_literals;

constexpr std::string_view kName = "mcap";
constexpr std::string_view kMagic = "\x89MCAP0\r\n"sv;

enum Opcode : uint8_t {
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kDataEnd = 0x0F,
};
constexpr size_t kRecordHead = 1 + sizeof(uint64_t);  // opcode and length

class Mcap final : public RecordBag {
 public:
  using RecordBag::RecordBag;

 private:
  struct Channel {
    std::string topic;
    RosType type = RosType::event_packet;
    RosSerialization serialization = RosSerialization::cdr;
  };

  Result<Maybe> next_record() override;
  Result<Maybe> open_chunk();
  Maybe next_of_chunk() override;
  Maybe take(uint8_t opcode, std::span<const uint8_t> content);

  std::map<uint16_t, RosType> schemas_;   // those with events
  std::map<uint16_t, Channel> channels_;  // those with events
  std::vector<uint8_t> content_;
};

// Numbers and strings of MCAP are written as ROS 1 writes them.
RosCursor cursor_of(std::span<const uint8_t> content) {
  return {content, RosSerialization::ros1};
}

Result<std::optional<RosMessage>> Mcap::next_record() {
  byte_ = input_.consumed();
  if (const auto filled = input_.fill(kRecordHead); !filled) return filled.error();
  const auto head = input_.available();
  if (head.size() < kRecordHead) return cut_short("the file ends without the mark of its end");
  const uint8_t opcode = head[0];
  const auto size = load_little_endian<uint64_t>(head.data() + 1);
  input_.skip(kRecordHead);
  if (opcode == kDataEnd || opcode == kFooter) {
    ended_ = true;
    // Behind it are summaries, which say nothing that the records before do not.
    const auto skipped = skip_block(input_, std::numeric_limits<uint64_t>::max());
    if (!skipped) return skipped.error();
    return Maybe();
  }
  if (opcode != kSchema && opcode != kChannel && opcode != kMessage && opcode != kChunk) {
    const auto skipped = skip_block(input_, size);
    if (!skipped) return skipped.error();
    if (*skipped < size) return cut_short("the file ends within a record");
    return Maybe();
  }
  if (size > Decompressor::kLimit) {
    return cut_short(text("a record claims ", size, " bytes; what follows cannot be told apart"));
  }
  const auto whole = read_block(input_, size, content_);
  if (!whole) return whole.error();
  if (!*whole) return cut_short("the file ends within a record");
  return opcode == kChunk ? open_chunk() : take(opcode, content_);
}

Result<std::optional<RosMessage>> Mcap::open_chunk() {
  RosCursor cursor = cursor_of(content_);
  cursor.number<uint64_t>();  // times of its first
  cursor.number<uint64_t>();  // and last message
  cursor.number<uint64_t>();  // size when unpacked
  cursor.number<uint32_t>();  // checksum when unpacked
  const std::string_view name = cursor.string();
  const auto size = cursor.number<uint64_t>();
  if (cursor.failed() || size > cursor.left()) return damage("a chunk is shorter than its fields say");
  const auto packed = std::span<const uint8_t>(content_).subspan(content_.size() - cursor.left(), size);
  Compression compression = Compression::none;
  if (name == "lz4") {
    compression = Compression::lz4;
  } else if (name == "zstd") {
    compression = Compression::zstd;
  } else if (!name.empty()) {
    return damage(text("a chunk has the compression '", name.substr(0, 40), "', which MCAP does not define"));
  }
  if (packed.empty()) return Maybe();
  auto decompressor = decompressors_.find(compression);
  if (decompressor == decompressors_.end()) {
    auto made = Decompressor::make(compression);
    if (!made) return made.error();
    decompressor = decompressors_.emplace(compression, *std::move(made)).first;
  }
  const auto unpacked = decompressor->second.unpack(packed);
  if (!unpacked) return damage(text("a chunk cannot be unpacked: ", unpacked.error().message));
  chunk_ = *unpacked;
  return Maybe();
}

std::optional<RosMessage> Mcap::next_of_chunk() {
  if (chunk_.size() >= kRecordHead) {
    const uint8_t opcode = chunk_[0];
    const auto size = load_little_endian<uint64_t>(chunk_.data() + 1);
    if (size <= chunk_.size() - kRecordHead) {
      const auto content = chunk_.subspan(kRecordHead, size);
      chunk_ = chunk_.subspan(kRecordHead + size);
      return take(opcode, content);
    }
  }
  chunk_ = {};
  return damage("a chunk ends within a record");
}

// A record that is no message gives none.
std::optional<RosMessage> Mcap::take(uint8_t opcode, std::span<const uint8_t> content) {
  RosCursor cursor = cursor_of(content);
  if (opcode == kSchema) {
    const auto id = cursor.number<uint16_t>();
    const auto type = ros_type(cursor.string());
    if (!cursor.failed() && type) schemas_.insert_or_assign(id, *type);
    return std::nullopt;
  }
  if (opcode == kChannel) {
    const auto id = cursor.number<uint16_t>();
    const auto schema = schemas_.find(cursor.number<uint16_t>());
    const std::string topic(cursor.string());
    const std::string_view encoding = cursor.string();
    if (cursor.failed() || schema == schemas_.end()) return std::nullopt;
    if (encoding != "cdr" && encoding != "ros1") {
      return damage(text("the messages on ", topic, " have the encoding '", encoding.substr(0, 40),
                         "', which scarf does not read"));
    }
    const auto serialization = encoding == "cdr" ? RosSerialization::cdr : RosSerialization::ros1;
    channels_.insert_or_assign(id, Channel{topic, schema->second, serialization});
    return std::nullopt;
  }
  if (opcode != kMessage) return std::nullopt;
  const auto channel = channels_.find(cursor.number<uint16_t>());
  cursor.number<uint32_t>();  // its number
  cursor.number<uint64_t>();  // times when it was recorded
  cursor.number<uint64_t>();  // and sent
  if (cursor.failed()) return damage("a message is shorter than its fields say");
  if (channel == channels_.end()) return std::nullopt;
  RosMessage message;
  message.byte = byte_;
  message.topic = channel->second.topic;
  message.type = channel->second.type;
  message.serialization = channel->second.serialization;
  message.bytes = content.last(cursor.left());
  return message;
}

bool recognise_mcap(const Beginning& beginning) {
  return is_mcap(beginning.bytes);
}

Result<std::unique_ptr<EventSource>> open_events_of_mcap(Input input, const ReadOptions& options) {
  auto bag = open_mcap(std::move(input.bytes));
  if (!bag) return bag.error();
  return ros_events(*std::move(bag), kName, input.name, options);
}

Result<std::unique_ptr<TriggerSource>> open_triggers_of_mcap(Input input, const ReadOptions& options) {
  auto bag = open_mcap(std::move(input.bytes));
  if (!bag) return bag.error();
  return ros_triggers(*std::move(bag), input.name, options);
}

}  // namespace

bool is_mcap(std::span<const uint8_t> beginning) {
  return std::string_view(reinterpret_cast<const char*>(beginning.data()), beginning.size())
      .starts_with(kMagic);
}

Result<std::unique_ptr<RosBag>> open_mcap(ByteReader input) {
  if (const auto filled = input.fill(kMagic.size()); !filled) return filled.error();
  if (!is_mcap(input.available())) return Error{ErrorCode::bad_input, "this is no MCAP of version 0"};
  input.skip(kMagic.size());
  return std::unique_ptr<RosBag>(std::make_unique<Mcap>(std::move(input)));
}

const Format kMcapFormat = {.name = kName,
                            .title = "MCAP (ROS 2 bag)",
                            .options = kTakesStream,
                            .recognise = recognise_mcap,
                            .open = open_events_of_mcap,
                            .open_triggers = open_triggers_of_mcap};

}  // namespace scarf
