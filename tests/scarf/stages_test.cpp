// Each shader stage against its CPU twin, on the buffers between the stages.
#include "cpu_ref/stages/stages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "core/packed_event.h"
#include "scarf/pipeline.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using vulkan::Buffer;
using vulkan::Commands;
using vulkan::MemoryUse;

class Stages : public test::DeviceTest {
 protected:
  void use(const Geometry& geometry, const GpuOptions& options) {
    geometry_ = geometry;
    vulkan::Device& device = context_->vulkan();
    plan_ = test::value_of(make_plan(geometry, device.limits(), options));
    pipeline_ =
        test::value_of(ScarfPipeline::create(device, geometry, *make_levels(0.3, geometry.capacity), plan_));
    commands_ = test::value_of(Commands::create(device, device.compute()));
    run([&] { pipeline_->record_reset(commands_); });
    ranges_ = patch_ranges(geometry);
    heads_.assign(plan_.patches, 0);
    totals_.assign(plan_.patches, 0);
    slots_.assign(geometry.patches() * geometry.capacity, kEmptySlot);
    counts_.assign(size_t{1} * geometry.x.size * geometry.y.size, 0);
  }

  template <class Record>
  void run(Record record) {
    ASSERT_TRUE(commands_.begin());
    record();
    ASSERT_TRUE(commands_.submit());
    ASSERT_TRUE(commands_.wait());
  }

  template <class T>
  std::vector<T> read(const Buffer& buffer, size_t count) {
    const auto host = Buffer::create(context_->vulkan(), "test", count * sizeof(T), MemoryUse::readback);
    EXPECT_TRUE(host);
    run([&] { commands_.copy(buffer, 0, *host, 0, count * sizeof(T)); });
    const T* words = host->mapped_as<T>();
    return {words, words + count};
  }

  std::vector<uint32_t> read_table(uint32_t chunks) {
    return read<uint32_t>(pipeline_->table(), size_t{chunks} * plan_.patches);
  }

  void compare_batch(const std::vector<Event>& events, int64_t t_first) {
    const auto staging =
        Buffer::create(context_->vulkan(), "test", events.size() * sizeof(Event), MemoryUse::upload);
    ASSERT_TRUE(staging);
    std::memcpy(staging->mapped(), events.data(), events.size() * sizeof(Event));
    const auto binding = pipeline_->bind_events(*staging);
    ASSERT_TRUE(binding);
    const auto& kernels = static_cast<const PushKernels&>(**binding);
    const layout::BatchPush push = pipeline_->batch_push(0, static_cast<uint32_t>(events.size()), t_first);

    std::vector<uint32_t> table(size_t{push.chunks} * push.patches);
    stages::scarf_count(events, ranges_, table, push);
    run([&] { pipeline_->record_count(commands_, kernels, push); });
    ASSERT_EQ(read_table(push.chunks), table) << "count";

    stages::scarf_scan(table, heads_, totals_, {push.patches, push.chunks, push.capacity});
    run([&] { pipeline_->record_scan(commands_, push); });
    ASSERT_EQ(read_table(push.chunks), table) << "scan";
    ASSERT_EQ(read<uint32_t>(pipeline_->heads(), plan_.patches), heads_) << "scan";
    ASSERT_EQ(read<uint64_t>(pipeline_->totals(), plan_.patches), totals_) << "scan";

    if (push.prune != 0) {
      std::vector<uint32_t> alive(table.size());
      stages::scarf_prune(table, alive,
                          {push.patches, push.chunks, push.grid_x, plan_.most_columns, plan_.most_rows});
      run([&] { pipeline_->record_prune(commands_, push); });
      ASSERT_EQ(read<uint32_t>(pipeline_->alive(), alive.size()), alive) << "prune";
      ++pruned_;
    }

    stages::scarf_place(events, ranges_, table, slots_, counts_, push);
    run([&] { pipeline_->record_place(commands_, kernels, push); });
    ASSERT_EQ(read_table(push.chunks), table) << "place";
    ASSERT_EQ(read<uint64_t>(pipeline_->slots(), slots_.size()), slots_) << "place";
    ASSERT_EQ(read<int32_t>(pipeline_->record_counts(commands_, PolarityMode::merged), counts_.size()),
              counts_);
  }

  void compare_images() {
    layout::PatchPush push = pipeline_->patch_push(0, plan_.patches);
    push.slot_end = push.capacity;
    const Levels levels = *make_levels(0.3, geometry_.capacity);
    for (PolarityMode mode : {PolarityMode::separate, PolarityMode::difference, PolarityMode::merged}) {
      std::vector<int32_t> counts = counts_;
      if (mode != PolarityMode::merged) {
        counts.assign((mode == PolarityMode::separate ? 2 : 1) * counts_.size(), 0);
        push.mode = mode == PolarityMode::separate ? layout::kModeSeparate : layout::kModeDifference;
        stages::scarf_render(slots_, totals_, counts, push);
      }
      const Buffer* result = nullptr;
      run([&] { result = &pipeline_->record_counts(commands_, mode); });
      ASSERT_EQ(read<int32_t>(*result, counts.size()), counts) << "render";
      if (mode == PolarityMode::difference) continue;
      std::vector<uint8_t> u8(counts.size());
      stages::scarf_tone<uint8_t>(counts, levels.u8, u8);
      run([&] { result = &pipeline_->record_u8(commands_, mode); });
      ASSERT_EQ(read<uint8_t>(*result, u8.size()), u8) << "tone";
      std::vector<float> f32(counts.size());
      stages::scarf_tone<float>(counts, levels.f32, f32);
      run([&] { result = &pipeline_->record_float(commands_, mode); });
      ASSERT_EQ(read<float>(*result, f32.size()), f32) << "tone";
    }
  }

  void compare_extraction(uint32_t first, uint32_t count, bool active_only, int64_t t_first) {
    auto target = test::value_of(pipeline_->make_extract_target());
    layout::PatchPush push = pipeline_->patch_push(first, count);
    push.mode = active_only ? 1 : 0;
    push.t_first_low = static_cast<uint32_t>(t_first);
    push.t_first_high = static_cast<uint32_t>(t_first >> 32);
    std::vector<uint32_t> cursors(count);
    stages::scarf_extract_count(slots_, totals_, cursors, push);
    const uint32_t total = stages::scarf_extract_scan(cursors);
    std::vector<Event> events(total);
    stages::scarf_extract_write(slots_, totals_, heads_, cursors, events, push);
    run([&] { pipeline_->record_extract(commands_, *target, first, count, active_only, t_first); });
    ASSERT_EQ(*target->total.mapped_as<uint32_t>(), total);
    for (uint32_t i = 0; i < total; ++i) {
      const uint64_t half = pipeline_->half_events();
      const Event& e =
          i < half ? target->first.mapped_as<Event>()[i] : target->second.mapped_as<Event>()[i - half];
      ASSERT_EQ(e, events[i]) << i;
    }
  }

  Geometry geometry_;
  int pruned_ = 0;  // batches
  Plan plan_;
  std::unique_ptr<ScarfPipeline> pipeline_;
  Commands commands_;
  std::vector<uint32_t> ranges_, heads_;
  std::vector<uint64_t> totals_, slots_;
  std::vector<int32_t> counts_;
};

TEST_F(Stages, EqualTheirTwins) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 12; ++trial) {
    const SensorSize sensor = {40 + 9 * trial, 70 - 4 * trial};
    const Geometry geometry = trial < 2 ? *make_geometry(trial == 0 ? Preset::paper : Preset::light, sensor)
                                        : test::random_geometry(sensor, random);
    SCOPED_TRACE(to_string(geometry));
    GpuOptions options;
    options.chunk_events = trial % 2 == 0 ? 0 : 100;
    ASSERT_NO_FATAL_FAILURE(use(geometry, options));
    const test::Spread spread = test::kSpreads[trial % std::size(test::kSpreads)];
    constexpr int64_t kFirst = -123'456'789'012;
    for (uint32_t batch = 0; batch < 3; ++batch) {
      const auto events =
          test::make_stream(spread, sensor, 1 + 1500 * batch, random(), kFirst + batch * 1'000'000);
      ASSERT_NO_FATAL_FAILURE(compare_batch(events, kFirst));
    }
    ASSERT_NO_FATAL_FAILURE(compare_images());
    ASSERT_NO_FATAL_FAILURE(compare_extraction(0, plan_.patches, true, kFirst));
    ASSERT_NO_FATAL_FAILURE(compare_extraction(plan_.patches / 2, 1, false, kFirst));
  }
  EXPECT_GT(pruned_, 3);
  EXPECT_LT(pruned_, 33);
}

}  // namespace
}  // namespace scarf
