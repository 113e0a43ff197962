// A pipeline that keeps every event on the sensor, in order, and what the stream knew of them: shows what a
// stream hands to pipelines.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "device/stream.h"
#include "kernels/event_log.h"
#include "tests/support/same.h"

namespace scarf::test {

class EventRecorder final : public Pipeline, private EventLogOwner {
 public:
  /// At most `most_events` in all.
  EventRecorder(GpuContext& context, SensorSize sensor, uint32_t submission_events, uint32_t most_events)
      : sensor_(sensor), submission_events_(submission_events) {
    EventLog::Shape shape;
    shape.sensor = sensor;
    shape.first_events = most_events;
    shape.keep = layout::kKeepSince;
    log_ = value_of(EventLog::create(context.vulkan(), shape, *this));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override { return log_->memory_bytes(); }
  Result<std::unique_ptr<EventBinding>> bind_events(const vulkan::Buffer& events) override {
    auto input = log_->bind_input(events);
    if (!input) return input.error();
    return std::unique_ptr<EventBinding>(new Binding(*std::move(input)));
  }
  void record_reset(vulkan::Commands& commands) override { log_->record_reset(commands); }
  Result<void> prepare_push(uint32_t count) override { return log_->prepare(count); }
  void record_push(vulkan::Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts& facts) override {
    EXPECT_LE(count, submission_events_);
    EXPECT_TRUE(facts.first.has_value());
    log_->record_append(commands, *static_cast<Binding&>(binding).input, first, count);
  }

  /// What was recorded, and the facts as a query sees them.
  struct Recorded {
    std::vector<Event> events;
    StreamFacts facts;
  };
  Result<Recorded> recorded(Stream& stream) {
    StreamFacts known;
    auto events =
        stream
            .query<std::vector<Event>>(
                QueryKind::events,
                [&](Query&, const StreamFacts& facts) -> Result<Answer<std::vector<Event>>> {
                  known = facts;
                  const std::vector<Part> parts = {{&log_->events(), log_->bound() * sizeof(Event)},
                                                   {&log_->length(), sizeof(uint32_t)}};
                  return Answer<std::vector<Event>>{
                      parts, [](HostParts p) -> Result<std::vector<Event>> { return events_of(p[0], p[1]); }};
                })
            .wait();
    if (!events) return events.error();
    return Recorded{*std::move(events), known};
  }

 private:
  struct Binding : EventBinding {
    explicit Binding(std::unique_ptr<EventLog::Input> i) : input(std::move(i)) {}
    std::unique_ptr<EventLog::Input> input;
  };

  Result<void> drop_old_events() override { return {}; }
  Result<void> bind_log(const EventLogMemory&) override { return {}; }

  SensorSize sensor_;
  uint32_t submission_events_;
  std::unique_ptr<EventLog> log_;
};

}  // namespace scarf::test
