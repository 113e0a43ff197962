// Replay on a device behind the public interface: groups are gathered, submitted, and handed over.
#include <array>

#include "core/batch_check.h"
#include "device/on_device.h"
#include "kernels/stage_times.h"
#include "pipelines/replay/pipeline.h"
#include "scarf/device/replay.h"
#include "vulkan/commands.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using vulkan::Commands;

template <class T>
inline constexpr ReplayPixels kPixels = ReplayPixels::u8;
template <>
inline constexpr ReplayPixels kPixels<float> = ReplayPixels::f32;
template <>
inline constexpr ReplayPixels kPixels<int32_t> = ReplayPixels::counts;

template <class T>
class GpuReplay final : public Replay {
 public:
  GpuReplay(std::shared_ptr<GpuContext> context, const Geometry& geometry, TakeReplayFrame<T> take)
      : context_(std::move(context)),
        device_(context_->vulkan()),
        geometry_(geometry),
        take_(std::move(take)) {}

  ~GpuReplay() override {
    // Nothing may be destroyed while the device uses it. A lost device uses nothing; after any other failure
    // to wait, waiting for everything is tried.
    if (device_.forked()) return;
    for (const Turn& turn : turns_) {
      if (!turn.commands.wait()) device_.calls().DeviceWaitIdle(device_.handle());
    }
  }

  Result<void> start(const Levels& levels, const ReplayPlan& plan) {
    auto pipeline = ReplayPipeline::create(device_, geometry_, kPixels<T>, levels, plan);
    if (!pipeline) return pipeline.error();
    pipeline_ = std::move(*pipeline);
    for (Turn& turn : turns_) {
      auto commands = Commands::create(device_, device_.compute());
      if (!commands) return commands.error();
      turn.commands = std::move(*commands);
      auto group = pipeline_->make_group();
      if (!group) return group.error();
      turn.group = std::move(*group);
      turn.frames.reserve(plan.group_frames);
      turn.events_before.reserve(plan.group_frames);
    }
    Commands& c = turns_[0].commands;
    if (auto r = c.begin(); !r) return r;
    pipeline_->record_reset(c);
    if (auto r = c.submit(); !r) return r;
    return c.wait();
  }

  const Geometry& geometry() const override { return geometry_; }

  Result<PushReport> push(std::span<const Event> events) override {
    return as_result([&]() -> Result<PushReport> {
      if (auto r = usable(); !r) return r.error();
      const auto batch = check_batch(events, geometry_.sensor(), t_first_);
      if (!batch) return batch.error();
      const auto taken = whole([&]() -> Result<void> {
        t_first_ = batch->t_first;
        const uint32_t most = pipeline_->plan().group_events;
        for (const Event& e : events) {
          if (!geometry_.sensor().contains(e)) continue;
          if (open().events == most) {
            if (auto r = close_group(); !r) return r;
          }
          Turn& turn = open();
          turn.group->events.template mapped_as<uint32_t>()[turn.events++] = e.x | uint32_t{e.y} << 16;
          ++events_;
        }
        return {};
      });
      if (!taken) return taken.error();
      return PushReport{events.size(), batch->outside};
    });
  }

  Result<void> frame() override {
    return whole([&]() -> Result<void> {
      if (open().frames.size() == pipeline_->plan().group_frames) {
        if (auto r = close_group(); !r) return r;
      }
      open().frames.push_back(open().events);
      open().events_before.push_back(events_);
      return {};
    });
  }

  Result<void> finish() override {
    return whole([&]() -> Result<void> {
      // Closing hands over the group before, then the next turn is the one that was closed.
      for (size_t i = 0; i < turns_.size(); ++i) {
        if (auto r = close_group(); !r) return r;
      }
      return {};
    });
  }

  std::vector<StageTime> stage_times() const override { return stage_times_.all(); }

  uint64_t memory_bytes() const override { return pipeline_->memory_bytes(); }

 private:
  // A group that is gathered, or in flight.
  struct Turn {
    std::unique_ptr<ReplayGroup> group;
    uint32_t events = 0;
    std::vector<uint32_t> frames;         // events of the group before each
    std::vector<uint64_t> events_before;  // of the stream
    Commands commands;                    // destroyed first
  };

  Turn& open() { return turns_[open_]; }

  Result<void> usable() const {
    if (failure_) return copy_of(*failure_);
    if (stopped_) {
      return Error{ErrorCode::illegal_parameter,
                   "the function that takes the frames threw an exception; make a new replay"};
    }
    return device_.check_process();
  }

  // Does all that `step` does; otherwise every later call says why not. Whatever it throws is a failure, too:
  // the frames are taken by a function of others.
  template <class Step>
  Result<void> whole(Step step) {
    return as_result([&]() -> Result<void> {
      if (auto r = usable(); !r) return r;
      stopped_ = true;  // unless it comes back
      auto done = as_result(step);
      stopped_ = false;
      if (!done) failure_ = copy_of(done.error());
      return done;
    });
  }

  // Submits the open group, if there is anything in it, and opens the other turn: the frames of the group
  // that was there are handed over.
  Result<void> close_group() {
    if (open().events > 0 || !open().frames.empty()) {
      if (auto r = submit(open()); !r) return r;
    }
    open_ = (open_ + 1) % turns_.size();
    return hand_over(open());
  }

  Result<void> submit(Turn& turn) {
    const std::vector<layout::ReplayChunk> chunks = cut_group(pipeline_->plan(), turn.events, turn.frames);
    std::copy(chunks.begin(), chunks.end(), turn.group->chunks.template mapped_as<layout::ReplayChunk>());
    if (auto r = turn.commands.begin(); !r) return r;
    pipeline_->record_group(turn.commands, *turn.group, turn.events, static_cast<uint32_t>(chunks.size() - 1),
                            static_cast<uint32_t>(turn.frames.size()));
    return turn.commands.submit();
  }

  Result<void> hand_over(Turn& turn) {
    if (turn.events == 0 && turn.frames.empty()) return {};
    if (auto r = turn.commands.wait(); !r) return r;
    stage_times_.collect(turn.commands);
    const ReplayPlan& plan = pipeline_->plan();
    const auto* pictures = turn.group->pictures.template mapped_as<uint8_t>();
    for (size_t i = 0; i < turn.frames.size(); ++i) {
      const auto* pixels = reinterpret_cast<const T*>(pictures + i * plan.picture_bytes());
      const ReplayFrame<T> frame = {
          frames_++, turn.events_before[i], geometry_.sensor(), {pixels, plan.pixels}};
      if (auto r = take_(frame); !r) return r;
    }
    turn.events = 0;
    turn.frames.clear();
    turn.events_before.clear();
    return {};
  }

  std::shared_ptr<GpuContext> context_;  // first, so that the device outlives all that follows
  vulkan::Device& device_;
  const Geometry geometry_;
  const TakeReplayFrame<T> take_;
  std::unique_ptr<ReplayPipeline> pipeline_;
  std::array<Turn, 2> turns_;
  size_t open_ = 0;
  std::optional<int64_t> t_first_;
  uint64_t events_ = 0;  // inside the sensor
  uint64_t frames_ = 0;  // handed over
  std::optional<Error> failure_;
  bool stopped_ = false;
  StageTimes stage_times_;
};

template <class T>
Result<std::unique_ptr<Replay>> make(std::shared_ptr<GpuContext> context, const Geometry& geometry,
                                     TakeReplayFrame<T> take, double accumulation,
                                     const ReplayOptions& options) {
  if (auto r = check_context(context); !r) return r.error();
  const auto checked = checked_geometry(geometry);
  if (!checked) return checked.error();
  const auto levels = make_levels(accumulation, geometry.capacity);
  if (!levels) return levels.error();
  const auto plan = make_replay_plan(*checked, kPixels<T>, context->vulkan().limits(), options);
  if (!plan) return plan.error();
  auto replay = std::make_unique<GpuReplay<T>>(std::move(context), *checked, std::move(take));
  if (auto r = replay->start(*levels, *plan); !r) return r.error();
  return std::unique_ptr<Replay>(std::move(replay));
}

}  // namespace

template <class T>
Result<std::unique_ptr<Replay>> make_gpu_replay(std::shared_ptr<GpuContext> context, const Geometry& geometry,
                                                TakeReplayFrame<T> take, double accumulation,
                                                const ReplayOptions& options) {
  return as_result(
      [&] { return make<T>(std::move(context), geometry, std::move(take), accumulation, options); });
}

template Result<std::unique_ptr<Replay>> make_gpu_replay(std::shared_ptr<GpuContext>, const Geometry&,
                                                         TakeReplayFrame<uint8_t>, double,
                                                         const ReplayOptions&);
template Result<std::unique_ptr<Replay>> make_gpu_replay(std::shared_ptr<GpuContext>, const Geometry&,
                                                         TakeReplayFrame<float>, double,
                                                         const ReplayOptions&);
template Result<std::unique_ptr<Replay>> make_gpu_replay(std::shared_ptr<GpuContext>, const Geometry&,
                                                         TakeReplayFrame<int32_t>, double,
                                                         const ReplayOptions&);

}  // namespace scarf
