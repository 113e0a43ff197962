// Every allocation of a decoder of camera words is made to fail.
#include "scarf/device/decoder.h"

#include <gtest/gtest.h>

#include <map>

#include "scarf/reference/reference.h"
#include "tests/allocations/followed.h"
#include "tests/allocations/quiet_device.h"
#include "tests/support/words.h"

namespace scarf {
namespace {

using test::ours;

constexpr SensorSize kSensor = {640, 480};
const test::Bytes kWords = test::random_words(CameraWords::evt3, test::Mixture::plausible, 700, 1);

const std::vector<uint8_t>& state_after(size_t bytes) {
  static std::map<size_t, std::vector<uint8_t>> known;
  if (const auto found = known.find(bytes); found != known.end()) return found->second;
  const test::Bytes words(kWords.begin(), kWords.begin() + static_cast<ptrdiff_t>(bytes));
  auto reference = test::value_of(make_reference_representation(SaeParameters{}, kSensor));
  EXPECT_TRUE(reference->push(test::read_words(CameraWords::evt3, words, kSensor).events));
  return known[bytes] = test::value_of(reference->state());
}

TEST(DecoderLack, OfEachAllocationLosesNothingSilently) {
  const auto context = test::value_of(test::quiet_context());
  test::fail_each_allocation([&] {
    auto sae = test::value_of(
        make_gpu_representation(context, SaeParameters{}, kSensor, {.submission_events = 200}));
    auto made = ours([&] { return make_gpu_decoder(*sae, CameraWords::evt3); });
    if (!made) {
      test::expect_lack(made.error());
      made = make_gpu_decoder(*sae, CameraWords::evt3);
      ASSERT_TRUE(made) << made.error().message;
    }
    auto decoder = *std::move(made);
    const auto all = std::span<const uint8_t>(kWords);
    size_t taken = 0;
    bool broken = false;
    const auto note = [&](const auto& result) {
      if (!result && !broken) test::expect_lack(result.error());
      EXPECT_FALSE(result && broken) << "a broken stream went on";
      if (!result && !broken) broken = !sae->state().wait();
    };
    for (const size_t end : {size_t{301}, size_t{500}, size_t{502}, all.size()}) {
      const auto pushed = ours([&] { return decoder->push(all.subspan(taken, end - taken)); });
      note(pushed);
      if (!pushed) break;  // a broken stream, or bytes that were not taken
      taken += *pushed;
      ASSERT_EQ(taken, end);
      note(ours([&] { return sae->flush(); }));
      const auto state = ours([&] { return sae->state().wait(); });
      note(state);
      if (state) {
        EXPECT_TRUE(*state == state_after(taken));
      }
    }
    note(ours([&] { return decoder->newest(); }));
    const auto report = ours([&] { return decoder->report(); });
    note(report);
    if (broken) {
      ASSERT_TRUE(sae->reset());
      // The decoder does not know where it stands, and says so. Another one begins anew.
      EXPECT_FALSE(decoder->push(all));
      EXPECT_FALSE(decoder->report());
      decoder.reset();
      decoder = test::value_of(make_gpu_decoder(*sae, CameraWords::evt3));
      taken = 0;
    }
    ASSERT_EQ(test::value_of(decoder->push(all.subspan(taken))), all.size() - taken);
    EXPECT_EQ(test::value_of(decoder->report()), test::read_words(CameraWords::evt3, kWords, kSensor).report);
    EXPECT_TRUE(test::value_of(sae->state()) == state_after(all.size()));
  });
}

TEST(DecoderLack, InItsDestructorBreaksTheStream) {
  const auto context = test::value_of(test::quiet_context());
  test::fail_each_allocation([&] {
    auto sae = test::value_of(
        make_gpu_representation(context, SaeParameters{}, kSensor, {.submission_events = 200}));
    auto decoder = test::value_of(make_gpu_decoder(*sae, CameraWords::evt3));
    ASSERT_TRUE(decoder->push(kWords));
    test::ours_may_throw([&] { decoder.reset(); });
    const auto state = sae->state().wait();
    if (state) {
      EXPECT_TRUE(*state == state_after(kWords.size()));
    } else {
      test::expect_lack(state.error());
    }
  });
}

}  // namespace
}  // namespace scarf
