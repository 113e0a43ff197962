// One command buffer that is recorded, submitted, waited for and used again, with timestamps between its
// stages.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "vulkan/kernel.h"

namespace scarf::vulkan {

/// Device time of a stage in one submission.
struct StageSpan {
  std::string_view stage;  ///< a string literal
  uint64_t nanoseconds = 0;
};

/// Workgroups of a dispatch: columns x rows of them. There may be more than were asked for, by less than a
/// column: the stages leave these alone.
struct WorkgroupGrid {
  uint32_t columns = 0;
  uint32_t rows = 0;
};

/// At least `workgroups`, of which a device takes `most_columns` side by side.
WorkgroupGrid workgroup_grid(uint64_t workgroups, uint32_t most_columns);

class Commands {
 public:
  static constexpr uint32_t kMaxStages = 15;
  static constexpr size_t kMaxPushBytes = 128;  ///< of push constants: what every device takes

  Commands() = default;
  Commands(Commands&& other) noexcept { swap(other); }
  Commands& operator=(Commands&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Commands();

  static Result<Commands> create(Device& device, Queue& queue);

  /// Starts recording; the previous submission must be done. All earlier work on the queue is visible to what
  /// follows.
  Result<void> begin();
  /// Runs the kernel on at least `invocations` of it, in workgroups of `workgroup_size`; see linear_index()
  /// in shaders/common/invocation.glsl. No invocations: nothing is recorded.
  template <class Push>
  void dispatch(const BoundKernel& bound, uint64_t invocations, uint32_t workgroup_size, const Push& push) {
    static_assert(sizeof(Push) <= kMaxPushBytes);
    dispatch_bytes(bound, invocations, workgroup_size, &push, sizeof(Push));
  }
  void copy(const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset, uint64_t bytes);
  /// Fills the first `bytes` (a multiple of 4) of a buffer, or all of it, with a word.
  void fill(const Buffer& buffer, uint64_t bytes, uint32_t word);
  void fill(const Buffer& buffer, uint32_t word) { fill(buffer, buffer.size(), word); }
  /// Makes everything recorded so far visible to everything that follows; within a part, what the part
  /// recorded.
  void barrier();
  /// Ends a stage: the time since begin() or the previous mark is its own. A string literal. Where parts end
  /// stages of several names together, the first one gets the time.
  void mark(std::string_view stage);
  /// Begins a part: it ends with the next one, or the last with submit(). Parts run side by side: between
  /// the n-th and the next barrier of one part runs the same piece of every other, and one barrier separates
  /// such steps however many parts there are. What one part writes no other may use.
  void begin_part();
  /// Ends the recording and submits it; makes its results visible to the host once it is done.
  Result<void> submit(const Queue* wait_queue = nullptr, uint64_t wait_value = 0);

  /// Waits for the last submission, if there is one.
  Result<void> wait() const;
  Result<bool> done() const;
  uint64_t value() const { return value_; }
  /// Device times of the last submission, which must be done; each is handed out once.
  Result<std::vector<StageSpan>> take_times();

 private:
  // A command that goes into the command buffer at once, or when all parts are known.
  using Command = std::function<void(const Table&, VkCommandBuffer)>;
  // What parts record between two of their barriers.
  struct Step {
    std::vector<std::string_view> begin_marks;  // in front of the commands ...
    std::vector<Command> commands;
    std::vector<std::string_view> end_marks;  // ... and behind some of them
  };

  void dispatch_bytes(const BoundKernel& bound, uint64_t invocations, uint32_t workgroup_size,
                      const void* push, uint32_t push_bytes);
  template <class Recorded>
  void record(Recorded command);
  void record_steps();
  void end_stage(std::string_view stage);
  void memory_barrier(VkPipelineStageFlags2 to_stages, VkAccessFlags2 to_access);
  void timestamp();
  void swap(Commands& other) noexcept;

  Device* device_ = nullptr;
  Queue* queue_ = nullptr;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
  std::vector<std::string_view> stages_;
  bool in_part_ = false;
  std::vector<Step> steps_;    // of all parts
  size_t step_ = 0;            // of the part that is being recorded ...
  bool step_is_empty_ = true;  // ... where it has no command yet
  uint64_t value_ = 0;
};

}  // namespace scarf::vulkan
