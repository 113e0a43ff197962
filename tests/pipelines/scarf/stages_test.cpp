// Each shader stage against its CPU twin, on the buffers between the stages.
#include "cpu_ref/stages/scarf/stages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "layout/packed_event.h"
#include "pipelines/scarf/pipeline.h"
#include "pipelines/scarf/pixel_classes.h"
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
    levels_ = *make_levels(0.3, geometry.capacity);
    plan_ = test::value_of(make_plan(geometry, levels_.u8, device.limits(), options));
    pipeline_ = test::value_of(ScarfPipeline::create(device, geometry, levels_, plan_));
    commands_ = test::value_of(Commands::create(device, device.compute()));
    run([&] { pipeline_->record_reset(commands_); });
    ranges_ = patch_ranges(geometry);
    heads_.assign(plan_.patches, 0);
    laps_.assign(plan_.patches, 0);
    slots_.assign(geometry.patches() * geometry.capacity, kEmptySlot);
    positions_.assign(pipeline_->position_bytes(), layout::kNotShown);
    painted_heads_.assign(plan_.patches, 0);
    picture_.assign(size_t{1} * geometry.x.size * geometry.y.size, 0);
    classes_.clear();
    patch_classes_.clear();
    for (const GridAxis* axis : {&geometry.x, &geometry.y}) {
      const PixelClasses classes = pixel_classes(*axis);
      classes_.insert(classes_.end(), classes.of_pixel.begin(), classes.of_pixel.end());
      patch_classes_.insert(patch_classes_.end(), classes.of_patch.begin(), classes.of_patch.end());
    }
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
    if (plan_.appended(static_cast<uint32_t>(events.size()))) {
      ASSERT_NO_FATAL_FAILURE(compare_appended(events, kernels, t_first));
    } else {
      ASSERT_NO_FATAL_FAILURE(compare_chunked(events, kernels, t_first));
    }
    ASSERT_EQ(read<uint64_t>(pipeline_->slots(), slots_.size()), slots_);
    if (!plan_.paints) return;
    ASSERT_EQ(read<uint8_t>(pipeline_->positions(), positions_.size()), positions_);
    ++painted_;
    // Not after every batch, so that marks of several batches meet.
    if (painted_ % 2 == 0) compare_picture();
  }

  void compare_heads() {
    ASSERT_EQ(read<uint32_t>(pipeline_->heads(), plan_.patches), heads_);
    ASSERT_EQ(read<uint64_t>(pipeline_->laps(), plan_.patches), laps_);
    ASSERT_EQ(read<uint32_t>(pipeline_->painted_heads(), plan_.patches), painted_heads_);
  }

  void compare_appended(const std::vector<Event>& events, const PushKernels& kernels, int64_t t_first) {
    const auto push = pipeline_->append_push(0, static_cast<uint32_t>(events.size()), t_first);
    stages::scarf_append(events, ranges_, heads_, slots_, positions_, push);
    run([&] { pipeline_->record_append(commands_, kernels, push); });
    ASSERT_NO_FATAL_FAILURE(compare_heads()) << "append";
    ++appended_;
    if (appended_ % 3 == 0) {
      stages::scarf_settle(heads_, laps_, painted_heads_);
      run([&] { pipeline_->record_settle(commands_); });
      ASSERT_NO_FATAL_FAILURE(compare_heads()) << "settle";
    }
  }

  void compare_chunked(const std::vector<Event>& events, const PushKernels& kernels, int64_t t_first) {
    const layout::BatchPush push = pipeline_->batch_push(0, static_cast<uint32_t>(events.size()), t_first);

    std::vector<uint32_t> class_counts(size_t{push.chunks} * push.class_words);
    stages::scarf_count(events, classes_, class_counts, push);
    run([&] { pipeline_->record_count(commands_, kernels, push); });
    ASSERT_EQ(read<uint32_t>(pipeline_->class_counts(), class_counts.size()), class_counts) << "count";

    const uint32_t columns = plan_.class_columns;
    const uint32_t rows = plan_.class_rows;
    stages::running_sums(class_counts, {push.chunks, push.class_words, rows, columns, columns, 1});
    stages::running_sums(class_counts, {push.chunks, push.class_words, columns, 1, rows, columns});
    run([&] { pipeline_->record_sum(commands_, push); });
    ASSERT_EQ(read<uint32_t>(pipeline_->class_counts(), class_counts.size()), class_counts) << "sum";

    std::vector<uint32_t> table(size_t{push.chunks} * push.patches);
    stages::scarf_scan(class_counts, patch_classes_, table, heads_, laps_, painted_heads_,
                       {push.patches, push.chunks, push.capacity, push.grid_x, columns, push.class_words});
    run([&] { pipeline_->record_scan(commands_, push); });
    ASSERT_EQ(read_table(push.chunks), table) << "scan";
    ASSERT_NO_FATAL_FAILURE(compare_heads()) << "scan";

    if (push.prune != 0) {
      std::vector<uint32_t> alive(table.size());
      stages::scarf_prune(table, alive,
                          {push.patches, push.chunks, push.grid_x, plan_.most_columns, plan_.most_rows});
      run([&] { pipeline_->record_prune(commands_, push); });
      ASSERT_EQ(read<uint32_t>(pipeline_->alive(), alive.size()), alive) << "prune";
      ++pruned_;
    }

    stages::scarf_place(events, ranges_, table, slots_, positions_, push);
    run([&] { pipeline_->record_place(commands_, kernels, push); });
    ASSERT_EQ(read_table(push.chunks), table) << "place";
  }

  void compare_picture() {
    stages::scarf_paint(positions_, heads_, painted_heads_, picture_, pipeline_->paint_push());
    const Buffer* result = nullptr;
    run([&] { result = &pipeline_->record_u8(commands_, PolarityMode::merged); });
    ASSERT_EQ(read<uint8_t>(*result, picture_.size()), picture_) << "paint";
    ASSERT_NO_FATAL_FAILURE(compare_heads()) << "paint";
  }

  void compare_images() {
    layout::PatchPush push = pipeline_->patch_push(0, plan_.patches);
    push.slot_end = push.capacity;
    for (PolarityMode mode : {PolarityMode::separate, PolarityMode::difference, PolarityMode::merged}) {
      std::vector<int32_t> counts((mode == PolarityMode::separate ? 2 : 1) * picture_.size(), 0);
      push.mode = mode == PolarityMode::separate     ? layout::kModeSeparate
                  : mode == PolarityMode::difference ? layout::kModeDifference
                                                     : layout::kModeMerged;
      stages::scarf_render(slots_, heads_, laps_, counts, push);
      const Buffer* result = nullptr;
      run([&] { result = &pipeline_->record_counts(commands_, mode); });
      ASSERT_EQ(read<int32_t>(*result, counts.size()), counts) << "render";
      if (mode == PolarityMode::difference) continue;
      std::vector<uint8_t> u8(counts.size());
      stages::scarf_tone<uint8_t>(counts, levels_.u8, u8);
      run([&] { result = &pipeline_->record_u8(commands_, mode); });
      ASSERT_EQ(read<uint8_t>(*result, u8.size()), u8) << "tone";
      std::vector<float> f32(counts.size());
      stages::scarf_tone<float>(counts, levels_.f32, f32);
      run([&] { result = &pipeline_->record_float(commands_, mode); });
      ASSERT_EQ(read<float>(*result, f32.size()), f32) << "tone";
    }
  }

  void compare_extraction(uint32_t first, uint32_t count, bool active_only, int64_t t_first) {
    auto target = test::value_of(pipeline_->make_extract_memory());
    layout::PatchPush push = pipeline_->patch_push(first, count);
    push.mode = active_only ? 1 : 0;
    push.t_first_low = static_cast<uint32_t>(t_first);
    push.t_first_high = static_cast<uint32_t>(t_first >> 32);
    std::vector<uint32_t> cursors(count);
    stages::scarf_extract_count(slots_, heads_, laps_, cursors, push);
    const uint32_t total = stages::scarf_extract_scan(cursors);
    std::vector<Event> events(total);
    stages::scarf_extract_write(slots_, heads_, laps_, cursors, events, push);
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
  Levels levels_;
  int pruned_ = 0;  // batches
  int painted_ = 0;
  int appended_ = 0;
  Plan plan_;
  std::unique_ptr<ScarfPipeline> pipeline_;
  Commands commands_;
  std::vector<uint32_t> ranges_, classes_, patch_classes_, heads_, painted_heads_;
  std::vector<uint64_t> laps_, slots_;
  std::vector<uint8_t> positions_, picture_;
};

TEST_F(Stages, EqualTheirTwins) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 18; ++trial) {
    const SensorSize sensor = {40 + 9 * trial, 70 - 3 * trial};
    const Geometry geometry = trial % 12 < 2
                                  ? *make_geometry(trial % 12 == 0 ? Preset::paper : Preset::light, sensor)
                                  : test::random_geometry(sensor, random);
    SCOPED_TRACE(to_string(geometry));
    GpuOptions options;
    options.chunk_events = trial % 2 == 0 ? 0 : 100;
    options.bands = trial % 4;
    options.placing = trial < 12 ? GpuOptions::Placing::chunked : GpuOptions::Placing::appended;
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
  EXPECT_EQ(appended_, 18);
  EXPECT_GT(painted_, 5);
  EXPECT_LT(painted_, 54);
}

}  // namespace
}  // namespace scarf
