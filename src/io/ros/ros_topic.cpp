#include "io/ros/ros_topic.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/sensor_size.h"
#include "io/base/streams.h"
#include "io/ros/ros_packed_messages.h"

namespace scarf {
namespace {

constexpr size_t kFirstMessages = 64;
constexpr size_t kFirstBytes = size_t{16} << 20;

// Coordinates of messages have 32 bits; 0x0 is what drivers write that do not know.
std::optional<SensorSize> sensor_of(const RosEvents& message) {
  const auto sensor = checked_sensor(message.width, message.height, "the message");
  return sensor ? std::optional(*sensor) : std::nullopt;
}

}  // namespace

RosTopic::RosTopic(std::unique_ptr<RosBag> bag, Wanted wanted, std::string_view what)
    : bag_(std::move(bag)), wanted_(wanted), what_(what) {}

bool RosTopic::is_wanted(const RosMessage& message) const {
  const auto events = parse_ros_events(message.bytes, message.type, message.serialization);
  // A broken message is reported later, by who reads its topic.
  return !events || wanted_(*events);
}

Result<RosTopic> RosTopic::open(std::unique_ptr<RosBag> bag, const std::string& stream, Wanted wanted,
                                std::string_view what) {
  RosTopic topic(with_unpacked_messages(std::move(bag)), wanted, what);
  topic.named_ = !stream.empty();
  std::vector<StreamName> names;
  size_t messages = 0;
  size_t bytes = 0;
  bool found = false;
  // Damage is kept as well; of hostile files, not without bound.
  const auto full = [&] {
    return messages >= kFirstMessages || bytes >= kFirstBytes || topic.kept_.size() >= 2 * kFirstMessages;
  };
  while (topic.named_ ? !found : !full()) {
    auto message = topic.bag_->next();
    if (!message) return message.error();
    if (!*message) break;
    Kept kept{**message, {}};
    if (kept.message.damage.empty()) {
      ++messages;
      if (!topic.is_wanted(kept.message)) continue;
      const auto events = parse_ros_events(kept.message.bytes, kept.message.type, kept.message.serialization);
      const bool known = std::any_of(names.begin(), names.end(),
                                     [&](const StreamName& name) { return name.name == kept.message.topic; });
      if (!known && names.size() < kMaxRosTopics) {
        names.push_back({kept.message.topic, !events ? "broken message"
                                                     : text(events->width, "x", events->height,
                                                            events->type == RosType::event_packet
                                                                ? text(", ", events->encoding.substr(0, 40))
                                                                : "")});
      }
      if (topic.named_ && kept.message.topic != stream) continue;
      found = true;
      kept.bytes.assign(kept.message.bytes.begin(), kept.message.bytes.end());
      bytes += kept.bytes.size();
    }
    if (found || topic.kept_.size() < 2 * kFirstMessages) topic.kept_.push_back(std::move(kept));
  }
  const auto chosen = choose_stream(stream, names, what);
  if (!chosen) {
    // Events may have been in what is broken.
    const auto broken = std::find_if(topic.kept_.begin(), topic.kept_.end(),
                                     [](const Kept& kept) { return !kept.message.damage.empty(); });
    if (!names.empty() || broken == topic.kept_.end()) return chosen.error();
    return Error{ErrorCode::bad_input, text(chosen.error().message, " before byte ", broken->message.byte,
                                            ": ", broken->message.damage)};
  }
  topic.topic_ = names[*chosen].name;
  for (const Kept& kept : topic.kept_) {
    if (topic.sensor_ || !kept.message.damage.empty()) continue;
    const auto events = parse_ros_events(kept.bytes, kept.message.type, kept.message.serialization);
    if (events) topic.sensor_ = sensor_of(*events);
  }
  return topic;
}

Result<std::optional<RosMessage>> RosTopic::next() {
  if (!kept_.empty()) {
    Kept kept = std::move(kept_.front());
    kept_.pop_front();
    bytes_ = std::move(kept.bytes);
    kept.message.bytes = bytes_;
    return std::optional(std::move(kept.message));
  }
  for (;;) {
    auto message = bag_->next();
    if (!message) return message.error();
    if (!*message) return std::optional<RosMessage>();
    RosMessage& m = **message;
    if (!m.damage.empty() || m.topic == topic_) return message;
    if (named_ || others_.contains(m.topic)) continue;
    if (is_wanted(m)) {
      return Error{ErrorCode::bad_input, text("byte ", m.byte, ": beside ", topic_, " there is ", m.topic,
                                              " among the ", what_, "; choose one with ReadOptions::stream")};
    }
    if (others_.size() < kMaxRosTopics) others_.insert(m.topic);
  }
}

}  // namespace scarf
