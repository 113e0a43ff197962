// Bags of ROS: files of messages of many topics. Each kind of file has its reader; what is done with the
// messages is the same for all (ros_source.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/base/format.h"
#include "io/ros/ros_message.h"

namespace scarf {

/// A message that may hold events, or a broken place of the bag.
struct RosMessage {
  uint64_t byte = 0;       ///< of the record, or of the chunk that it lies in
  std::string damage;      ///< what is wrong there; there is no message then
  uint64_t truncated = 0;  ///< bytes that cannot be read because of the damage
  std::string topic;
  RosType type = RosType::event_packet;
  RosSerialization serialization = RosSerialization::ros1;
  std::span<const uint8_t> bytes;  ///< live until the next message
};

class RosBag {
 public:
  virtual ~RosBag() = default;

  /// The next message of a type that ros_type knows, in the order of the file; nullopt at the end. Errors:
  /// io; bad_input for what cannot be passed over.
  virtual Result<std::optional<RosMessage>> next() = 0;

  virtual uint64_t bytes_read() const = 0;
  virtual uint64_t bytes_total() const = 0;
};

/// Most connections or channels of a bag: more are taken for damage.
inline constexpr size_t kMaxRosTopics = 65'536;

/// Each takes the whole file, from its first byte on. Errors: io; bad_input.
Result<std::unique_ptr<RosBag>> open_rosbag(ByteReader input);
Result<std::unique_ptr<RosBag>> open_mcap(ByteReader input);
Result<std::unique_ptr<RosBag>> open_rosbag2_database(const std::string& path);

bool is_mcap(std::span<const uint8_t> beginning);

}  // namespace scarf
