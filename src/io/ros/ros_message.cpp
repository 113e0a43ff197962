#include "io/ros/ros_message.h"

#include <algorithm>

namespace scarf {

std::optional<RosType> ros_type(std::string_view name) {
  const size_t slash = name.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const std::string_view package = name.substr(0, slash);
  std::string_view type = name.substr(slash + 1);
  if (type.starts_with("msg/")) type.remove_prefix(4);
  if (package == "event_camera_msgs" && type == "EventPacket") return RosType::event_packet;
  if ((package == "dvs_msgs" || package == "prophesee_event_msgs") && type == "EventArray") {
    return RosType::event_array;
  }
  return std::nullopt;
}

RosCursor::RosCursor(std::span<const uint8_t> message, RosSerialization serialization)
    : message_(message), cdr_(serialization == RosSerialization::cdr) {
  if (!cdr_) return;
  // Four bytes say how the rest is written: 0, then 0 for big-endian or 1 for little-endian CDR.
  const auto head = take(4);
  failed_ = head.size() < 4 || head[0] != 0 || head[1] > 1;
  if (failed_) return;
  big_endian_ = head[1] == 0;
  message_ = message_.subspan(4);
  at_ = 0;
}

std::string_view RosCursor::string() {
  const auto characters = bytes();
  std::string_view text(reinterpret_cast<const char*>(characters.data()), characters.size());
  if (cdr_ && text.ends_with('\0')) text.remove_suffix(1);
  return text;
}

std::span<const uint8_t> RosCursor::take(size_t count) {
  if (failed_ || count > left()) {
    failed_ = true;
    return {};
  }
  at_ += count;
  return message_.subspan(at_ - count, count);
}

void RosCursor::align(size_t size) {
  at_ = std::min((at_ + size - 1) / size * size, message_.size());
}

std::optional<RosEvents> parse_ros_events(std::span<const uint8_t> message, RosType type,
                                          RosSerialization serialization) {
  RosCursor cursor(message, serialization);
  RosEvents events;
  events.type = type;
  if (serialization == RosSerialization::ros1) cursor.number<uint32_t>();  // header.seq
  cursor.number<uint32_t>();                                               // header.stamp, seconds
  cursor.number<uint32_t>();                                               // and nanoseconds
  cursor.string();                                                         // header.frame_id
  events.height = cursor.number<uint32_t>();
  events.width = cursor.number<uint32_t>();
  if (type == RosType::event_packet) {
    events.seq = cursor.number<uint64_t>();
    events.time_base = cursor.number<uint64_t>();
    events.encoding = cursor.string();
    events.big_endian = cursor.number<uint8_t>() != 0;
    events.payload = cursor.bytes();
  } else {
    events.count = cursor.number<uint32_t>();
    events.events = cursor;
  }
  if (cursor.failed()) return std::nullopt;
  return events;
}

}  // namespace scarf
