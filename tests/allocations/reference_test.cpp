// Every allocation of the references is made to fail: a push stores all or nothing, or the reference says
// that it is incomplete.
#include "scarf/reference/reference.h"

#include <gtest/gtest.h>

#include <map>

#include "scarf/core/encoding.h"
#include "tests/allocations/followed.h"
#include "tests/support/streams.h"

namespace scarf {
namespace {

using test::FailingNew;
using test::Followed;
using test::ours;

constexpr SensorSize kSensor = {32, 24};

std::vector<Event> some_events(uint64_t part, size_t count) {
  return test::make_stream(test::Spread::uniform, kSensor, count, part, static_cast<int64_t>(part) * 10'000);
}

class ReferenceLack : public testing::TestWithParam<test::Case> {
 protected:
  Result<std::unique_ptr<Representation>> make(std::span<const FilterParameters> filters) const {
    auto made = make_reference_representation(GetParam().parameters, kSensor);
    if (!made) return made;
    return behind_filters(*std::move(made), filters);
  }

  void run(std::span<const FilterParameters> filters) {
    test::fail_each_allocation(
        [&] {
          const auto made = ours([&] { return make(filters); });
          if (!made) return test::expect_lack(made.error());
          const auto reference = test::value_of(make(filters));
          Followed followed(**made, *reference, true);
          followed.push(some_events(1, 150));
          followed.ask_for_all();
          followed.push(some_events(2, 600));
          followed.ask([](Representation& r) { return r.u8_image(); });
          followed.reset();
          followed.push(some_events(3, 400));
          followed.ask_for_all();
          followed.finish(some_events(4, 300));
        },
        100);
  }
};

TEST_P(ReferenceLack, OfEachAllocationLosesNothingSilently) {
  run({});
}

TEST_P(ReferenceLack, BehindFiltersLosesNothingSilently) {
  const FilterParameters filters[] = {SupportFilter{.range = 1, .period = 400},
                                      RefractoryFilter{.period = 25}};
  run(filters);
}

INSTANTIATE_TEST_SUITE_P(Representations, ReferenceLack, testing::ValuesIn(test::representation_cases()),
                         [](const auto& instance) { return instance.param.label; });

TEST(ReferenceLack, OfFiltersAlone) {
  for (const FilterParameters& parameters :
       {FilterParameters(SupportFilter{.range = 1, .period = 400}), FilterParameters(RefractoryFilter{})}) {
    test::fail_each_allocation([&] {
      auto made = ours([&] { return make_reference_filter(parameters, kSensor); });
      if (!made) return test::expect_lack(made.error());
      const auto other = test::value_of(make_reference_filter(parameters, kSensor));
      std::vector<Event> passing;
      std::vector<Event> expected;
      for (uint64_t part = 1; part < 5; ++part) {
        const auto events = some_events(part, 200);
        const auto passed = ours([&] { return (*made)->filter(events, passing); });
        if (!passed) {
          test::expect_lack(passed.error());
          continue;  // nothing of it was seen
        }
        EXPECT_EQ(*passed, test::value_of(other->filter(events, expected)));
        EXPECT_EQ((*made)->report(), other->report());
      }
      EXPECT_EQ(passing, expected);
    });
  }
}

TEST(ReferenceLack, OfEncodingsIsAnError) {
  const auto events = some_events(1, 500);
  for (const EncodingInfo& info : encodings()) {
    SCOPED_TRACE(info.name);
    test::fail_each_allocation([&] {
      const auto parameters = ours([&] { return parse_encoding(info.name); });
      if (!parameters) return test::expect_lack(parameters.error());
      const auto tensor = ours([&] { return encode(*parameters, kSensor, events); });
      if (!tensor) return test::expect_lack(tensor.error());
      EXPECT_TRUE(*tensor == test::value_of(encode(*parameters, kSensor, events)));
    });
  }
}

TEST(ReferenceLack, OfParametersAndGeometriesIsAnError) {
  const std::string sae = "sae";
  const std::map<std::string, std::string> legal = {{"tau", "20ms"}};
  const std::map<std::string, std::string> illegal = {{"tau", "0"}};
  const std::string support = "support:range=2";
  const std::string far_support = "support:range=9";
  const std::string tore = "tore:k=5";
  // With memory the result is as it is said; without, an error.
  const auto expect = [](const auto& result, bool good) {
    if (!FailingNew::failed() || result) {
      EXPECT_EQ(result.ok(), good);
    } else {
      EXPECT_FALSE(result.error().message.empty());
    }
  };
  test::fail_each_allocation(
      [&] {
        expect(ours([&] { return parse_parameters(sae, legal); }), true);
        expect(ours([&] { return parse_parameters(sae, illegal); }), false);
        expect(ours([&] { return checked_parameters(SaeParameters{.tau = 0}); }), false);
        expect(ours([&] { return parse_filter(support); }), true);
        expect(ours([&] { return parse_filter(far_support); }), false);
        expect(ours([&] { return parse_encoding(tore); }), true);
        expect(ours([&] { return make_geometry(Preset::paper, kSensor); }), true);
        expect(ours([&] { return make_geometry(Preset::paper, {0, 5}); }), false);
        expect(ours([&] { return preset_from_name("no such preset"); }), false);
        expect(ours([&] { return make_levels(0.1, 50); }), true);
        expect(ours([&] { return make_levels(-1, 50); }), false);
      },
      300);
}

}  // namespace
}  // namespace scarf
