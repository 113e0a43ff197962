// Streams that are submitted together: the same bits as alone, in one submission; threads; members that
// leave.
#include "device/group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

#include "scarf/device/group.h"
#include "scarf/reference/reference.h"
#include "tests/support/context.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"
#include "vulkan/device.h"

namespace scarf {
namespace {

using test::make_stream;
using test::Spread;
using test::value_of;
using Upload = DeviceOptions::Upload;

// A representation, its reference, and the events that both get.
template <class Device, class Reference>
struct Pair {
  std::unique_ptr<Device> device;
  std::unique_ptr<Reference> reference;
  std::vector<Event> events;
  size_t done = 0;

  void push(size_t count) {
    const auto batch = std::span(events).subspan(done, std::min(count, events.size() - done));
    const PushReport a = value_of(device->push(batch));
    const PushReport b = value_of(reference->push(batch));
    ASSERT_EQ(a.accepted, b.accepted);
    ASSERT_EQ(a.outside, b.outside);
    done += batch.size();
  }
};
using Member = Pair<GpuScarf, Scarf>;

void expect_same_images(const std::vector<Image<uint8_t>>& images, std::span<const Member> members) {
  ASSERT_EQ(images.size(), members.size());
  for (size_t i = 0; i < images.size(); ++i) {
    ASSERT_EQ(images[i], value_of(members[i].reference->u8_image())) << "member " << i;
  }
}

class Group : public test::DeviceTest {
 protected:
  void SetUp() override {
    test::DeviceTest::SetUp();
    group_ = make_gpu_group(context_);
  }
  void TearDown() override {
    group_.reset();
    test::DeviceTest::TearDown();
  }

  Member make_member(const Geometry& geometry, std::vector<Event> events, const GpuOptions& options = {}) {
    Member member = {device_scarf(geometry, options), reference_scarf(geometry), std::move(events)};
    const auto added = group_->add(*member.device);
    EXPECT_TRUE(added) << added.error().message;
    return member;
  }

  std::unique_ptr<GpuGroup> group_;
};

class UploadGroup : public Group, public testing::WithParamInterface<Upload> {
 protected:
  void SetUp() override {
    open(test::checked_options(GetParam()));
    group_ = make_gpu_group(context_);
  }
};

// Anything that may be done with a group and its members, in any order.
TEST_P(UploadGroup, MixedGeometriesAndCallsNeverChangeAByte) {
  std::mt19937 random(31);
  std::vector<Member> members;
  for (size_t i = 0; i < 6; ++i) {
    const SensorSize sensor = {16 + static_cast<int32_t>(random() % 100),
                               16 + static_cast<int32_t>(random() % 60)};
    const Geometry geometry = i < 2 ? *make_geometry(i == 0 ? Preset::paper : Preset::light, sensor)
                                    : test::random_geometry(sensor, random);
    GpuOptions options;
    options.submission_events = i % 2 == 0 ? 0 : 700;  // some slots are full before anyone flushes
    options.staging_slots = 1 + static_cast<uint32_t>(i % 3);
    const Spread spread = test::kSpreads[i % std::size(test::kSpreads)];
    members.push_back(make_member(geometry, make_stream(spread, sensor, 6000, i), options));
  }
  for (int step = 0; step < 250; ++step) {
    Member& member = members[random() % members.size()];
    SCOPED_TRACE(step);
    switch (random() % 10) {
      case 0:
        ASSERT_TRUE(group_->flush());
        break;
      case 1:
        ASSERT_NO_FATAL_FAILURE(expect_same_images(value_of(group_->u8_images()), members));
        break;
      case 2:
        ASSERT_TRUE(member.device->flush());
        break;
      case 3:
        ASSERT_NO_FATAL_FAILURE(test::expect_same_state(*member.device, *member.reference));
        break;
      case 4:
        ASSERT_TRUE(group_->finish());
        break;
      case 5: {  // the group submits what was pushed before, and leaves lent memory alone
        const auto memory = value_of(member.device->acquire(50));
        ASSERT_EQ(memory.size(), 50u);
        ASSERT_TRUE(group_->flush());
        const size_t n = std::min<size_t>(50, member.events.size() - member.done);
        const auto batch = std::span(member.events).subspan(member.done, n);
        std::copy(batch.begin(), batch.end(), memory.begin());
        ASSERT_TRUE(member.device->commit(n));
        ASSERT_TRUE(member.reference->push(batch));
        member.done += n;
        break;
      }
      case 6:
        if (random() % 4 == 0) {
          ASSERT_TRUE(member.device->reset() && member.reference->reset());
        }
        break;
      default:
        ASSERT_NO_FATAL_FAILURE(member.push(random() % 900));
    }
  }
  ASSERT_NO_FATAL_FAILURE(expect_same_images(value_of(group_->u8_images()), members));
  for (Member& member : members) {
    ASSERT_NO_FATAL_FAILURE(test::expect_same(*member.device, *member.reference));
  }
}

std::string upload_name(const testing::TestParamInfo<Upload>& upload) {
  constexpr const char* kNames[] = {"Automatic", "Staged", "TransferQueue"};
  return kNames[static_cast<size_t>(upload.param)];
}
INSTANTIATE_TEST_SUITE_P(Paths, UploadGroup,
                         testing::Values(Upload::automatic, Upload::staged, Upload::transfer_queue),
                         upload_name);

TEST_F(Group, TakesEveryRepresentationAndFilters) {
  const SensorSize sensor = {41, 33};
  const auto events = make_stream(Spread::moving_edge, sensor, 3000, 5);
  const std::vector<FilterParameters> filters = {SupportFilter{.range = 1, .period = 3000}};
  std::vector<Pair<GpuRepresentation, Representation>> members;
  for (const char* name : {"time_window", "sae", "eros", "sits", "chain_sae", "aae", "scarf"}) {
    for (const bool filtered : {false, true}) {
      const std::span<const FilterParameters> in_front(filters.data(), filtered ? 1 : 0);
      const Parameters parameters = *parse_parameters(name);
      members.push_back(
          {value_of(
               make_gpu_representation(context_, parameters, sensor, {.submission_events = 800}, in_front)),
           value_of(behind_filters(value_of(make_reference_representation(parameters, sensor)), in_front)),
           events});
      ASSERT_TRUE(group_->add(*members.back().device));
    }
  }
  std::mt19937 random(32);
  while (members.back().done < events.size()) {
    for (auto& member : members) ASSERT_NO_FATAL_FAILURE(member.push(1 + random() % 400));
    if (random() % 2 == 0) {
      ASSERT_TRUE(group_->flush());
      continue;
    }
    const auto images = value_of(group_->u8_images());
    ASSERT_EQ(images.size(), members.size());
    for (size_t i = 0; i < images.size(); ++i) {
      ASSERT_EQ(images[i], value_of(members[i].reference->u8_image())) << "member " << i;
    }
  }
  for (auto& member : members) {
    ASSERT_EQ(value_of(member.device->state()), value_of(member.reference->state()));
  }
}

TEST_F(Group, ThreadsPushWhileAnotherFlushes) {
  const Geometry geometry = *make_geometry(Preset::paper, {60, 50});
  std::vector<Member> members;
  for (uint64_t i = 0; i < 4; ++i)
    members.push_back(
        make_member(geometry, make_stream(Spread::uniform, {60, 50}, 8000, i), {.submission_events = 1000}));
  // A second group with the same members, in the other order.
  const auto other = make_gpu_group(context_);
  for (size_t i = members.size(); i > 0; --i) ASSERT_TRUE(other->add(*members[i - 1].device));
  std::vector<std::thread> threads;
  for (Member& member : members) {
    threads.emplace_back([&member] {
      while (member.done < member.events.size()) ASSERT_NO_FATAL_FAILURE(member.push(333));
    });
  }
  for (GpuGroup* group : {group_.get(), other.get()}) {
    threads.emplace_back([group] {
      for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(group->flush());
        ASSERT_EQ(value_of(group->u8_images()).size(), 4u);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (Member& member : members)
    ASSERT_NO_FATAL_FAILURE(test::expect_same(*member.device, *member.reference));
}

TEST_F(Group, ImagesOutliveGroupAndMembersAndMayBeDropped) {
  const Geometry geometry = *make_geometry(Preset::paper, {60, 50});
  std::vector<Member> members;
  for (uint64_t i = 0; i < 3; ++i) {
    members.push_back(make_member(geometry, make_stream(Spread::uniform, {60, 50}, 2000, i)));
    ASSERT_NO_FATAL_FAILURE(members[i].push(2000));
  }
  for (int i = 0; i < 40; ++i) (void)group_->u8_images();
  auto images = group_->u8_images();
  EXPECT_GT(group_->memory_bytes(), 0u);
  group_.reset();
  for (Member& member : members) member.device.reset();
  expect_same_images(value_of(std::move(images)), members);
}

TEST_F(Group, MembersLeaveWhenTheyAreDestroyed) {
  EXPECT_TRUE(group_->flush());
  EXPECT_TRUE(value_of(group_->u8_images()).empty());
  const Geometry geometry = *make_geometry(Preset::light, {60, 50});
  std::vector<Member> members;
  for (uint64_t i = 0; i < 3; ++i) {
    members.push_back(make_member(geometry, make_stream(Spread::uniform, {60, 50}, 500, i)));
    ASSERT_NO_FATAL_FAILURE(members[i].push(500));
  }
  members.erase(members.begin() + 1);
  expect_same_images(value_of(group_->u8_images()), members);
}

TEST_F(Group, RefusesStrangersAndMembers) {
  const Geometry geometry = *make_geometry(Preset::light, {60, 50});
  const Member member = make_member(geometry, {});
  const auto twice = group_->add(*member.device);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, ErrorCode::illegal_parameter);
  const auto context = value_of(test::create_context());
  const auto stranger = value_of(make_gpu_scarf(context, geometry));
  const auto refused = group_->add(*stranger);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("context"), std::string::npos) << refused.error().message;
}

// What reaches the driver.
struct Calls {
  static inline int submissions = 0;
  static inline int barriers = 0;
  static inline PFN_vkQueueSubmit2 submit = nullptr;
  static inline PFN_vkCmdPipelineBarrier2 barrier = nullptr;

  static void install(vulkan::Table& table) {
    if (table.QueueSubmit2 == nullptr) return;
    submit = std::exchange(table.QueueSubmit2, [](auto... arguments) {
      ++submissions;
      return submit(arguments...);
    });
    barrier = std::exchange(table.CmdPipelineBarrier2, [](auto... arguments) {
      ++barriers;
      barrier(arguments...);
    });
  }
};

TEST(GroupCalls, SubmissionsAndBarriersDoNotGrowWithMembers) {
  const Geometry geometry = *make_geometry(Preset::paper, {60, 50});
  const auto events = make_stream(Spread::uniform, {60, 50}, 1000, 7);
  for (const Upload upload : {Upload::automatic, Upload::transfer_queue}) {
    DeviceOptions options;
    options.upload = upload;
    options.cache_folder = "-";
    const auto context = value_of(test::create_context(options, Calls::install));
    int barriers_of_one = 0;
    for (const size_t count : {size_t{1}, size_t{7}}) {
      const auto group = make_gpu_group(context);
      std::vector<std::unique_ptr<GpuScarf>> members;
      for (size_t i = 0; i < count; ++i) {
        members.push_back(value_of(make_gpu_scarf(context, geometry)));
        ASSERT_TRUE(group->add(*members.back()));
        ASSERT_TRUE(members.back()->push(events));
      }
      Calls::submissions = Calls::barriers = 0;
      ASSERT_TRUE(group->flush());
      EXPECT_EQ(Calls::submissions, upload == Upload::automatic ? 1 : 2);
      const auto images = group->u8_images();
      EXPECT_EQ(Calls::submissions, upload == Upload::automatic ? 2 : 3);
      ASSERT_TRUE(group->finish());
      EXPECT_EQ(Calls::submissions, upload == Upload::automatic ? 2 : 3);
      if (count == 1) barriers_of_one = Calls::barriers;
      EXPECT_EQ(Calls::barriers, barriers_of_one);
    }
  }
}

// A pipeline without room for any event.
class FullPipeline final : public Pipeline {
 public:
  SensorSize sensor() const override { return {60, 50}; }
  uint32_t submission_events() const override { return 100; }
  Result<std::unique_ptr<EventBinding>> bind_events(const vulkan::Buffer&) override {
    return std::make_unique<EventBinding>();
  }
  void record_reset(vulkan::Commands&) override {}
  Result<void> prepare_push(uint32_t) override { return Error{ErrorCode::out_of_memory, "full"}; }
  void record_push(vulkan::Commands&, EventBinding&, uint32_t, uint32_t, const StreamFacts&) override {
    ADD_FAILURE();
  }
  uint64_t memory_bytes() const override { return 0; }
};

struct FullMember final : StreamFed {
  explicit FullMember(std::shared_ptr<Stream> s) : fed(std::move(s)) {}
  std::shared_ptr<Stream> stream() const override { return fed; }
  U8Picture u8_picture() const override { return {}; }
  std::shared_ptr<Stream> fed;
};

TEST_F(Group, AMemberThatCannotTakePartDoesNotHoldUpOthers) {
  const FullMember full(value_of(Stream::create(context_, std::make_unique<FullPipeline>(), {})));
  const auto scarf = device_scarf(*make_geometry(Preset::light, {60, 50}));
  const auto group = std::make_shared<StreamGroup>(context_);
  ASSERT_TRUE(group->add(full));
  ASSERT_TRUE(group->add(dynamic_cast<const StreamFed&>(*scarf)));
  const auto events = make_stream(Spread::uniform, {60, 50}, 50, 9);
  ASSERT_TRUE(full.fed->push(events) && scarf->push(events));
  for (int i = 0; i < 2; ++i) {  // the events stay, so there is no room for them again
    const auto flushed = group->flush();
    ASSERT_FALSE(flushed);
    EXPECT_EQ(flushed.error().message, "full");
  }
  const auto image = group->u8_images(std::nullopt).wait();
  ASSERT_FALSE(image);
  ASSERT_TRUE(scarf->finish());
  const auto times = group->stage_times();
  const bool timed = context_->vulkan().limits().timestamp_period > 0;
  EXPECT_EQ(times.empty(), !timed);  // the other member's events were submitted by the group
}

TEST_F(Group, StagesAreTimed) {
  Member member =
      make_member(*make_geometry(Preset::paper, {60, 50}), make_stream(Spread::uniform, {60, 50}, 1000, 8));
  ASSERT_NO_FATAL_FAILURE(member.push(1000));
  value_of(group_->u8_images());
  std::vector<std::string> stages;
  for (const StageTime& time : group_->stage_times()) stages.push_back(time.stage);
  // Appended, or cut into chunks.
  const bool appended = std::find(stages.begin(), stages.end(), "append") != stages.end();
  for (const char* stage : {appended ? "append" : "place", "copy"}) {
    EXPECT_TRUE(std::find(stages.begin(), stages.end(), stage) != stages.end()) << stage;
  }
}

}  // namespace
}  // namespace scarf
