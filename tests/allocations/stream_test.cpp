// Every allocation of a stream on a device is made to fail: no exception, no hang, no event lost or doubled
// without a word.
#include <gtest/gtest.h>

#include <algorithm>

#include "scarf/core/encoding.h"
#include "scarf/device/encoder.h"
#include "tests/allocations/followed.h"
#include "tests/allocations/quiet_device.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::Followed;
using test::ours;
using Upload = DeviceOptions::Upload;

constexpr SensorSize kSensor = {32, 24};
constexpr uint32_t kSubmission = 400;

std::vector<Event> some_events(uint64_t part, size_t count) {
  return test::make_stream(test::Spread::uniform, kSensor, count, part, static_cast<int64_t>(part) * 10'000);
}

struct Used {
  std::string label;
  Parameters parameters;
  Upload upload = Upload::automatic;
  std::vector<FilterParameters> filters = {};

  friend void PrintTo(const Used& used, std::ostream* out) { *out << used.label; }
};

std::vector<Used> all_used() {
  const std::vector<std::string> labels = {
      "scarf_paper", "time_window", "time_window_counts",     "sae",     "eros_k3",
      "sits_k3",     "chain_sae",   "chain_sae_event_driven", "aed_sae", "aae",
      "aae_keep"};
  std::vector<Used> all;
  for (const test::Case& c : test::representation_cases()) {
    if (std::count(labels.begin(), labels.end(), c.label) != 0) all.push_back({c.label, c.parameters});
  }
  all.push_back({"scarf_by_transfer_queue", ScarfParameters{}, Upload::transfer_queue});
  all.push_back({"scarf_staged", ScarfParameters{}, Upload::staged});
  all.push_back({"sae_behind_filters",
                 SaeParameters{},
                 Upload::automatic,
                 {SupportFilter{.range = 1, .period = 400}, RefractoryFilter{.period = 25}}});
  return all;
}

class StreamLack : public testing::TestWithParam<Used> {
 protected:
  std::unique_ptr<Representation> reference() const {
    return test::value_of(behind_filters(
        test::value_of(make_reference_representation(GetParam().parameters, kSensor)), GetParam().filters));
  }
};

TEST_P(StreamLack, OfEachAllocationLosesNothingSilently) {
  const Used& used = GetParam();
  const auto context = test::value_of(test::quiet_context(used.upload));
  ASSERT_NE(context, nullptr);
  const bool exact = info_of(used.parameters).exact;
  test::fail_each_allocation([&] {
    auto device = test::value_of(make_gpu_representation(context, used.parameters, kSensor,
                                                         {.submission_events = kSubmission}, used.filters));
    auto reference = this->reference();
    Followed followed(*device, *reference, exact);
    followed.push(some_events(1, 150));
    followed.ask_for_all();
    followed.push(some_events(2, 1500));  // several submissions
    followed.ask([](Representation& r) { return r.u8_image(); }, exact);
    const auto placed = some_events(3, 120);
    const auto place = ours([&] { return device->acquire(placed.size()); });
    followed.done(place ? Result<void>() : Result<void>(place.error()));
    if (place) {
      std::copy(placed.begin(), placed.end(), place->begin());
      followed.took(ours([&] { return device->commit(placed.size()); }), placed);
    }
    followed.done(ours([&] { return device->flush(); }));
    followed.push(some_events(4, 399));
    followed.done(ours([&] { return device->finish(); }));
    test::ours_may_throw([&] { return device->stage_times().size() + device->memory_bytes(); });
    followed.ask_both([](Representation& r) { return r.u8_image(); },
                      [](Representation& r) { return r.raw_image(); }, exact);
    followed.reset();
    followed.push(some_events(5, 700));
    followed.ask_for_all();
    followed.finish(some_events(6, 500));
  });
}

INSTANTIATE_TEST_SUITE_P(Representations, StreamLack, testing::ValuesIn(all_used()),
                         [](const auto& instance) { return instance.param.label; });

TEST(CreationLack, OfEachAllocationIsAnError) {
  for (const Used& used : all_used()) {
    SCOPED_TRACE(used.label);
    test::fail_each_allocation(
        [&] {
          const auto context = ours([&] { return test::quiet_context(used.upload); });
          if (!context) return test::expect_lack(context.error());
          const auto device = ours([&] {
            return make_gpu_representation(*context, used.parameters, kSensor, {.submission_events = 400},
                                           used.filters);
          });
          if (!device) return test::expect_lack(device.error());
          ASSERT_TRUE((*device)->push(some_events(1, 100)));
          ASSERT_TRUE((*device)->u8_image().wait());
        },
        6);
  }
}

TEST(ScarfLack, OfEachAllocationOfItsOwnQueriesAndOfEncoders) {
  const auto context = test::value_of(test::quiet_context());
  const auto geometry = test::value_of(make_geometry(Preset::paper, kSensor));
  test::fail_each_allocation([&] {
    auto device = test::value_of(
        make_gpu_scarf(context, geometry, kDefaultAccumulation, {.submission_events = kSubmission}));
    auto reference = test::value_of(make_reference_scarf(geometry));
    Followed followed(*device, *reference, true);
    const auto ask = [&](auto query) {
      followed.ask([&](Representation& r) { return query(dynamic_cast<Scarf&>(r)); });
    };
    followed.push(some_events(1, 700));
    ask([](Scarf& s) { return s.count_image(PolarityMode::separate); });
    ask([](Scarf& s) { return s.u8_planes(PolarityMode::separate); });
    ask([](Scarf& s) { return s.active_events(EventOrder::by_time); });
    ask([](Scarf& s) { return s.patch_events(2, /*active_only=*/false); });
    ask([](Scarf& s) {
      return std::move(s.snapshot()).then<std::vector<uint64_t>>([](const Snapshot& snapshot) {
        return Result<std::vector<uint64_t>>(snapshot.totals);
      });
    });
    for (const EncodingParameters& parameters :
         {EncodingParameters(VoxelGridParameters{}), EncodingParameters(ToreParameters{}),
          EncodingParameters(TimeSurfaceParameters{.tau = 100})}) {
      const auto encoder = ours([&] { return make_gpu_encoder(*device, parameters); });
      if (!encoder) {
        followed.done(encoder.error());
        continue;
      }
      const auto tensor = ours([&] { return (*encoder)->encode().wait(); });
      if (!tensor)
        followed.done(tensor.error());
      else
        EXPECT_TRUE(*tensor ==
                    test::value_of(encode(parameters, kSensor, test::value_of(reference->events()))));
    }
    followed.finish(some_events(2, 500));
  });
}

}  // namespace
}  // namespace scarf
