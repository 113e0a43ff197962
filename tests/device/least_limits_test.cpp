// Devices that promise no more than Vulkan does take every representation of a sensor of 640x480 pixels.
#include <gtest/gtest.h>

#include "pipelines/scarf/plan.h"
#include "tests/support/context.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::value_of;

constexpr SensorSize kSensor = {640, 480};

class LeastLimits : public test::DeviceTest {
 protected:
  void SetUp() override {
    test::Pose pose = test::pose_of_environment();
    pose.least_limits = true;
    open(test::checked_options(), pose);
  }
};

TEST_F(LeastLimits, EveryRepresentationOf640x480) {
  const Parameters all[] = {ScarfParameters{Preset::paper, {}},
                            ScarfParameters{Preset::light, {}},
                            TimeWindowParameters{},
                            TimeWindowParameters{.counts = true},
                            SaeParameters{},
                            ErosParameters{},
                            TosParameters{},
                            SitsParameters{},
                            ChainSaeParameters{},
                            ChainSaeParameters{.rule = ChainSaeParameters::Rule::event_driven},
                            AedSaeParameters{},
                            AaeParameters{},
                            AaeParameters{.esvo2 = true}};
  const auto events = test::make_stream(test::Spread::moving_edge, kSensor, 3000, 1);
  for (const Parameters& parameters : all) {
    SCOPED_TRACE(info_of(parameters).name);
    const auto device = value_of(make_gpu_representation(context_, parameters, kSensor));
    const auto reference = value_of(make_reference_representation(parameters, kSensor));
    ASSERT_TRUE(device->push(events));
    ASSERT_TRUE(reference->push(events));
    if (info_of(parameters).exact)
      ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*device, *reference));
    else
      ASSERT_EQ(value_of(device->u8_image()).pixels.size(), value_of(reference->u8_image()).pixels.size());
  }
}

TEST_F(LeastLimits, TablesAreNotSmaller) {
  const auto plan_of = [](const test::Pose& pose) {
    const auto device = value_of(test::create_device(test::checked_options(), {}, pose));
    const Geometry geometry = *make_geometry(Preset::paper, {1280, 720});
    return value_of(make_plan(geometry, make_levels(0.3, geometry.capacity)->u8, device->limits(), {}));
  };
  for (const bool discrete : {false, true}) {
    const Plan least = plan_of({.discrete = discrete, .least_limits = true});
    const Plan own = plan_of({.discrete = discrete});
    EXPECT_EQ(least.max_chunks, own.max_chunks);
    EXPECT_EQ(least.submission_events, own.submission_events);
  }
}

}  // namespace
}  // namespace scarf
