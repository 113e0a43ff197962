// Every allocation of a group is made to fail: no member loses anything silently.
#include "scarf/device/group.h"

#include <gtest/gtest.h>

#include "tests/allocations/followed.h"
#include "tests/allocations/quiet_device.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::Followed;
using test::ours;

constexpr SensorSize kSensor = {32, 24};

std::vector<Event> some_events(uint64_t part, size_t count) {
  return test::make_stream(test::Spread::uniform, kSensor, count, part, static_cast<int64_t>(part) * 10'000);
}

class GroupLack : public testing::TestWithParam<DeviceOptions::Upload> {};

TEST_P(GroupLack, OfEachAllocationLosesNothingSilently) {
  const auto context = test::value_of(test::quiet_context(GetParam()));
  const Parameters members[] = {SaeParameters{}, ScarfParameters{},
                                ChainSaeParameters{.rule = ChainSaeParameters::Rule::event_driven}};
  test::fail_each_allocation([&] {
    std::vector<std::unique_ptr<GpuRepresentation>> devices;
    std::vector<std::unique_ptr<Representation>> references;
    std::vector<Followed> followed;
    for (const Parameters& parameters : members) {
      devices.push_back(
          test::value_of(make_gpu_representation(context, parameters, kSensor, {.submission_events = 400})));
      references.push_back(test::value_of(make_reference_representation(parameters, kSensor)));
      followed.emplace_back(*devices.back(), *references.back(), true);
    }
    const auto group = make_gpu_group(context);
    size_t added = 0;
    for (auto& device : devices) {
      const auto joined = ours([&] { return group->add(*device); });
      if (!joined) break;  // those before it are members
      ++added;
    }
    for (uint64_t turn = 0; turn < 3; ++turn) {
      for (size_t i = 0; i < devices.size(); ++i)
        followed[i].push(some_events(turn * 5 + i, 150 + 200 * turn));
      const auto submitted = ours([&] { return turn == 0 ? group->flush() : group->finish(); });
      for (Followed& f : followed) f.done(submitted);
      const auto images = ours([&] { return group->u8_images().wait(); });
      if (images) {
        ASSERT_EQ(images->size(), added);
      }
      for (size_t i = 0; i < added; ++i) {
        // The pictures were asked for, with one answer for all.
        followed[i].answered(images ? Result<Image<uint8_t>>((*images)[i]) : images.error(),
                             [](Representation& r) { return r.u8_image(); });
      }
    }
    test::ours_may_throw([&] { return group->stage_times().size() + group->memory_bytes(); });
    for (Followed& f : followed) f.finish(some_events(40, 300));
    ASSERT_TRUE(group->u8_images().wait());
  });
}

INSTANTIATE_TEST_SUITE_P(Uploads, GroupLack,
                         testing::Values(DeviceOptions::Upload::automatic,
                                         DeviceOptions::Upload::transfer_queue));

}  // namespace
}  // namespace scarf
