// Each stage of decoding against its CPU twin, on the buffers between the stages.
#include <gtest/gtest.h>

#include <cstring>

#include "core/ceil_div.h"
#include "cpu_ref/stages/decode/decode.h"
#include "kernels/pipeline.h"
#include "kernels/word_decoder.h"
#include "tests/support/context.h"
#include "tests/support/words.h"

namespace scarf {
namespace {

using layout::DecodeCarry;
using layout::DecodeFacts;
using layout::DecodeState;
using layout::DecodeSummary;
using Pass = WordDecoder::Pass;

constexpr uint32_t kMostWords = 3 * layout::kDecodeBlock;

class DecodeStages : public test::DeviceTest, public testing::WithParamInterface<CameraWords> {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    PipelineBuilder builder(context_->vulkan());
    decoder_.build(builder, GetParam(), {1280, 720}, kMostWords, kMostWords);
    decoder_.make_piece(builder, piece_);
    ASSERT_TRUE(builder.result()) << builder.result().error().message;
    run([&](vulkan::Commands& c) { decoder_.record_reset(c); });
  }

  void run(const std::function<void(vulkan::Commands&)>& record) {
    ASSERT_TRUE(run_alone(context_->vulkan(), record));
  }

  template <class T>
  std::vector<T> read(const vulkan::Buffer& buffer, size_t count) {
    const auto copy = test::value_of(
        vulkan::Buffer::create(context_->vulkan(), "copy", count * sizeof(T), vulkan::MemoryUse::readback));
    run([&](vulkan::Commands& c) { c.copy(buffer, 0, copy, 0, count * sizeof(T)); });
    return {copy.mapped_as<T>(), copy.mapped_as<T>() + count};
  }

  template <class T>
  void expect_same(const vulkan::Buffer& buffer, const std::vector<T>& twin, const char* stage) {
    const std::vector<T> device = read<T>(buffer, twin.size());
    for (size_t i = 0; i < twin.size(); ++i) {
      ASSERT_EQ(std::memcmp(&device[i], &twin[i], sizeof(T)), 0) << stage << " " << i;
    }
  }

  // Runs one submission stage by stage; the state goes on from the one before.
  void compare(const test::Bytes& bytes) {
    const uint32_t word_bytes = WordDecoder::word_bytes(GetParam());
    std::vector<uint32_t> words(bytes.size() / word_bytes);
    for (size_t i = 0; i < words.size(); ++i)
      std::memcpy(&words[i], bytes.data() + i * word_bytes, word_bytes);
    std::memcpy(piece_.words.host.mapped(), bytes.data(), bytes.size());
    if (piece_.words.device.size() != 0) {
      run([&](vulkan::Commands& c) { c.copy(piece_.words.host, 0, piece_.words.device, 0, bytes.size()); });
    }
    const auto count = static_cast<uint32_t>(words.size());
    const uint32_t blocks = ceil_div(count, layout::kDecodeBlock);
    const bool evt2 = GetParam() == CameraWords::evt2;
    const uint32_t format = evt2 ? layout::kDecodeEvt2 : layout::kDecodeEvt3;
    stages::DecodeInput input{format, words, {count, blocks, 1280, 720, 0, kMostWords}};
    const auto pass = [&](Pass p) {
      run([&](vulkan::Commands& c) { decoder_.record_pass(c, piece_, count, p); });
    };
    const size_t lanes = size_t{blocks} * layout::kDecodeGroup;
    std::vector<uint32_t> lane_skips(lanes), block_skips(blocks), lane_places(lanes), block_places(blocks);
    std::vector<DecodeSummary> lane_summaries(lanes), block_summaries(blocks);
    std::vector<DecodeState> block_states(blocks);
    std::vector<DecodeFacts> block_facts(blocks);
    if (evt2) {
      stages::decode_skip(input, lane_skips, block_skips);
      pass(Pass::skip);
      ASSERT_NO_FATAL_FAILURE(expect_same(piece_.lane_skips, lane_skips, "skip"));
      ASSERT_NO_FATAL_FAILURE(expect_same(piece_.block_skips, block_skips, "skip"));
      stages::decode_skip_scan(block_skips, carry_);
      pass(Pass::skip_scan);
      ASSERT_NO_FATAL_FAILURE(expect_same(piece_.block_skips, block_skips, "skip scan"));
    }
    stages::decode_fold(input, lane_skips, block_skips, lane_summaries, block_summaries);
    pass(Pass::fold);
    ASSERT_NO_FATAL_FAILURE(expect_same(piece_.lane_summaries, lane_summaries, "fold"));
    ASSERT_NO_FATAL_FAILURE(expect_same(piece_.block_summaries, block_summaries, "fold"));
    stages::decode_scan(format, block_summaries, block_states, carry_);
    pass(Pass::scan);
    ASSERT_NO_FATAL_FAILURE(expect_same(piece_.block_states, block_states, "scan"));
    ASSERT_NO_FATAL_FAILURE(expect_same(decoder_.carry(), std::vector<DecodeCarry>{carry_}, "scan"));
    stages::decode_count(input, block_skips, block_states, lane_places, block_facts);
    pass(Pass::count);
    ASSERT_NO_FATAL_FAILURE(expect_same(piece_.block_facts, block_facts, "count"));
    ASSERT_NO_FATAL_FAILURE(expect_same(piece_.lane_places, lane_places, "count"));
    layout::DecodeResult result{};
    stages::decode_total(block_facts, block_places, result, carry_);
    pass(Pass::total);
    ASSERT_EQ(std::memcmp(&piece_.read_result(), &result, sizeof(result)), 0) << "total";
    ASSERT_NO_FATAL_FAILURE(expect_same(piece_.block_places, block_places, "total"));
    // The events in two parts.
    const uint32_t found = std::min(result.facts.inside, kMostWords);
    for (const uint32_t first : {0u, found / 3}) {
      input.push.first_event = first;
      input.push.events = first == 0 ? found / 3 : found - found / 3;
      std::vector<Event> events(input.push.events);
      stages::decode_write(input, block_skips, block_states, events);
      run([&](vulkan::Commands& c) { decoder_.record_write(c, piece_, count, first, input.push.events); });
      ASSERT_NO_FATAL_FAILURE(expect_same(decoder_.events(), events, "write"));
    }
  }

  WordDecoder decoder_;
  WordDecoder::Piece piece_;
  DecodeCarry carry_{};
};

TEST_P(DecodeStages, EqualTheirTwins) {
  uint32_t seed = 1;
  for (const test::Mixture mixture : test::kMixtures) {
    for (const size_t count : {1u, 100u, 4096u, 12'000u}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(mixture) << ", " << count << " words");
      ASSERT_NO_FATAL_FAILURE(compare(test::random_words(GetParam(), mixture, count, ++seed)));
    }
  }
  EXPECT_GT(carry_.state.loops_low, 100u);
}

INSTANTIATE_TEST_SUITE_P(Formats, DecodeStages, testing::Values(CameraWords::evt2, CameraWords::evt3),
                         [](const auto& test) { return test.param == CameraWords::evt2 ? "evt2" : "evt3"; });

}  // namespace
}  // namespace scarf
