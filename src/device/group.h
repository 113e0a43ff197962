// Streams of one device whose gathered events, and whose pictures, are submitted together.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "device/on_device.h"
#include "device/push_commands.h"
#include "device/stream.h"
#include "kernels/stage_times.h"
#include "scarf/device/group.h"
#include "vulkan/pool.h"

namespace scarf {

/// See GpuGroup. Pending results share it.
///
/// Locks are taken in this order: the group's mutex, the members' mutexes by the addresses of their streams
/// (which is the same order in all groups that share members), the mutex of a queue. Streams never take a
/// group's mutex.
class StreamGroup : public std::enable_shared_from_this<StreamGroup> {
 public:
  explicit StreamGroup(std::shared_ptr<GpuContext> context);
  ~StreamGroup();

  Result<void> add(const StreamFed& member);
  Result<void> flush();
  Result<void> finish();
  Pending<std::vector<Image<uint8_t>>> u8_images(std::optional<int64_t> now);
  std::vector<StageTime> stage_times();
  uint64_t memory_bytes();

 private:
  struct Member {
    std::weak_ptr<Stream> stream;
    U8Picture picture;
  };
  // A member that is alive, and locked.
  struct Locked {
    std::shared_ptr<Stream> stream;
    const U8Picture* picture;
    std::unique_lock<std::mutex> lock;  // released before the stream
  };
  struct Lease;
  using Images = std::vector<Image<uint8_t>>;

  // As Stream::exclusively.
  template <class Call>
  std::invoke_result_t<Call&> exclusively(Call call);
  std::vector<Locked> lock_members();
  Result<void> submit_gathered(std::span<const Locked> members);
  Result<void> submit_pictures(std::span<const Locked> members, std::optional<int64_t> now, Lease& lease);
  Result<std::unique_ptr<Query>> take_query();

  std::shared_ptr<GpuContext> context_;  // first, so that the device outlives all that follows
  vulkan::Device& device_;
  std::mutex mutex_;
  std::vector<Member> members_;
  uint64_t last_submission_ = 0;  // places in the timelines of the two queues
  uint64_t last_transfer_ = 0;
  uint64_t query_bytes_ = 0;
  Pool<PushCommands> push_pool_;
  Pool<Query> query_pool_;
  StageTimes stage_times_;
};

}  // namespace scarf
