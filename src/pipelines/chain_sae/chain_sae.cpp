// CHAIN-SAE on a device. Events only stamp their pixels with their place in the stream; a query ranks the
// pixels by their stamps. Stamps are distinct, so they are ranked by counting: a set with one bit per stamp,
// a prefix sum over the bits of its words, and what is left within a word.
#include <algorithm>

#include "compiled_shaders/shaders.h"
#include "core/little_endian.h"
#include "core/sensor_check.h"
#include "core/tables.h"
#include "kernels/scan.h"
#include "kernels/submission.h"
#include "kernels/tone.h"
#include "pipelines/base/pipelines.h"
#include "shaders/chain_sae/chain_sae_layout.h"

namespace scarf {
namespace {

using vulkan::BoundKernel;
using vulkan::Buffer;
using vulkan::Commands;
using vulkan::Kernel;

constexpr uint64_t kWord = sizeof(uint32_t);

struct ChainBinding : EventBinding {
  BoundKernel stamp;
};

// How many stamps there are before pixels are renumbered. Renumbering costs about one query; with this many
// it is a small part of the work for the events in between, and the set of stamps stays smaller than the
// pixels.
uint64_t stamps_for(uint64_t pixels, uint64_t submission_events) {
  return 1 + pixels + 8 * std::max(pixels, submission_events);
}

class ChainSaePipeline final : public ImagePipeline {
 public:
  static MadePipeline create(vulkan::Device& device, const ChainSaeParameters& parameters, SensorSize sensor,
                             const GpuOptions& options) {
    if (auto r = check_sensor(sensor); !r) return r.error();
    if (auto r = check_options(options); !r) return r.error();
    std::unique_ptr<ChainSaePipeline> p(
        new ChainSaePipeline(device, parameters, sensor, scarf::submission_events(options, device.limits())));
    PipelineBuilder builder(device);
    p->build(builder, parameters.linear);
    if (!builder.result()) return builder.result().error();
    p->bytes_ = builder.bytes();
    auto commands = Commands::create(device, device.compute());
    if (!commands) return commands.error();
    p->renumbering_ = std::move(*commands);
    return std::unique_ptr<ImagePipeline>(std::move(p));
  }

  SensorSize sensor() const override { return sensor_; }
  uint32_t submission_events() const override { return submission_events_; }
  uint64_t memory_bytes() const override { return bytes_; }

  Result<std::unique_ptr<EventBinding>> bind_events(const Buffer& events) override {
    auto binding = std::make_unique<ChainBinding>();
    PipelineBuilder b(device_);
    b.bind(binding->stamp, stamp_, {&events, &stamps_, &shown()});
    if (!b.result()) return b.result().error();
    return std::unique_ptr<EventBinding>(std::move(binding));
  }

  // next_stamp_ stays: it must be larger than all stamps also if this work never gets to the device.
  void record_reset(Commands& commands) override {
    if (event_driven_) {
      commands.fill(cells_, static_cast<uint32_t>(pixels_));
      commands.dispatch(bound_begin_, pixels_, layout::kLinearGroup, push());
    } else {
      commands.fill(stamps_, 0);
    }
    commands.mark("reset");
  }

  // A submission of its own, so that the stamps are known to be renumbered before smaller ones are given out.
  Result<void> prepare_push(uint32_t count) override {
    if (next_stamp_ + count <= most_stamps_) return {};
    if (auto r = renumbering_.begin(); !r) return r;
    record_ranks(renumbering_);
    renumbering_.dispatch(bound_renumber_, pixels_, layout::kLinearGroup, push());
    if (auto r = renumbering_.submit(); !r) return r;
    if (auto r = renumbering_.wait(); !r) return r;
    next_stamp_ = first_stamp();
    return {};
  }

  void record_push(Commands& commands, EventBinding& binding, uint32_t first, uint32_t count,
                   const StreamFacts&) override {
    layout::ChainStampPush events{};
    events.first_event = first;
    events.events = count;
    events.width = static_cast<uint32_t>(sensor_.width);
    events.height = static_cast<uint32_t>(sensor_.height);
    events.stamp = static_cast<uint32_t>(next_stamp_);
    events.cells = event_driven_ ? 1 : 0;
    next_stamp_ += count;
    commands.dispatch(static_cast<const ChainBinding&>(binding).stamp, count, layout::kLinearGroup, events);
    commands.barrier();
    commands.mark("stamp");
  }

  Result<Answer<Image<uint8_t>>> record_u8(Commands& commands, const StreamFacts&,
                                           std::optional<int64_t>) override {
    record_shown(commands);
    tone_.record_u8(commands, tone_shown_, pixels_);
    return image_answer<uint8_t>(tone_.picture(), sensor_);
  }

  Result<Answer<Image<float>>> record_float(Commands& commands, const StreamFacts&,
                                            std::optional<int64_t>) override {
    record_shown(commands);
    tone_.record_float(commands, tone_shown_, pixels_);
    return image_answer<float>(tone_.picture(), sensor_);
  }

  Result<Answer<Image<int64_t>>> record_raw(Commands& commands, const StreamFacts&) override {
    record_shown(commands);
    return Answer<Image<int64_t>>{
        {{&shown(), pixels_ * kWord}}, [sensor = sensor_, pixels = pixels_](HostParts parts) {
          const auto* ranks = static_cast<const uint32_t*>(parts[0]);
          Image<int64_t> raw(sensor.width, sensor.height);
          std::transform(ranks, ranks + pixels, raw.pixels.begin(),
                         [pixels](uint32_t rank) { return rank == pixels ? -1 : int64_t{rank}; });
          return Result<Image<int64_t>>(std::move(raw));
        }};
  }

  Result<Answer<std::vector<uint8_t>>> record_state(Commands& commands, const StreamFacts&) override {
    record_ranks(commands);
    Answer<std::vector<uint8_t>> answer;
    answer.parts.push_back({&ranks_, pixels_ * kWord});
    if (event_driven_) answer.parts.push_back({&cells_, pixels_ * kWord});
    answer.read = [pixels = pixels_](HostParts parts) -> Result<std::vector<uint8_t>> {
      const std::vector<uint32_t> chain = chain_of({static_cast<const uint32_t*>(parts[0]), pixels});
      std::vector<uint8_t> bytes;
      const bool cells = parts.size() > 1;
      if (!cells) append_little_endian(bytes, static_cast<uint32_t>(chain.size()));
      for (const uint32_t pixel : chain) append_little_endian(bytes, pixel);
      if (!cells) return bytes;
      const auto* shown = static_cast<const int32_t*>(parts[1]);
      for (const int32_t rank : std::span(shown, pixels)) append_little_endian(bytes, rank);
      return bytes;
    };
    return answer;
  }

 private:
  ChainSaePipeline(vulkan::Device& device, const ChainSaeParameters& parameters, SensorSize sensor,
                   uint32_t events)
      : device_(device),
        sensor_(sensor),
        submission_events_(events),
        event_driven_(parameters.rule == ChainSaeParameters::Rule::event_driven),
        pixels_(static_cast<uint64_t>(sensor.width) * sensor.height),
        most_stamps_(stamps_for(pixels_, events)),
        next_stamp_(first_stamp()) {}

  // Larger than those of renumbered pixels, and of pixels that never fired but are in the chain.
  uint64_t first_stamp() const { return pixels_ + 1; }

  // Pixels from newest to oldest.
  static std::vector<uint32_t> chain_of(std::span<const uint32_t> ranks) {
    const auto ranked = [&](uint32_t rank) { return rank < ranks.size(); };
    std::vector<uint32_t> chain(std::count_if(ranks.begin(), ranks.end(), ranked));
    for (uint32_t pixel = 0; pixel < ranks.size(); ++pixel) {
      if (ranked(ranks[pixel])) chain[ranks[pixel]] = pixel;
    }
    return chain;
  }

  void build(PipelineBuilder& b, bool linear) {
    const uint64_t words = most_stamps_ / 32 + 1;
    b.buffer(stamps_, "the stamps of the pixels", pixels_ * kWord);
    b.buffer(marks_, "the set of stamps", words * kWord);
    b.buffer(counts_, "the counts of stamps", (words + 1) * kWord);
    b.buffer(ranks_, "the ranks", pixels_ * kWord);
    if (event_driven_) b.buffer(cells_, "the ranks shown", pixels_ * kWord);
    sum_.build(b, words + 1);
    sum_.bind(b, sum_counts_, counts_);
    if (!b.result()) return;  // before the table, which has as many entries as the sensor has pixels
    tone_.build(b, chain_table(static_cast<int64_t>(pixels_), linear), pixels_);
    tone_.bind(b, tone_shown_, shown());
    constexpr size_t kPush = sizeof(layout::ChainPush);
    b.kernel(stamp_, "chain_sae_stamp", shaders::chain_sae_stamp, vulkan::Bindings::vectors_and(2),
             sizeof(layout::ChainStampPush));
    b.kernel(mark_, "chain_sae_mark", shaders::chain_sae_mark, 2, kPush);
    b.kernel(count_, "chain_sae_count", shaders::chain_sae_count, 2, kPush);
    b.kernel(rank_, "chain_sae_rank", shaders::chain_sae_rank, 4, kPush);
    b.kernel(renumber_, "chain_sae_renumber", shaders::chain_sae_renumber, 3, kPush);
    b.bind(bound_mark_, mark_, {&stamps_, &marks_});
    b.bind(bound_count_, count_, {&marks_, &counts_});
    b.bind(bound_rank_, rank_, {&stamps_, &marks_, &counts_, &ranks_});
    b.bind(bound_renumber_, renumber_, {&ranks_, &counts_, &stamps_});
    if (!event_driven_) return;
    b.kernel(begin_, "chain_sae_begin", shaders::chain_sae_begin, 1, kPush);
    b.kernel(show_, "chain_sae_show", shaders::chain_sae_show, 2, kPush);
    b.bind(bound_begin_, begin_, {&stamps_});
    b.bind(bound_show_, show_, {&ranks_, &cells_});
  }

  layout::ChainPush push() const {
    // All stamps so far are smaller than the next one.
    return {static_cast<uint32_t>(pixels_), static_cast<uint32_t>(next_stamp_ / 32 + 1)};
  }

  void record_ranks(Commands& commands) const {
    const layout::ChainPush all = push();
    commands.fill(marks_, all.words * kWord, 0);
    commands.barrier();
    commands.dispatch(bound_mark_, pixels_, layout::kLinearGroup, all);
    commands.barrier();
    commands.mark("mark");
    commands.dispatch(bound_count_, all.words, layout::kLinearGroup, all);
    commands.barrier();
    sum_.record(commands, sum_counts_, all.words + 1);
    commands.mark("count");
    commands.dispatch(bound_rank_, pixels_, layout::kLinearGroup, all);
    commands.barrier();
    commands.mark("rank");
  }

  // The ranks that pictures show: in the rule event_driven a query writes them into the cells.
  const Buffer& shown() const { return event_driven_ ? cells_ : ranks_; }

  void record_shown(Commands& commands) const {
    record_ranks(commands);
    if (!event_driven_) return;
    commands.dispatch(bound_show_, pixels_, layout::kLinearGroup, push());
    commands.barrier();
    commands.mark("show");
  }

  vulkan::Device& device_;
  const SensorSize sensor_;
  const uint32_t submission_events_;
  const bool event_driven_;
  const uint64_t pixels_;
  const uint64_t most_stamps_;
  uint64_t next_stamp_;  // larger than any on the device
  uint64_t bytes_ = 0;
  Buffer stamps_, marks_, counts_, ranks_, cells_;
  PrefixSum sum_;
  PrefixSum::Source sum_counts_;
  Tone tone_;
  Tone::Source tone_shown_;
  Kernel stamp_, mark_, count_, rank_, renumber_, begin_, show_;
  BoundKernel bound_mark_, bound_count_, bound_rank_, bound_renumber_, bound_begin_, bound_show_;
  Commands renumbering_;
};

}  // namespace

MadePipeline make_chain_sae(vulkan::Device& device, const ChainSaeParameters& parameters, SensorSize sensor,
                            const GpuOptions& options) {
  return ChainSaePipeline::create(device, parameters, sensor, options);
}

}  // namespace scarf
