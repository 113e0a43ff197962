// Calls that make no sense are errors, on every implementation: null contexts, results that are waited for
// twice, and contexts of another process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "scarf/device/decoder.h"
#include "scarf/device/encoder.h"
#include "scarf/device/group.h"
#include "scarf/device/replay.h"
#include "scarf/reference/reference.h"
#include "tests/support/same.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using ::testing::HasSubstr;

constexpr SensorSize kSensor = {40, 30};

template <class T>
void expect_illegal(const Result<T>& result, const std::string& message) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::illegal_parameter);
  EXPECT_THAT(result.error().message, HasSubstr(message));
}

TEST(Misuse, ANullContextIsAnError) {
  const Geometry geometry = test::value_of(make_geometry(Preset::paper, kSensor));
  expect_illegal(make_gpu_scarf(nullptr, geometry), "context is null");
  for (const RepresentationInfo& info : representations()) {
    const Parameters parameters = test::value_of(parse_parameters(info.name, {}));
    expect_illegal(make_gpu_representation(nullptr, parameters, kSensor), "context is null");
  }
  const auto take = [](const auto&) -> Result<void> { return {}; };
  expect_illegal(make_gpu_replay<uint8_t>(nullptr, geometry, take), "context is null");
  expect_illegal(make_gpu_replay<float>(nullptr, geometry, take), "context is null");
  expect_illegal(make_gpu_replay<int32_t>(nullptr, geometry, take), "context is null");
  expect_illegal(behind_filters(nullptr, {}), "representation is null");

  const auto context = test::value_of(GpuContext::create());
  const auto member = test::value_of(make_gpu_scarf(context, geometry));
  const auto group = make_gpu_group(nullptr);
  expect_illegal(group->add(*member), "context is null");
  expect_illegal(group->flush(), "context is null");
  expect_illegal(group->finish(), "context is null");
  expect_illegal(group->u8_images().wait(), "context is null");
  EXPECT_TRUE(group->stage_times().empty());
  EXPECT_EQ(group->memory_bytes(), 0u);
}

// Every query of a representation: its result is handed over once.
template <class T>
void expect_once(Pending<T> pending, const char* what) {
  SCOPED_TRACE(what);
  Pending<T> moved = std::move(pending);
  EXPECT_TRUE(pending.ready());  // NOLINT(bugprone-use-after-move): that it says so is the point
  expect_illegal(pending.wait(), "no result to wait for");
  const auto first = moved.wait();
  EXPECT_TRUE(first || first.error().code == ErrorCode::illegal_parameter) << first.error().message;
  EXPECT_TRUE(moved.ready());
  expect_illegal(moved.wait(), "no result to wait for");
  expect_illegal(moved.wait(), "no result to wait for");
}

void expect_all_once(Representation& r) {
  expect_once(r.u8_image(), "u8_image");
  expect_once(r.float_image(), "float_image");
  expect_once(r.raw_image(), "raw_image");
  expect_once(r.events(), "events");
  expect_once(r.state(), "state");
  expect_once(r.filter_reports(), "filter_reports");
}

TEST(Misuse, AResultIsHandedOverOnce) {
  const auto context = test::value_of(GpuContext::create());
  const auto events = test::make_stream(test::Spread::uniform, kSensor, 500, 1);
  for (const RepresentationInfo& info : representations()) {
    SCOPED_TRACE(info.name);
    const Parameters parameters = test::value_of(parse_parameters(info.name, {}));
    const auto reference = test::value_of(make_reference_representation(parameters, kSensor));
    const auto device = test::value_of(make_gpu_representation(context, parameters, kSensor));
    ASSERT_TRUE(reference->push(events) && device->push(events));
    expect_all_once(*reference);
    expect_all_once(*device);
  }
  const auto scarf =
      test::value_of(make_gpu_scarf(context, test::value_of(make_geometry(Preset::paper, kSensor))));
  expect_once(scarf->snapshot(), "snapshot");
  expect_once(scarf->count_image(), "count_image");
  expect_once(scarf->active_events(), "active_events");
  expect_once(scarf->patch_events(-1, false), "a refused query");
  expect_once(test::value_of(make_gpu_encoder(*scarf, VoxelGridParameters{}))->encode(), "encode");
  const auto group = make_gpu_group(context);
  expect_once(group->u8_images(), "u8_images of no member");
  ASSERT_TRUE(group->add(*scarf));
  expect_once(group->u8_images(), "u8_images");
  expect_once(Pending<int>(5).then<int>([](int v) { return Result<int>(v + 1); }), "then");
  expect_illegal(Pending<int>().wait(), "no result to wait for");
  EXPECT_EQ(test::value_of(Pending<int>(5).then<int>([](int v) { return Result<int>(v + 1); })), 6);
  Pending<int> assigned = Pending<int>(1);
  assigned = Pending<int>(2);
  EXPECT_EQ(test::value_of(std::move(assigned)), 2);
}

// Runs `child` in a forked process; it returns whether all was well. A hang ends by an alarm.
int exit_code_of(const std::function<bool()>& child) {
  const pid_t process = fork();
  if (process == 0) {
    alarm(60);
    _exit(child() ? 0 : 1);
  }
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

template <class T>
bool is_told(const Result<T>& result) {
  if (!result && result.error().code == ErrorCode::device &&
      result.error().message.find("forked") != std::string::npos)
    return true;
  std::fprintf(stderr, "a forked child got: %s\n", result ? "a result" : result.error().message.c_str());
  return false;
}

TEST(Misuse, AForkedChildIsTold) {
  auto context = test::value_of(GpuContext::create());
  const Geometry geometry = test::value_of(make_geometry(Preset::paper, kSensor));
  auto scarf = test::value_of(make_gpu_scarf(context, geometry));
  auto words = test::value_of(make_gpu_representation(context, SaeParameters{}, kSensor));
  auto decoder = test::value_of(make_gpu_decoder(*words, CameraWords::evt3));
  auto encoder = test::value_of(make_gpu_encoder(*scarf, VoxelGridParameters{}));
  auto group = make_gpu_group(context);
  ASSERT_TRUE(group->add(*scarf));
  auto replay = test::value_of(make_gpu_replay<uint8_t>(
      context, geometry, [](const ReplayFrame<uint8_t>&) -> Result<void> { return {}; }));
  const auto events = test::make_stream(test::Spread::uniform, kSensor, 500, 1);
  ASSERT_TRUE(scarf->push(events) && replay->push(events) && replay->frame());
  auto pending = scarf->snapshot();
  auto pictures = group->u8_images();

  EXPECT_EQ(exit_code_of([&] {
              bool told = is_told(scarf->push(events)) && is_told(scarf->acquire(5)) &&
                          is_told(scarf->commit(0)) && is_told(scarf->flush()) && is_told(scarf->finish()) &&
                          is_told(scarf->reset()) && is_told(scarf->u8_image().wait()) &&
                          is_told(scarf->active_events().wait()) && is_told(scarf->state().wait());
              told = told && is_told(group->add(*words)) && is_told(group->flush()) &&
                     is_told(group->finish()) && is_told(group->u8_images().wait());
              const uint8_t bytes[] = {0, 0};
              told = told && is_told(decoder->push(bytes)) && is_told(decoder->report()) &&
                     is_told(decoder->newest()) && is_told(make_gpu_decoder(*scarf, CameraWords::evt2));
              told = told && is_told(encoder->encode().wait()) &&
                     is_told(make_gpu_encoder(*scarf, ToreParameters{}));
              told = told && is_told(replay->push(events)) && is_told(replay->frame()) &&
                     is_told(replay->finish());
              told = told && is_told(make_gpu_scarf(context, geometry)) &&
                     is_told(make_gpu_representation(context, SaeParameters{}, kSensor)) &&
                     is_told(make_gpu_replay<uint8_t>(
                         context, geometry, [](const ReplayFrame<uint8_t>&) -> Result<void> { return {}; }));
              (void)scarf->stage_times();
              (void)scarf->memory_bytes();
              (void)group->stage_times();
              return told && pending.ready() && pictures.ready() && is_told(pending.wait()) &&
                     is_told(pictures.wait());
            }),
            0);
  EXPECT_EQ(exit_code_of([&] {
              pending = {};
              pictures = {};
              decoder.reset();
              encoder.reset();
              replay.reset();
              group.reset();
              scarf.reset();
              words.reset();
              context.reset();
              return true;
            }),
            0);
  EXPECT_EQ(exit_code_of([&] {
              const auto own = GpuContext::create();
              if (!own) return false;
              const auto stream = make_gpu_scarf(*own, geometry);
              return stream && (*stream)->push(events) && (*stream)->u8_image().wait();
            }),
            0);
  // Nothing of that shows here.
  const auto reference = test::value_of(make_reference_scarf(geometry));
  ASSERT_TRUE(reference->push(events));
  EXPECT_EQ(test::value_of(std::move(pending)).slots, test::value_of(reference->snapshot()).slots);
  EXPECT_EQ(test::value_of(std::move(pictures)).at(0), test::value_of(reference->u8_image()));
  test::expect_same(*scarf, *reference);
  EXPECT_TRUE(replay->finish());
}

}  // namespace
}  // namespace scarf
