// sits on a device. The rule depends on the values that earlier events left behind, so events are taken in
// their order: by one team for all of them, or by one team per tile, again and again until the tiles agree.
// Both are exact; see shaders/sits/sits_walk.comp and shaders/sits/sits_sweep.comp.
#include "pipelines/sits/sits.h"

#include <algorithm>
#include <cmath>

#include "compiled_shaders/shaders.h"
#include "core/ceil_div.h"
#include "core/little_endian.h"
#include "core/sensor_check.h"
#include "kernels/submission.h"
#include "kernels/tile_lists.h"
#include "kernels/tone.h"
#include "shaders/sits/sits_layout.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

constexpr uint64_t kWord = sizeof(uint32_t);

// Small tiles have short lists and keep more of a device busy; but their halos hold more events than they do,
// if the window is large.
constexpr uint32_t kSmallTile = 16;
constexpr uint32_t kLargeTile = 32;
constexpr int32_t kMostSmallTileKernel = 15;
// Every tile is a multiple of a team, which has so many columns of two pixels and rows at most.
constexpr uint32_t kMostTeamX = 8;
constexpr uint32_t kMostTeamY = 16;
// Recordings settle in 3 to 16 sweeps. Those that are not needed cost an empty dispatch each.
constexpr uint32_t kSweeps = 24;
// Longer submissions need more sweeps of longer lists.
constexpr uint32_t kSweepSubmissionEvents = 1u << 15;
constexpr uint32_t kMostSweepSubmissionEvents = 1u << 18;
// Dispatches of the walk per submission, on devices that limit the length of one.
constexpr uint32_t kWalkDispatches = 64;

// Blocks of team_x x team_y pairs of pixels that a window of `side` pixels per axis, wherever it begins, is
// visited in.
constexpr uint32_t blocks_of(uint32_t side, uint32_t team_x, uint32_t team_y) {
  return ceil_div(side / 2 + 1, team_x) * ceil_div(side, team_y);
}

// The shape that visits a window in the fewest blocks; the widest of these.
void choose_team(SitsPlan& plan, uint32_t lanes, uint32_t side) {
  uint32_t fewest = UINT32_MAX;
  for (uint32_t x = 1; x <= std::min(lanes, kMostTeamX); x *= 2) {
    const uint32_t y = lanes / x;
    const uint32_t blocks = blocks_of(side, x, y);
    if (y > kMostTeamY || blocks > fewest) continue;
    fewest = blocks;
    plan.team_x = x;
    plan.team_y = y;
  }
}

// Events of one dispatch that the loop budget leaves, when `other_trips` are spent elsewhere.
uint32_t events_within(const SitsPlan& plan, const vulkan::Limits& limits, uint32_t most_pixels,
                       uint64_t other_trips) {
  const uint64_t blocks = (limits.loop_trips - other_trips) / sits_trips_per_block(plan, most_pixels);
  return static_cast<uint32_t>(std::min<uint64_t>(blocks * plan.team_lanes(), UINT32_MAX));
}

struct SitsBinding : EventBinding {
  BoundKernel walk, guess;
  BoundKernel sweep[2];  // even, odd
  TileLists::Bound lists;
};

class SitsPipeline final : public ImagePipeline {
 public:
  static MadePipeline create(vulkan::Device& device, const SitsParameters& parameters, SensorSize sensor,
                             const SitsPlan& plan) {
    std::unique_ptr<SitsPipeline> p(new SitsPipeline(device, parameters, sensor, plan));
    PipelineBuilder builder(device);
    p->build(builder);
    if (!builder.result()) return builder.result().error();
    p->bytes_ = builder.bytes();
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return plan_.submission_events; }
  uint64_t memory_bytes() const override { return bytes_; }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto k = std::make_unique<SitsBinding>();
    PipelineBuilder b(device_);
    b.bind(k->walk, walk_, {&events, &values_, &unsettled_});
    if (plan_.strategy == SitsStrategy::sweeps) {
      lists_.bind(b, k->lists, events);
      b.bind(k->guess, guess_, {&events, &values_, &centres_[0]});
      for (int odd : {0, 1}) {
        b.bind(k->sweep[odd], sweep_,
               {&events, &lists_.begins(), &lists_.lists(), &values_, &swept_, &centres_[odd],
                &centres_[1 - odd], &unsettled_});
      }
    }
    if (!b.result()) return b.result().error();
    return std::unique_ptr<EventBinding>(std::move(k));
  }

  void record_reset(Commands& commands) override {
    commands.fill(values_, 0);
    commands.mark("reset");
  }

  void record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts&) override {
    const auto& kernels = static_cast<const SitsBinding&>(binding);
    layout::SitsPush push = push_;
    push.first_event = first;
    push.events = count;
    if (plan_.strategy == SitsStrategy::sweeps) record_sweeps(commands, kernels, push);
    record_walk(commands, kernels, push);
  }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts&,
                                           std::optional<int64_t>) override {
    tone_.record_u8(commands, toned_values_, numbers());
    return cropped<uint8_t, uint8_t>(tone_.picture());
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts&,
                                            std::optional<int64_t>) override {
    tone_.record_float(commands, toned_values_, numbers());
    return cropped<float, float>(tone_.picture());
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands&, const StreamFacts&) override {
    return cropped<int64_t, int32_t>(values_);
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands&, const StreamFacts&) override {
    const Answer<Image<int32_t>> values = cropped<int32_t, int32_t>(values_);
    const auto read = [values = values.read](HostParts parts) -> Result<std::vector<uint8_t>> {
      const auto image = values(parts);
      if (!image) return image.error();
      std::vector<uint8_t> bytes;
      bytes.reserve(image->pixels.size() * sizeof(int32_t));
      for (const int32_t value : image->pixels) append_little_endian(bytes, value);
      return bytes;
    };
    return Answer<std::vector<uint8_t>>{values.parts, read};
  }

 private:
  SitsPipeline(vulkan::Device& device, const SitsParameters& parameters, SensorSize sensor,
               const SitsPlan& plan)
      : device_(device), parameters_(parameters), sensor_(sensor), plan_(plan) {
    using Rule = SitsParameters::Rule;
    push_.width = static_cast<uint32_t>(sensor.width);
    push_.height = static_cast<uint32_t>(sensor.height);
    push_.pairs_x = (push_.width + 1) / 2;
    push_.reach = parameters.kernel / 2;
    push_.white = parameters.kernel * parameters.kernel;
    // With event_driven, pixels visited after the centre are compared with what the centre has become: 1
    // less.
    push_.least_before = parameters.rule == Rule::greater ? 1 : 0;
    push_.least_after = parameters.rule == Rule::event_driven ? -1 : push_.least_before;
    push_.sweeps = plan.sweeps;
  }

  uint64_t pairs() const { return uint64_t{push_.pairs_x} * push_.height; }
  uint64_t numbers() const { return 2 * pairs(); }

  // The columns of the sensor: if their number is odd, rows of pairs are one pixel longer.
  template <class T, class Number>
  Answer<Image<T>> cropped(const Buffer& buffer) const {
    const auto read = [s = sensor_, row = 2 * uint64_t{push_.pairs_x}](HostParts parts) -> Result<Image<T>> {
      Image<T> image(s.width, s.height);
      const auto* from = static_cast<const Number*>(parts[0]);
      T* to = image.pixels.data();
      for (int32_t y = 0; y < s.height; ++y, from += row, to += s.width) std::copy_n(from, s.width, to);
      return image;
    };
    return {{{&buffer, numbers() * sizeof(Number)}}, read};
  }

  void build(PipelineBuilder& b) {
    b.buffer(values_, "the values", numbers() * kWord);
    const uint32_t team[] = {plan_.team_lanes(), plan_.team_x, plan_.team_y, plan_.tile};
    b.kernel(walk_, "sits_walk", shaders::sits_walk, vulkan::Bindings::vectors_and(2),
             sizeof(layout::SitsPush), std::span(team, 3),
             /*whole_subgroups=*/true);
    tone_.build(b, sits_levels(parameters_), numbers());
    tone_.bind(b, toned_values_, values_);
    if (plan_.strategy == SitsStrategy::sweeps) {
      build_sweeps(b, team);
    } else {
      b.buffer(unsettled_, "the state of the sweeps", kWord);  // bound, but not read
    }
  }

  void build_sweeps(PipelineBuilder& b, std::span<const uint32_t> team) {
    const TileListsPlan lists = make_tile_lists_plan(sensor_, plan_.tile, static_cast<uint32_t>(push_.reach),
                                                     plan_.submission_events, device_.limits());
    lists_.build(b, lists);
    push_.tiles_x = lists.tiles_x;
    push_.tiles_y = lists.tiles_y;
    b.buffer(swept_, "the values of the last sweep", numbers() * kWord);
    for (Buffer& centres : centres_) {
      b.buffer(centres, "the values at the centres of windows", plan_.submission_events * kWord);
    }
    b.buffer(unsettled_, "the state of the sweeps", (plan_.sweeps + 2 * uint64_t{lists.tiles()}) * kWord);
    const uint32_t tile[] = {plan_.tile};
    b.kernel(guess_, "sits_guess", shaders::sits_guess, vulkan::Bindings::vectors_and(2),
             sizeof(layout::SitsPush));
    b.kernel(sweep_, "sits_sweep", shaders::sits_sweep, vulkan::Bindings::vectors_and(7),
             sizeof(layout::SitsPush), team,
             /*whole_subgroups=*/true);
    b.kernel(commit_, "sits_commit", shaders::sits_commit, 4, sizeof(layout::SitsPush), tile);
    b.bind(bound_commit_, commit_, {&lists_.begins(), &swept_, &values_, &unsettled_});
  }

  void record_walk(Commands& commands, const SitsBinding& kernels, layout::SitsPush push) const {
    const uint32_t end = push.first_event + push.events;
    while (push.first_event < end) {
      push.events = std::min(plan_.walk_events, end - push.first_event);
      commands.dispatch(kernels.walk, plan_.team_lanes(), plan_.team_lanes(), push);
      commands.barrier();
      push.first_event += push.events;
    }
    commands.mark("walk");
  }

  // Afterwards push says that the walk is needed only if the sweeps did not settle.
  void record_sweeps(Commands& commands, const SitsBinding& kernels, layout::SitsPush& push) const {
    commands.fill(unsettled_, 0);
    push.chunks = lists_.record(commands, kernels.lists, push.first_event, push.events).chunks;
    commands.dispatch(kernels.guess, push.events, layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("guess");
    const uint64_t tiles = uint64_t{push.tiles_x} * push.tiles_y;
    for (push.sweep = 0; push.sweep < plan_.sweeps; ++push.sweep) {
      commands.dispatch(kernels.sweep[push.sweep % 2], tiles * plan_.team_lanes(), plan_.team_lanes(), push);
      commands.barrier();
    }
    commands.mark("sweep");
    commands.dispatch(bound_commit_, pairs(), layout::kLinearGroup, push);
    commands.barrier();
    commands.mark("commit");
    push.only_unsettled = 1;
  }

  vulkan::Device& device_;
  const SitsParameters parameters_;
  const SensorSize sensor_;
  const SitsPlan plan_;
  layout::SitsPush push_{};  // what all stages are told
  uint64_t bytes_ = 0;
  Buffer values_;  // rows of pairs of pixels
  Tone tone_;
  Tone::Source toned_values_;
  Kernel walk_;
  // With SitsStrategy::sweeps.
  TileLists lists_;
  Buffer swept_, centres_[2], unsettled_;
  Kernel guess_, sweep_, commit_;
  BoundKernel bound_commit_;
};

}  // namespace

uint64_t sits_trips_per_block(const SitsPlan& plan, uint32_t most_pixels) {
  // A loop costs its trips and one for its entry: blocks of events, events, blocks of pixels.
  const uint32_t visits =
      ceil_div(blocks_of(most_pixels, plan.team_x, plan.team_y), layout::kSitsBlocksPerTrip);
  return 1 + 1 + uint64_t{plan.team_lanes()} * (1 + 1 + visits);
}

SitsPlan make_sits_plan(int32_t kernel, const vulkan::Limits& limits, const GpuOptions& options,
                        const SitsChoices& choices) {
  SitsPlan plan;
  plan.strategy = choices.strategy.value_or(limits.cpu ? SitsStrategy::walk : SitsStrategy::sweeps);
  plan.tile = choices.tile.value_or(kernel <= kMostSmallTileKernel ? kSmallTile : kLargeTile);
  plan.sweeps = choices.sweeps.value_or(kSweeps);
  const auto side = static_cast<uint32_t>(kernel);
  choose_team(plan, limits.subgroup_size, side);
  // 8: the entry of the loop over blocks, and loops of the compiler itself.
  plan.walk_events = events_within(plan, limits, side, 8);
  if (plan.strategy == SitsStrategy::walk) {
    const uint64_t most = uint64_t{kWalkDispatches} * plan.walk_events;
    plan.submission_events =
        static_cast<uint32_t>(std::min<uint64_t>(most, submission_events(options, limits)));
    return plan;
  }
  // A list may hold the whole submission. A sweep also loads and stores its tile, may keep its centres, and
  // looks at its neighbours: at most 9 x 9 tiles, with the entries of the loops.
  const uint32_t window = std::min(side, plan.tile);
  const uint64_t other_trips = 8 + 2 * (plan.tile * plan.tile / 2 / plan.team_lanes() + 1) + 1 + 9 * 11;
  const uint32_t wanted = options.submission_events != 0 ? options.submission_events : kSweepSubmissionEvents;
  plan.submission_events =
      std::min({wanted, kMostSweepSubmissionEvents, events_within(plan, limits, window, other_trips)});
  return plan;
}

Levels sits_levels(const SitsParameters& p) {
  const int32_t white = p.kernel * p.kernel;
  Levels levels;
  for (int32_t value = 0; value <= white; ++value) {
    // nearbyint rounds half to even in the default rounding mode.
    levels.u8.push_back(p.rule == SitsParameters::Rule::event_driven
                            ? static_cast<uint8_t>(std::min(255, value))
                            : static_cast<uint8_t>(std::nearbyint(255.0 * value / white)));
    levels.f32.push_back(static_cast<float>(static_cast<double>(value) / white));
  }
  return levels;
}

MadePipeline make_sits(vulkan::Device& device, const SitsParameters& parameters, SensorSize sensor,
                       const GpuOptions& options, const SitsChoices& choices) {
  if (auto r = check_sensor(sensor); !r) return r.error();
  if (auto r = check_options(options); !r) return r.error();
  return SitsPipeline::create(device, parameters, sensor,
                              make_sits_plan(parameters.kernel, device.limits(), options, choices));
}

MadePipeline make_sits(vulkan::Device& device, const SitsParameters& parameters, SensorSize sensor,
                       const GpuOptions& options) {
  return make_sits(device, parameters, sensor, options, {});
}

}  // namespace scarf
