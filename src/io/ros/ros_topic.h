// The messages of one topic of a bag.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/ros/ros_bag.h"

namespace scarf {

class RosTopic {
 public:
  /// Which messages are wanted: holds_events or holds_triggers.
  using Wanted = bool (*)(const RosEvents&);

  /// Chooses the topic that `stream` names or, if it is empty, the only one that has wanted messages. To see
  /// which there are, the first messages are read and kept: 64 of them, or 16 MiB. `what`: "event topics".
  static Result<RosTopic> open(std::unique_ptr<RosBag> bag, const std::string& stream, Wanted wanted,
                               std::string_view what);

  /// What its first message says.
  std::optional<SensorSize> sensor() const { return sensor_; }
  const RosBag& bag() const { return *bag_; }

  /// The topic's next message, or a broken place; nullopt at the end. Errors: io; bad_input, also for a
  /// second topic with wanted messages that comes later than the first look, if none was named.
  Result<std::optional<RosMessage>> next();

 private:
  struct Kept {
    RosMessage message;
    std::vector<uint8_t> bytes;
  };

  RosTopic(std::unique_ptr<RosBag> bag, Wanted wanted, std::string_view what);

  bool is_wanted(const RosMessage& message) const;

  std::unique_ptr<RosBag> bag_;
  Wanted wanted_;
  std::string_view what_;
  std::string topic_;
  bool named_ = false;
  std::set<std::string> others_;  // topics that hold nothing wanted
  std::optional<SensorSize> sensor_;
  std::deque<Kept> kept_;
  std::vector<uint8_t> bytes_;  // of the kept message handed out last
};

}  // namespace scarf
