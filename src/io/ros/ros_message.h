// Messages of ROS that hold events, as ROS 1 and ROS 2 (CDR) write them. Sources: the message definitions of
// event_camera_msgs, dvs_msgs and prophesee_event_msgs; OMG, "DDS Interoperability Wire Protocol", CDR.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace scarf {

enum class RosSerialization { ros1, cdr };

enum class RosType {
  event_packet,  ///< event_camera_msgs/EventPacket: the camera's own bytes
  event_array,   ///< dvs_msgs/EventArray, prophesee_event_msgs/EventArray: a list of events
};

/// The type that a name means, with or without the "msg/" of ROS 2; nullopt if it holds no events.
std::optional<RosType> ros_type(std::string_view name);

/// Reads the fields of a message one after the other.
class RosCursor {
 public:
  RosCursor(std::span<const uint8_t> message, RosSerialization serialization);

  /// The next number; 0 once the message has failed.
  template <std::unsigned_integral T>
  T number() {
    if (cdr_) align(sizeof(T));
    const auto bytes = take(sizeof(T));
    T value = 0;
    for (size_t i = 0; i < bytes.size(); ++i) {
      const size_t place = big_endian_ ? bytes.size() - 1 - i : i;
      value = static_cast<T>(value | static_cast<T>(static_cast<T>(bytes[i]) << (8 * place)));
    }
    return value;
  }
  /// The next string, or array of bytes.
  std::string_view string();
  std::span<const uint8_t> bytes() { return take(number<uint32_t>()); }

  /// Whether a field reached beyond the message.
  bool failed() const { return failed_; }
  size_t left() const { return message_.size() - at_; }

 private:
  std::span<const uint8_t> take(size_t count);
  void align(size_t size);

  std::span<const uint8_t> message_;  // from where alignment counts
  size_t at_ = 0;
  bool cdr_;
  bool big_endian_ = false;
  bool failed_ = false;
};

/// The fields of a message that matter here.
struct RosEvents {
  RosType type = RosType::event_packet;
  uint32_t width = 0;
  uint32_t height = 0;
  // Of an event_packet:
  uint64_t seq = 0;        ///< counts messages
  uint64_t time_base = 0;  ///< nanoseconds
  std::string_view encoding;
  bool big_endian = false;
  std::span<const uint8_t> payload;
  // Of an event_array:
  uint32_t count = 0;
  std::optional<RosCursor> events;  ///< in front of the first event
};

/// nullopt if the message is shorter than its fields say.
std::optional<RosEvents> parse_ros_events(std::span<const uint8_t> message, RosType type,
                                          RosSerialization serialization);

}  // namespace scarf
