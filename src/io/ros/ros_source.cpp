#include "io/ros/ros_source.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/block_source.h"
#include "io/base/sensor_size.h"
#include "io/ros/ros_events.h"
#include "io/ros/ros_topic.h"

namespace scarf {
namespace {

class RosEventSource final : public BlockSource {
 public:
  RosEventSource(std::string_view format, std::string name, std::optional<SensorSize> sensor,
                 const ReadOptions& options, RosTopic topic)
      : BlockSource(std::move(name), sensor, options), format_(format), topic_(std::move(topic)) {}

  std::string_view format() const override { return format_; }
  uint64_t bytes_read() const override { return topic_.bag().bytes_read(); }
  uint64_t bytes_total() const override { return topic_.bag().bytes_total(); }

 protected:
  Result<bool> next(std::vector<Event>& block) override {
    const auto message = topic_.next();
    if (!message) return message.error();
    if (!*message) return false;
    const RosMessage& m = **message;
    truncated_ += m.truncated;
    if (m.damage.empty()) {
      take(m, block);
    } else {
      tally_.note_damage(m.byte, m.damage);
    }
    tally_.report.gaps = decoder_.gaps();
    ReadReport& report = tally_.report;
    while (report.undefined_polarities < decoder_.undefined_polarities() && !tally_.failure()) {
      tally_.leave_out_polarity("the message at byte", m.byte);
    }
    const uint64_t unknown = std::exchange(report.unknown_words, decoder_.unknown_words());
    const uint64_t truncated = std::exchange(report.truncated_bytes, truncated_ + decoder_.truncated_bytes());
    if (tally_.strict() && (report.unknown_words > unknown || report.truncated_bytes > truncated)) {
      tally_.fail({ErrorCode::bad_input,
                   text("the message at byte ", m.byte, " holds words that its encoding does not define, or ",
                        "ends within one; leave out ReadOptions::strict to read the rest")});
    }
    return true;
  }

 private:
  void take(const RosMessage& m, std::vector<Event>& block) {
    const auto events = parse_ros_events(m.bytes, m.type, m.serialization);
    if (!events) {
      tally_.note_damage(m.byte, text("a message on ", m.topic, " is shorter than its fields say"));
      return;
    }
    if (const std::string damage = decoder_.decode(*events, block); !damage.empty()) {
      tally_.note_damage(m.byte, damage);
    }
  }

  std::string_view format_;
  RosTopic topic_;
  RosEventDecoder decoder_;
  uint64_t truncated_ = 0;
};

class RosTriggerSource final : public TriggerSource {
 public:
  RosTriggerSource(std::string name, RosTopic topic) : name_(std::move(name)), topic_(std::move(topic)) {}

  Result<size_t> read(std::span<Trigger> out) override {
    while (at_ == triggers_.size()) {
      const auto message = topic_.next();
      if (!message) return message.error();
      if (!*message) return size_t{0};
      triggers_.clear();
      at_ = 0;
      if (const std::string damage = take(**message); !damage.empty()) {
        return Error{ErrorCode::bad_input, text(name_, ": byte ", (*message)->byte, ": ", damage)};
      }
    }
    const size_t count = std::min(out.size(), triggers_.size() - at_);
    std::copy_n(triggers_.begin() + static_cast<ptrdiff_t>(at_), count, out.begin());
    at_ += count;
    return count;
  }

 private:
  std::string take(const RosMessage& m) {
    if (!m.damage.empty()) return m.damage;
    const auto events = parse_ros_events(m.bytes, m.type, m.serialization);
    if (!events) return text("a message on ", m.topic, " is shorter than its fields say");
    return decoder_.decode(*events, triggers_);
  }

  std::string name_;
  RosTopic topic_;
  RosTriggerDecoder decoder_;
  std::vector<Trigger> triggers_;
  size_t at_ = 0;
};

}  // namespace

Result<std::unique_ptr<EventSource>> ros_events(std::unique_ptr<RosBag> bag, std::string_view format,
                                                const std::string& name, const ReadOptions& options) {
  auto topic = RosTopic::open(std::move(bag), options.stream, holds_events, "event topics");
  if (!topic) return topic.error();
  const auto sensor = agreed_sensor(topic->sensor(), options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<RosEventSource>(format, name, *sensor, options, *std::move(topic)));
}

Result<std::unique_ptr<TriggerSource>> ros_triggers(std::unique_ptr<RosBag> bag, const std::string& name,
                                                    const ReadOptions& options) {
  auto topic = RosTopic::open(std::move(bag), options.stream, holds_triggers, "trigger topics");
  if (!topic) return topic.error();
  return std::unique_ptr<TriggerSource>(std::make_unique<RosTriggerSource>(name, *std::move(topic)));
}

}  // namespace scarf
