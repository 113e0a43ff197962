#include "kernels/event_log.h"

#include <algorithm>
#include <cstring>

#include "compiled_shaders/shaders.h"
#include "core/text.h"

namespace scarf {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;

namespace {

constexpr uint64_t kWord = sizeof(uint32_t);

uint32_t runs_of(uint64_t events) {
  return static_cast<uint32_t>((events + layout::kLogRun - 1) / layout::kLogRun);
}

}  // namespace

Result<std::unique_ptr<EventLog>> EventLog::create(vulkan::Device& device, const Shape& shape,
                                                   EventLogOwner& owner) {
  std::unique_ptr<EventLog> log(new EventLog(device, shape, owner));
  if (auto r = log->build(); !r) return r.error();
  return log;
}

Result<void> EventLog::build() {
  PipelineBuilder b(device_);
  b.buffer(length_, "the length of the event log", kWord);
  b.readback(length_read_, "the length of the event log", kWord);
  b.readback(largest_, "the largest time of the event log", layout::kLargestTimes * sizeof(int64_t));
  prefix_.build(b, runs_of(most_events()) + 2);
  const uint32_t inside[] = {layout::kKeepInside};
  const uint32_t keep[] = {shape_.keep};
  const size_t push = sizeof(layout::EventLogPush);
  b.kernel(append_count_, "event_log_count", shaders::event_log_count, 4, push, inside);
  b.kernel(append_write_, "event_log_write", shaders::event_log_write, 5, push, inside);
  b.kernel(keep_count_, "event_log_count", shaders::event_log_count, 4, push, keep);
  b.kernel(keep_write_, "event_log_write", shaders::event_log_write, 5, push, keep);
  b.kernel(largest_kernel_, "event_log_largest", shaders::event_log_largest, 3, push);
  if (!b.result()) return b.result();
  fixed_bytes_ = b.bytes();
  auto commands = Commands::create(device_, device_.compute());
  if (!commands) return commands.error();
  commands_ = std::move(*commands);
  auto memory = make_memory(static_cast<uint32_t>(std::min<uint64_t>(shape_.first_events, most_events())));
  if (!memory) return memory.error();
  memory_ = std::move(*memory);
  return {};
}

uint64_t EventLog::most_events() const {
  return std::min<uint64_t>(device_.limits().storage_range / sizeof(Event), shape_.most_events);
}

Result<std::unique_ptr<EventLogMemory>> EventLog::make_memory(uint32_t capacity) {
  auto memory = std::make_unique<EventLogMemory>();
  EventLogMemory& m = *memory;
  m.capacity = capacity;
  PipelineBuilder b(device_);
  b.buffer(m.events, "the event log", uint64_t{capacity} * sizeof(Event));
  b.buffer(m.scratch, "the event log's copy", uint64_t{capacity} * sizeof(Event));
  b.buffer(m.places, "the places in the event log", (runs_of(capacity) + uint64_t{2}) * kWord);
  prefix_.bind(b, m.prefix, m.places);
  bind_copy(b, m.to_scratch, m, m.events, m.scratch, /*append=*/false);
  bind_copy(b, m.to_events, m, m.scratch, m.events, /*append=*/false);
  if (!b.result()) return b.result().error();
  return memory;
}

void EventLog::bind_copy(PipelineBuilder& b, EventLogMemory::Copy& copy, const EventLogMemory& memory,
                         const Buffer& from, const Buffer& to, bool append) const {
  const Buffer& keep_from = shape_.keep_from == nullptr ? length_ : *shape_.keep_from;
  b.bind(copy.count, append ? append_count_ : keep_count_, {&from, &memory.places, &length_, &keep_from});
  b.bind(copy.write, append ? append_write_ : keep_write_,
         {&from, &memory.places, &length_, &keep_from, &to});
}

Result<std::unique_ptr<EventLog::Input>> EventLog::bind_input(const Buffer& events) {
  std::unique_ptr<Input> input(new Input(*this));
  inputs_.push_back(input.get());
  PipelineBuilder b(device_);
  bind_copy(b, input->copy_, *memory_, events, memory_->events, /*append=*/true);
  if (!b.result()) return b.result().error();
  return input;
}

EventLog::Input::~Input() {
  std::erase(log_.inputs_, this);
}

void EventLog::record_reset(Commands& commands) {
  commands.fill(length_, 0);
  bound_ = 0;
  appended_ = 0;
  generation_ += 1;
}

void EventLog::record_copy(Commands& commands, const EventLogMemory::Copy& copy,
                           const layout::EventLogPush& push) {
  const uint32_t runs = runs_of(push.events);
  commands.dispatch(copy.count, runs, layout::kLinearGroup, push);
  commands.barrier();
  prefix_.record(commands, memory_->prefix, runs + 2);
  commands.dispatch(copy.write, runs, layout::kLinearGroup, push);
  commands.barrier();
  commands.copy(memory_->places, (runs + uint64_t{1}) * kWord, length_, 0, kWord);
  commands.barrier();
}

void EventLog::record_append(Commands& commands, const Input& input, uint32_t first, uint32_t count) {
  layout::EventLogPush push{};
  push.first = first;
  push.events = count;
  push.width = static_cast<uint32_t>(shape_.sensor.width);
  push.height = static_cast<uint32_t>(shape_.sensor.height);
  record_copy(commands, input.copy_, push);
  commands.mark("append");
  bound_ += count;
  appended_ += count;
}

void EventLog::record_keep(Commands& commands, From from, layout::EventLogPush push) {
  push.first = 0;
  push.events = bound();
  push.block_width = static_cast<uint32_t>(shape_.block.width);
  push.block_height = static_cast<uint32_t>(shape_.block.height);
  push.block_columns = shape_.block_columns;
  if (push.events == 0) return;
  record_copy(commands, from == From::events ? memory_->to_scratch : memory_->to_events, push);
}

void EventLog::record_copy_back(Commands& commands) const {
  commands.copy(memory_->scratch, 0, memory_->events, 0, uint64_t{bound_} * sizeof(Event));
  commands.barrier();
}

uint32_t EventLog::bound() {
  std::lock_guard lock(known_->mutex);
  if (known_->generation == generation_) {
    bound_ =
        static_cast<uint32_t>(std::min<uint64_t>(bound_, known_->length + (appended_ - known_->appended)));
  }
  return bound_;
}

std::function<void(const void*)> EventLog::length_reader() const {
  return [known = known_, generation = generation_, appended = appended_](const void* length) {
    std::lock_guard lock(known->mutex);
    // Answers may be read in any order; the newest counts.
    if (std::pair(generation, appended) < std::pair(known->generation, known->appended)) return;
    const uint32_t read = *static_cast<const uint32_t*>(length);
    const bool same_place = std::pair(generation, appended) == std::pair(known->generation, known->appended);
    known->length = same_place ? std::min(known->length, read) : read;
    known->generation = generation;
    known->appended = appended;
  };
}

Result<void> EventLog::run(const std::function<void(Commands&)>& record) {
  if (auto r = commands_.begin(); !r) return r;
  record(commands_);
  if (auto r = commands_.submit(); !r) return r;
  return commands_.wait();
}

Result<void> EventLog::read_length() {
  if (auto r = run([this](Commands& c) { c.copy(length_, 0, length_read_, 0, kWord); }); !r) return r;
  bound_ = *length_read_.mapped_as<uint32_t>();
  return {};
}

Result<int64_t> EventLog::largest_time() {
  PipelineBuilder b(device_);
  BoundKernel bound;
  b.bind(bound, largest_kernel_, {&memory_->events, &length_, &largest_});
  if (!b.result()) return b.result().error();
  layout::EventLogPush push{};
  push.events = bound_;
  const auto record = [&](Commands& c) {
    c.dispatch(bound, layout::kLargestTimes, layout::kLinearGroup, push);
  };
  if (auto r = run(record); !r) return r.error();
  const auto* times = largest_.mapped_as<int64_t>();
  return *std::max_element(times, times + layout::kLargestTimes);
}

Result<void> EventLog::prepare(uint32_t count) {
  const auto fits = [&] { return uint64_t{bound()} + count <= memory_->capacity; };
  if (fits()) return {};
  if (auto r = read_length(); !r) return r;
  if (fits()) return {};
  if (auto r = owner_.drop_old_events(); !r) return r;
  if (auto r = read_length(); !r) return r;
  // Twice what is needed, so that there is rarely need for this.
  const uint64_t needed = uint64_t{bound_} + count;
  uint64_t capacity = memory_->capacity;
  while (capacity < 2 * needed) capacity *= 2;
  capacity = std::min(capacity, most_events());
  if (needed > capacity) return full(needed);
  if (capacity == memory_->capacity) return {};
  const auto grown = as_result([&] { return grow(static_cast<uint32_t>(capacity)); });
  return fits() ? Result<void>() : grown;
}

// The device is idle.
Result<void> EventLog::grow(uint32_t capacity) {
  auto memory = make_memory(capacity);
  if (!memory) return memory.error();
  EventLogMemory& m = **memory;
  const auto record = [&](Commands& c) {
    c.copy(memory_->events, 0, m.events, 0, uint64_t{bound_} * sizeof(Event));
  };
  if (auto r = run(record); !r) return r;
  if (auto r = owner_.bind_log(m); !r) return r;
  for (Input* input : inputs_) {
    input->copy_.count.rebind(1, m.places);
    input->copy_.write.rebind(1, m.places);
    input->copy_.write.rebind(4, m.events);
  }
  memory_ = std::move(*memory);
  return {};
}

Error EventLog::full(uint64_t needed) const {
  return {ErrorCode::out_of_memory,
          text("the event log needs room for ", needed, " events, but on device ", device_.info().name,
               " it holds at most ", most_events(), "; ", shape_.advice)};
}

uint64_t EventLog::memory_bytes() const {
  return fixed_bytes_ + memory_->events.size() + memory_->scratch.size() + memory_->places.size();
}

std::vector<Event> events_of(const void* events, const void* length) {
  const auto* first = static_cast<const Event*>(events);
  return {first, first + *static_cast<const uint32_t*>(length)};
}

}  // namespace scarf
