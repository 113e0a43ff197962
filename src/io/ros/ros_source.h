// The events and triggers of a bag of ROS, whatever kind of file it is.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/ros/ros_bag.h"

namespace scarf {

/// `format` and `name` are those of the file.
Result<std::unique_ptr<EventSource>> ros_events(std::unique_ptr<RosBag> bag, std::string_view format,
                                                const std::string& name, const ReadOptions& options);
Result<std::unique_ptr<TriggerSource>> ros_triggers(std::unique_ptr<RosBag> bag, const std::string& name,
                                                    const ReadOptions& options);

}  // namespace scarf
