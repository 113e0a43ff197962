// Messages of ROS 2 that were compressed one by one (rosbag2, compression_mode MESSAGE). Source:
// ros2/rosbag2, rosbag2_compression_zstd: each is a Zstandard frame.
#pragma once

#include <memory>

#include "io/ros/ros_bag.h"

namespace scarf {

/// The bag with its messages unpacked. No other message of ROS 2 begins as a Zstandard frame does: its first
/// byte is 0.
std::unique_ptr<RosBag> with_unpacked_messages(std::unique_ptr<RosBag> bag);

}  // namespace scarf
