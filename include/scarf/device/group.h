// Many small streams on one Vulkan device, submitted together.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scarf/device/stream.h"

namespace scarf {

/// Representations (of several cameras or recordings, or of one with several parameters) whose work goes to
/// the device in common submissions: the stages of all members run side by side, and what a submission costs
/// by itself is paid once. Members may differ in everything but the context.
///
/// A member stays what it was: whoever made it pushes into it, which gathers events up to its
/// GpuOptions::submission_events, and it submits those itself when its staging slot is full or when a query
/// or flush() of its own asks for them. Which way events went never shows in a result. A member that is
/// destroyed leaves the group, which does not own it; the group may be destroyed before its members. Most of
/// a small member's memory is for what it may gather: choose its submission_events and staging_slots.
///
/// Threads: any thread may call any function, while others push into the members and query them. A call
/// locks all members until its work is submitted.
class GpuGroup {
 public:
  virtual ~GpuGroup() = default;

  /// Errors: illegal_parameter if the representation was made with another context or not by this library,
  /// or is a member already.
  virtual Result<void> add(GpuRepresentation& member) = 0;

  /// Starts work on the events that all members have gathered, in one submission; does not wait for it.
  /// (Words of a GpuDecoder are submitted by their member alone.) Errors: those of GpuRepresentation::flush.
  /// If one member cannot take part the others' events are submitted all the same, and if the submission
  /// fails all events stay gathered.
  virtual Result<void> flush() = 0;
  /// As flush(), and waits until all work that the members were asked for so far is done.
  virtual Result<void> finish() = 0;

  /// The u8_image(now) of every member, in the order in which they were added, after flush(): painted and
  /// copied in one submission. Errors: those of flush(), and of u8_image of any member.
  virtual Pending<std::vector<Image<uint8_t>>> u8_images(std::optional<int64_t> now = {}) = 0;

  /// Device time per stage of the common submissions; where members are at different stages of a step, the
  /// first one gets the time. Empty where the device has no timestamps.
  virtual std::vector<StageTime> stage_times() const = 0;
  /// Device and host-visible memory of the group itself, in bytes.
  virtual uint64_t memory_bytes() const = 0;
};

/// A group without members. With a null context it stays one: every call returns illegal_parameter.
std::unique_ptr<GpuGroup> make_gpu_group(std::shared_ptr<GpuContext> context);

}  // namespace scarf
