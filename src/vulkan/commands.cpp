#include "vulkan/commands.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/ceil_div.h"

namespace scarf::vulkan {

WorkgroupGrid workgroup_grid(uint64_t workgroups, uint32_t most_columns) {
  const uint64_t rows = ceil_div(workgroups, most_columns);
  return {static_cast<uint32_t>(ceil_div(workgroups, rows)), static_cast<uint32_t>(rows)};
}

Result<Commands> Commands::create(Device& device, Queue& queue) {
  const Table& calls = device.calls();
  Commands c;
  c.device_ = &device;
  c.queue_ = &queue;
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool.queueFamilyIndex = queue.family();
  if (auto r = device.check(calls.CreateCommandPool(device.handle(), &pool, nullptr, &c.pool_),
                            "CreateCommandPool");
      !r) {
    return r.error();
  }
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = c.pool_;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  if (auto r = device.check(calls.AllocateCommandBuffers(device.handle(), &info, &c.buffer_),
                            "AllocateCommandBuffers");
      !r) {
    return r.error();
  }
  // Timestamps are asked of the compute queue only: a transfer family may not have them.
  if (device.limits().timestamp_period > 0 && &queue == &device.compute()) {
    VkQueryPoolCreateInfo queries{};
    queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = kMaxStages + 1;
    if (auto r = device.check(calls.CreateQueryPool(device.handle(), &queries, nullptr, &c.queries_),
                              "CreateQueryPool");
        !r) {
      return r.error();
    }
  }
  return c;
}

Commands::~Commands() {
  if (device_ == nullptr || device_->forked()) return;
  const Table& calls = device_->calls();
  if (queries_ != VK_NULL_HANDLE) calls.DestroyQueryPool(device_->handle(), queries_, nullptr);
  if (pool_ != VK_NULL_HANDLE) calls.DestroyCommandPool(device_->handle(), pool_, nullptr);
}

Result<void> Commands::begin() {
  const Table& calls = device_->calls();
  stages_.clear();
  in_part_ = false;
  steps_.clear();
  if (auto r = device_->check(calls.ResetCommandPool(device_->handle(), pool_, 0), "ResetCommandPool"); !r)
    return r;
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (auto r = device_->check(calls.BeginCommandBuffer(buffer_, &info), "BeginCommandBuffer"); !r) return r;
  if (queries_ != VK_NULL_HANDLE) {
    calls.CmdResetQueryPool(buffer_, queries_, 0, kMaxStages + 1);
    timestamp();
  }
  barrier();
  return {};
}

template <class Recorded>
void Commands::record(Recorded command) {
  if (!in_part_) {
    command(device_->calls(), buffer_);
    return;
  }
  steps_[step_].commands.emplace_back(std::move(command));
  step_is_empty_ = false;
}

void Commands::dispatch_bytes(const BoundKernel& bound, uint64_t invocations, uint32_t workgroup_size,
                              const void* push, uint32_t push_bytes) {
  if (invocations == 0) return;
  const Kernel& kernel = bound.kernel();
  const WorkgroupGrid grid =
      workgroup_grid(ceil_div(invocations, workgroup_size), device_->limits().workgroups);
  std::array<std::byte, kMaxPushBytes> constants{};
  std::memcpy(constants.data(), push, push_bytes);
  record([=, pipeline = kernel.pipeline(), layout = kernel.layout(), set = bound.set()](
             const Table& calls, VkCommandBuffer buffer) {
    calls.CmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    calls.CmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    calls.CmdPushConstants(buffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes, constants.data());
    calls.CmdDispatch(buffer, grid.columns, grid.rows, 1);
  });
}

void Commands::copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
  if (bytes == 0) return;
  record([=, source = from.handle(), target = to.handle()](const Table& calls, VkCommandBuffer buffer) {
    const VkBufferCopy region = {from_offset, to_offset, bytes};
    calls.CmdCopyBuffer(buffer, source, target, 1, &region);
  });
}

void Commands::fill(const Buffer& buffer, uint64_t bytes, uint32_t word) {
  if (bytes == 0) return;
  record([=, target = buffer.handle()](const Table& calls, VkCommandBuffer commands) {
    calls.CmdFillBuffer(commands, target, 0, bytes, word);
  });
}

void Commands::begin_part() {
  in_part_ = true;
  step_ = 0;
  step_is_empty_ = true;
  if (steps_.empty()) steps_.emplace_back();
}

void Commands::record_steps() {
  if (!in_part_) return;
  in_part_ = false;
  for (const Step& step : steps_) {
    if (&step != &steps_.front()) barrier();
    for (const std::string_view stage : step.begin_marks) end_stage(stage);
    for (const Command& command : step.commands) command(device_->calls(), buffer_);
    for (const std::string_view stage : step.end_marks) end_stage(stage);
  }
  steps_.clear();
}

void Commands::memory_barrier(VkPipelineStageFlags2 to_stages, VkAccessFlags2 to_access) {
  VkMemoryBarrier2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  memory.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  memory.dstStageMask = to_stages;
  memory.dstAccessMask = to_access;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &memory;
  device_->calls().CmdPipelineBarrier2(buffer_, &info);
}

void Commands::barrier() {
  if (in_part_) {
    ++step_;
    step_is_empty_ = true;
    if (steps_.size() == step_) steps_.emplace_back();
    return;
  }
  memory_barrier(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                 VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
}

void Commands::timestamp() {
  device_->calls().CmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_,
                                      static_cast<uint32_t>(stages_.size()));
}

void Commands::mark(std::string_view stage) {
  if (!in_part_) {
    end_stage(stage);
    return;
  }
  std::vector<std::string_view>& marks = step_is_empty_ ? steps_[step_].begin_marks : steps_[step_].end_marks;
  if (std::find(marks.begin(), marks.end(), stage) == marks.end()) marks.push_back(stage);
}

void Commands::end_stage(std::string_view stage) {
  if (queries_ == VK_NULL_HANDLE || stages_.size() == kMaxStages) return;
  stages_.push_back(stage);
  timestamp();
}

Result<void> Commands::submit(const Queue* wait_queue, uint64_t wait_value) {
  record_steps();
  memory_barrier(VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  if (auto r = device_->check(device_->calls().EndCommandBuffer(buffer_), "EndCommandBuffer"); !r) return r;
  const auto value = queue_->submit(buffer_, wait_queue, wait_value);
  if (!value) {
    stages_.clear();
    return value.error();
  }
  value_ = *value;
  return {};
}

Result<void> Commands::wait() const {
  return value_ == 0 ? Result<void>() : queue_->wait(value_);
}

Result<bool> Commands::done() const {
  return value_ == 0 ? Result<bool>(true) : queue_->done(value_);
}

Result<std::vector<StageSpan>> Commands::take_times() {
  std::vector<StageSpan> spans;
  if (stages_.empty()) return spans;
  std::vector<uint64_t> ticks(stages_.size() + 1);
  const VkResult result = device_->calls().GetQueryPoolResults(
      device_->handle(), queries_, 0, static_cast<uint32_t>(ticks.size()), ticks.size() * sizeof(uint64_t),
      ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  if (auto r = device_->check(result, "GetQueryPoolResults"); !r) return r.error();
  const Limits& limits = device_->limits();
  for (size_t i = 0; i < stages_.size(); ++i) {
    const uint64_t delta = (ticks[i + 1] - ticks[i]) & limits.timestamp_mask;
    spans.push_back(
        {stages_[i], static_cast<uint64_t>(static_cast<double>(delta) * limits.timestamp_period)});
  }
  stages_.clear();
  return spans;
}

void Commands::swap(Commands& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(queue_, other.queue_);
  std::swap(pool_, other.pool_);
  std::swap(buffer_, other.buffer_);
  std::swap(queries_, other.queries_);
  std::swap(stages_, other.stages_);
  std::swap(in_part_, other.in_part_);
  std::swap(steps_, other.steps_);
  std::swap(step_, other.step_);
  std::swap(step_is_empty_, other.step_is_empty_);
  std::swap(value_, other.value_);
}

}  // namespace scarf::vulkan
