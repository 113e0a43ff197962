// Decoding on the device: event for event what the readers of the formats make of the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include "core/batch_check.h"
#include "device/word_feed.h"
#include "io/base/prophesee_header.h"
#include "scarf/core/filter.h"
#include "scarf/device/group.h"
#include "scarf/reference/reference.h"
#include "tests/support/context.h"
#include "tests/support/event_recorder.h"
#include "tests/support/representations.h"
#include "tests/support/streams.h"
#include "tests/support/words.h"

namespace scarf {
namespace {

using test::Bytes;
using test::EventRecorder;
using test::Mixture;
using test::random_words;
using test::Read;
using test::value_of;

constexpr CameraWords kFormats[] = {CameraWords::evt2, CameraWords::evt3};
constexpr SensorSize kSensor = {1280, 720};

class Decoder : public test::DeviceTest {
 protected:
  void feed_to(CameraWords words, SensorSize sensor, const GpuOptions& options) {
    decoder_.reset();
    auto recorder = std::make_unique<EventRecorder>(*context_, sensor, options.submission_events, 400'000);
    recorder_ = recorder.get();
    stream_ = value_of(Stream::create(context_, std::move(recorder), options));
    ASSERT_NE(stream_, nullptr);
    decoder_ = value_of(WordFeed::create(stream_, words));
    ASSERT_NE(decoder_, nullptr);
  }

  // Pushes the bytes in pieces of the given sizes, the last one repeated.
  void push(std::span<const uint8_t> bytes, std::vector<size_t> sizes) {
    for (size_t i = 0; !bytes.empty(); ++i) {
      const size_t n = std::min(bytes.size(), sizes[std::min(i, sizes.size() - 1)]);
      ASSERT_EQ(value_of(decoder_->push(bytes.first(n))), n);
      bytes = bytes.subspan(n);
    }
  }

  void expect(const Read& read) {
    const auto recorded = value_of(recorder_->recorded(*stream_));
    ASSERT_EQ(recorded.events, read.events);
    const ReadReport report = value_of(decoder_->report());
    ASSERT_EQ(report, read.report);
    if (read.events.empty()) return;
    EXPECT_EQ(recorded.facts.first, read.events.front().t);
    EXPECT_EQ(recorded.facts.newest, read.events.back().t);
    const auto later = [](const Event& a, const Event& b) { return a.t < b.t; };
    EXPECT_EQ(recorded.facts.largest, std::max_element(read.events.begin(), read.events.end(), later)->t);
    EXPECT_EQ(recorded.facts.outside, 0u);
  }

  void compare(CameraWords words, const Bytes& bytes, const std::vector<size_t>& sizes,
               SensorSize sensor = kSensor, const GpuOptions& options = {.submission_events = 20'000}) {
    ASSERT_NO_FATAL_FAILURE(feed_to(words, sensor, options));
    ASSERT_NO_FATAL_FAILURE(push(bytes, sizes));
    ASSERT_NO_FATAL_FAILURE(expect(test::read_words(words, bytes, sensor)));
  }

  EventRecorder* recorder_ = nullptr;  // of the stream
  std::shared_ptr<Stream> stream_;
  std::unique_ptr<GpuDecoder> decoder_;
};

TEST_F(Decoder, EqualsTheReaderForWordsOfAllKinds) {
  uint32_t seed = 1;
  for (const CameraWords words : kFormats) {
    uint64_t jumps = 0;
    for (const Mixture mixture : test::kMixtures) {
      for (const size_t count : {31u, 4097u, 13'000u}) {
        SCOPED_TRACE(testing::Message() << "EVT" << (words == CameraWords::evt2 ? 2 : 3) << " mixture "
                                        << static_cast<int>(mixture) << ", " << count << " words");
        const Bytes bytes = random_words(words, mixture, count, ++seed);
        const SensorSize sensor = seed % 3 == 0 ? SensorSize{640, 480} : kSensor;
        ASSERT_NO_FATAL_FAILURE(compare(words, bytes, {bytes.size()}, sensor));
        jumps += test::read_words(words, bytes, sensor).report.jumps;
      }
    }
    EXPECT_GT(jumps, 0u);
  }
}

TEST_F(Decoder, EqualsTheReaderHoweverTheBytesAreCut) {
  test::Random random(2);
  for (const CameraWords words : kFormats) {
    for (const Mixture mixture : test::kMixtures) {
      SCOPED_TRACE(static_cast<int>(mixture));
      const Bytes bytes = random_words(words, mixture, 2500, random());
      std::vector<size_t> sizes(40);
      for (size_t& size : sizes) size = random() % (random() % 2 == 0 ? 7 : 700);
      sizes.push_back(1 + random() % 300);
      GpuOptions options;
      options.submission_events = 1 + random() % 700;
      options.staging_slots = 1 + random() % 4;
      ASSERT_NO_FATAL_FAILURE(compare(words, bytes, sizes, kSensor, options));
    }
  }
}

TEST_F(Decoder, TwoPushesCutAnywhere) {
  for (const CameraWords words : kFormats) {
    const Bytes bytes = random_words(words, Mixture::plausible, words == CameraWords::evt2 ? 4 : 9, 3);
    for (size_t cut = 0; cut <= bytes.size(); ++cut) {
      SCOPED_TRACE(cut);
      ASSERT_NO_FATAL_FAILURE(feed_to(words, kSensor, {.submission_events = 64}));
      const auto all = std::span<const uint8_t>(bytes);
      ASSERT_NO_FATAL_FAILURE(push(all.first(cut), {bytes.size()}));
      ASSERT_NO_FATAL_FAILURE(
          expect(test::read_words(words, Bytes(bytes.begin(), bytes.begin() + cut), kSensor)));
      ASSERT_NO_FATAL_FAILURE(push(all.subspan(cut), {bytes.size()}));
      ASSERT_NO_FATAL_FAILURE(expect(test::read_words(words, bytes, kSensor)));
    }
  }
}

// Twelve events per word: each piece is many pushes of the pipeline.
TEST_F(Decoder, PiecesWithMoreEventsThanAPushTakes) {
  Bytes bytes;
  for (uint32_t i = 0; i < 4000; ++i) {
    const uint32_t word = i == 0 ? 0x8001 : i % 50 == 1 ? 0x3800 + i % 7 : i % 50 == 2 ? i % 700 : 0x4FFF;
    test::append_word(CameraWords::evt3, bytes, word);
  }
  for (const uint32_t events : {1000u, 5000u}) {
    ASSERT_NO_FATAL_FAILURE(
        compare(CameraWords::evt3, bytes, {bytes.size()}, kSensor, {.submission_events = events}));
  }
}

TEST_F(Decoder, NothingBeforeTheFirstTimeHighCounts) {
  for (const CameraWords words : kFormats) {
    Bytes bytes;
    test::Random random(4);
    const int shift = words == CameraWords::evt2 ? 28 : 12;
    for (int i = 0; i < 500; ++i) {
      const uint32_t type = random() % 16;
      if (type != 8) test::append_word(words, bytes, type << shift | 5);
    }
    ASSERT_NO_FATAL_FAILURE(compare(words, bytes, {3}));
    test::append_word(words, bytes, 8u << shift);
    test::append_word(words, bytes, 1u << shift | 9);
    ASSERT_NO_FATAL_FAILURE(compare(words, bytes, {bytes.size() - 5, 1}));
  }
}

class UploadDecoder : public Decoder, public testing::WithParamInterface<DeviceOptions::Upload> {
 protected:
  void SetUp() override { open(test::checked_options(GetParam())); }
};

TEST_P(UploadDecoder, EqualsTheReader) {
  for (const CameraWords words : kFormats) {
    const Bytes bytes = random_words(words, Mixture::plausible, 9000, 5);
    ASSERT_NO_FATAL_FAILURE(compare(words, bytes, {700, 1, 5000}, kSensor, {.submission_events = 1500}));
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, UploadDecoder,
                         testing::Values(DeviceOptions::Upload::automatic, DeviceOptions::Upload::staged,
                                         DeviceOptions::Upload::transfer_queue));

// 2^48 us are 2^14 turns of the EVT2 clock.
Bytes turns(uint32_t count) {
  Bytes bytes;
  for (uint32_t i = 0; i < count; ++i) {
    test::append_word<uint32_t>(bytes, 0x8FFFFFFF);
    test::append_word<uint32_t>(bytes, 0x80000000);
  }
  return bytes;
}

TEST_F(Decoder, TimesOutOfReachRefuseTheirBytesAsAReaderAndAPushDo) {
  ASSERT_NO_FATAL_FAILURE(feed_to(CameraWords::evt2, kSensor, {.submission_events = 50'000}));
  Bytes all;
  const auto add = [&](Bytes bytes) {
    all.insert(all.end(), bytes.begin(), bytes.end());
    return decoder_->push(bytes);
  };
  const auto with_event = [](Bytes bytes, uint32_t x) {
    test::append_word<uint32_t>(bytes, 0x10000000 | x << 11);
    return bytes;
  };
  ASSERT_TRUE(add(with_event(turns(1), 1)));
  const Read first = test::read_words(CameraWords::evt2, all, kSensor);
  // The last turn that is in reach, then one more.
  ASSERT_TRUE(add(with_event(turns(16'383), 2)));
  ASSERT_NO_FATAL_FAILURE(expect(test::read_words(CameraWords::evt2, all, kSensor)));
  const Read within = test::read_words(CameraWords::evt2, all, kSensor);
  ASSERT_EQ(within.events.size(), 2u);
  Bytes beyond = turns(1);
  for (uint32_t x = 3; x < 9; ++x) beyond = with_event(beyond, x);
  const auto refused = add(beyond);
  ASSERT_FALSE(refused);
  Read after = test::read_words(CameraWords::evt2, all, kSensor);
  const auto checked = check_batch(std::span(after.events).subspan(2), kSensor, first.events[0].t);
  ASSERT_FALSE(checked);
  EXPECT_EQ(refused.error().code, ErrorCode::refused_batch);
  EXPECT_EQ(refused.error().message, checked.error().message);
  after.events = within.events;
  ASSERT_NO_FATAL_FAILURE(expect(after));

  // A new stream: what comes next is in reach of itself.
  ASSERT_TRUE(stream_->reset());
  const size_t events_so_far = test::read_words(CameraWords::evt2, all, kSensor).events.size();
  ASSERT_TRUE(add(with_event({}, 77)));
  Read fresh = test::read_words(CameraWords::evt2, all, kSensor);
  fresh.events.erase(fresh.events.begin(), fresh.events.begin() + static_cast<std::ptrdiff_t>(events_so_far));
  ASSERT_NO_FATAL_FAILURE(expect(fresh));
}

TEST_F(Decoder, TimesOutOfReachOfPushedEventsAreRefused) {
  for (const int64_t t : {INT64_MIN, INT64_MAX, (int64_t{1} << 48) + 60, -(int64_t{1} << 48) + 50}) {
    ASSERT_NO_FATAL_FAILURE(feed_to(CameraWords::evt3, kSensor, {.submission_events = 100}));
    const std::vector<Event> pushed = {test::event(t, 3)};
    ASSERT_TRUE(stream_->push(pushed));
    const Bytes bytes = {0x00, 0x80, 0x01, 0x20};  // t 0, x 1
    const auto refused = decoder_->push(bytes);
    const bool in_reach = t == -(int64_t{1} << 48) + 50;
    ASSERT_EQ(refused.ok(), in_reach);
    ASSERT_EQ(value_of(recorder_->recorded(*stream_)).events.size(), in_reach ? 2u : 1u);
    const Bytes later = {0x32, 0x60, 0x01, 0x20};  // t 50
    EXPECT_FALSE(decoder_->push(later));
  }
}

TEST_F(Decoder, WordsAndEventsMayAlternate) {
  test::Random random(6);
  const Bytes bytes = random_words(CameraWords::evt3, Mixture::plausible, 3000, 7);
  ASSERT_NO_FATAL_FAILURE(feed_to(CameraWords::evt3, kSensor, {.submission_events = 333}));
  std::vector<Event> expected;
  Bytes so_far;
  size_t events_read = 0;
  while (so_far.size() < bytes.size()) {
    const size_t n = std::min<size_t>(bytes.size() - so_far.size(), random() % 900);
    const std::span<const uint8_t> some(bytes.data() + so_far.size(), n);
    ASSERT_EQ(value_of(decoder_->push(some)), n);
    so_far.insert(so_far.end(), some.begin(), some.end());
    const Read read = test::read_words(CameraWords::evt3, so_far, kSensor);
    expected.insert(expected.end(), read.events.begin() + static_cast<std::ptrdiff_t>(events_read),
                    read.events.end());
    events_read = read.events.size();
    const auto events = test::make_stream(test::Spread::uniform, kSensor, random() % 500, random());
    if (random() % 2 == 0) {
      ASSERT_TRUE(stream_->push(events));
    } else {
      const auto lent = value_of(stream_->acquire(std::min<size_t>(events.size(), 333)));
      std::copy_n(events.begin(), lent.size(), lent.begin());
      EXPECT_FALSE(decoder_->push(some));  // while memory is lent
      ASSERT_TRUE(stream_->commit(lent.size()));
      expected.insert(expected.end(), events.begin(),
                      events.begin() + static_cast<std::ptrdiff_t>(lent.size()));
      continue;
    }
    expected.insert(expected.end(), events.begin(), events.end());
  }
  ASSERT_EQ(value_of(recorder_->recorded(*stream_)).events, expected);
}

TEST_F(Decoder, AResetEmptiesTheStreamAndNotTheDecoder) {
  for (const CameraWords words : kFormats) {
    const Bytes bytes = random_words(words, Mixture::skips, 3000, 8);
    ASSERT_NO_FATAL_FAILURE(feed_to(words, kSensor, {.submission_events = 400}));
    const size_t half = bytes.size() / 2 + 1;
    const auto all = std::span<const uint8_t>(bytes);
    ASSERT_NO_FATAL_FAILURE(push(all.first(half), {half}));
    ASSERT_TRUE(stream_->reset());
    ASSERT_NO_FATAL_FAILURE(push(all.subspan(half), {100}));
    const size_t before =
        test::read_words(words, Bytes(bytes.begin(), bytes.begin() + half), kSensor).events.size();
    Read read = test::read_words(words, bytes, kSensor);
    read.events.erase(read.events.begin(), read.events.begin() + static_cast<std::ptrdiff_t>(before));
    ASSERT_NO_FATAL_FAILURE(expect(read));
  }
}

TEST_F(Decoder, ThatWouldBlockSaysHowMuchItTook) {
  const Bytes bytes = random_words(CameraWords::evt3, Mixture::plausible, 20'000, 9);
  GpuOptions options;
  options.when_full = GpuOptions::WhenFull::would_block;
  options.submission_events = 500;
  options.staging_slots = 2;
  ASSERT_NO_FATAL_FAILURE(feed_to(CameraWords::evt3, kSensor, options));
  std::span<const uint8_t> rest(bytes);
  size_t blocked = 0;
  while (!rest.empty()) {
    const auto taken = decoder_->push(rest);
    if (taken) {
      rest = rest.subspan(*taken);
      blocked += rest.empty() ? 0 : 1;
      continue;
    }
    ASSERT_EQ(taken.error().code, ErrorCode::would_block);
    ++blocked;
    ASSERT_TRUE(stream_->finish());
  }
  EXPECT_GT(blocked, 0u);
  ASSERT_NO_FATAL_FAILURE(expect(test::read_words(CameraWords::evt3, bytes, kSensor)));
}

TEST_F(Decoder, WordsOfADestroyedDecoderAreInTheStream) {
  const Bytes bytes = random_words(CameraWords::evt2, Mixture::plausible, 900, 10);
  ASSERT_NO_FATAL_FAILURE(feed_to(CameraWords::evt2, kSensor, {.submission_events = 2000}));
  EXPECT_FALSE(WordFeed::create(stream_, CameraWords::evt2));
  ASSERT_NO_FATAL_FAILURE(push(bytes, {bytes.size()}));
  decoder_.reset();
  const Read read = test::read_words(CameraWords::evt2, bytes, kSensor);
  ASSERT_EQ(value_of(recorder_->recorded(*stream_)).events, read.events);
  decoder_ = value_of(WordFeed::create(stream_, CameraWords::evt2));  // another one, from its beginning
  ASSERT_NO_FATAL_FAILURE(push(bytes, {bytes.size()}));
  ASSERT_EQ(value_of(recorder_->recorded(*stream_)).events.size(), 2 * read.events.size());
}

// Every representation takes words.
class RepresentationDecoder : public test::DeviceTest, public testing::WithParamInterface<test::Case> {};

TEST_P(RepresentationDecoder, EqualsReaderAndReference) {
  constexpr SensorSize kSmall = {60, 40};
  Bytes bytes;
  test::Random random(11);
  test::append_word<uint16_t>(bytes, 0x8000);
  for (uint32_t i = 0; i < 3000; ++i) {
    const uint32_t word[] = {random() % 42, 0x2000 | random() % 2 << 11 | random() % 61, 0x6000 | i,
                             0x3000 | random() % 2 << 11 | random() % 60, 0x4000 | (random() & 0x111)};
    test::append_word(CameraWords::evt3, bytes, i % 4096 == 4095 ? 0x8001 : word[random() % 5]);
  }
  const Read read = test::read_words(CameraWords::evt3, bytes, kSmall);
  std::vector<FilterParameters> filters;
  const auto* window = std::get_if<TimeWindowParameters>(&GetParam().parameters);
  for (int behind = 0; behind < 2; ++behind) {
    const auto device = value_of(make_gpu_representation(context_, GetParam().parameters, kSmall,
                                                         {.submission_events = 700}, filters));
    ASSERT_NE(device, nullptr);
    const auto decoder = value_of(make_gpu_decoder(*device, CameraWords::evt3));
    ASSERT_NE(decoder, nullptr);
    auto reference =
        behind_filters(value_of(make_reference_representation(GetParam().parameters, kSmall)), filters);
    ASSERT_TRUE(reference);
    size_t pushed = 0;
    for (const size_t size : {bytes.size() / 3, bytes.size()}) {
      const std::span<const uint8_t> some(bytes.data() + pushed, size - pushed);
      ASSERT_TRUE(decoder->push(some));
      pushed = size;
      ASSERT_TRUE(device->u8_image().wait());
    }
    ASSERT_TRUE((*reference)->push(std::span(read.events).first(0)));
    ASSERT_TRUE((*reference)->push(read.events));
    ASSERT_NO_FATAL_FAILURE(test::expect_same_outputs(*device, **reference));
    EXPECT_EQ(value_of(device->filter_reports()), value_of((*reference)->filter_reports()));
    if (window != nullptr && window->counts) break;  // cannot stand behind filters
    filters = {RefractoryFilter{.period = 50}, SupportFilter{}};
  }
}

std::vector<test::Case> one_of_each() {
  std::vector<test::Case> cases;
  for (const test::Case& c : test::representation_cases()) {
    const bool event_driven_changes = c.label.starts_with("chain_sae_event") || c.label.starts_with("aae");
    if (info_of(c.parameters).exact && !event_driven_changes &&
        (cases.empty() || cases.back().parameters.index() != c.parameters.index() ||
         c.label == "time_window_counts")) {
      cases.push_back(c);
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, RepresentationDecoder, testing::ValuesIn(one_of_each()),
                         [](const auto& test) { return test.param.label; });

TEST_F(Decoder, TakesOnlyRepresentationsOnADevice) {
  class Foreign final : public GpuRepresentation {
   public:
    SensorSize sensor() const override { return kSensor; }
    Result<PushReport> push(std::span<const Event>) override { return PushReport{}; }
    Result<void> reset() override { return {}; }
    Pending<Image<uint8_t>> u8_image(std::optional<int64_t>) override { return Image<uint8_t>(); }
    Pending<Image<float>> float_image(std::optional<int64_t>) override { return Image<float>(); }
    Pending<Image<int64_t>> raw_image() override { return Image<int64_t>(); }
    Pending<std::vector<Event>> events() override { return std::vector<Event>(); }
    Pending<std::vector<uint8_t>> state() override { return std::vector<uint8_t>(); }
    Result<std::span<Event>> acquire(size_t) override { return std::span<Event>(); }
    Result<PushReport> commit(size_t) override { return PushReport{}; }
    size_t max_acquire() const override { return 0; }
    Result<void> flush() override { return {}; }
    Result<void> finish() override { return {}; }
    std::vector<StageTime> stage_times() const override { return {}; }
    uint64_t memory_bytes() const override { return 0; }
  } foreign;
  const auto made = make_gpu_decoder(foreign, CameraWords::evt3);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::illegal_parameter);
}

struct File {
  const char* path;
  CameraWords words;
  SensorSize sensor;
  size_t events;
};

TEST_F(Decoder, RealRecordings) {
  const char* const folder = std::getenv("SCARF_DATA_DIR");
  if (!folder) GTEST_SKIP() << "SCARF_DATA_DIR is not set";
  for (const File& file : {File{"hd_evt3_driving.raw", CameraWords::evt3, {1280, 720}, 219'596},
                           File{"vga_evt2_sparks.raw", CameraWords::evt2, {640, 480}, 521'252}}) {
    std::ifstream in(std::string(folder) + "/raw/" + file.path, std::ios::binary);
    const Bytes whole(std::istreambuf_iterator<char>(in), {});
    ByteReader input = ByteReader::over(whole);
    ASSERT_TRUE(read_prophesee_header(input));
    const Bytes bytes(whole.begin() + static_cast<std::ptrdiff_t>(input.consumed()), whole.end());
    decoder_.reset();
    GpuOptions options;
    options.submission_events = 100'000;
    auto recorder =
        std::make_unique<EventRecorder>(*context_, file.sensor, options.submission_events, 600'000);
    recorder_ = recorder.get();
    stream_ = value_of(Stream::create(context_, std::move(recorder), options));
    decoder_ = value_of(WordFeed::create(stream_, file.words));
    ASSERT_NO_FATAL_FAILURE(push(bytes, {100'001}));
    const Read read = test::read_words(file.words, bytes, file.sensor);
    ASSERT_EQ(read.events.size(), file.events);
    ASSERT_NO_FATAL_FAILURE(expect(read));
  }
}

// Words in one member of a group and events in another: each of them as alone.
TEST_F(Decoder, MembersOfAGroupMayHoldWords) {
  const SensorSize sensor = {120, 90};
  const Bytes bytes = random_words(CameraWords::evt3, Mixture::plausible, 6000, 17);
  const auto events = test::make_stream(test::Spread::uniform, sensor, 3000, 18);
  const auto group = make_gpu_group(context_);
  const auto of_words = value_of(make_gpu_representation(context_, SaeParameters{}, sensor));
  const auto of_events = value_of(make_gpu_representation(context_, SaeParameters{}, sensor));
  const auto decoder = value_of(make_gpu_decoder(*of_words, CameraWords::evt3));
  for (GpuRepresentation* member : {of_words.get(), of_events.get()}) {
    const auto added = group->add(*member);
    ASSERT_TRUE(added) << added.error().message;
  }
  const auto words_reference =
      test::reference(SaeParameters{}, sensor, test::read_words(CameraWords::evt3, bytes, sensor).events);
  const auto events_reference = test::reference(SaeParameters{}, sensor, events);
  const size_t half = bytes.size() / 2 + 1;  // within a word
  ASSERT_EQ(value_of(decoder->push(std::span(bytes).first(half))), half);
  ASSERT_TRUE(of_events->push(std::span(events).first(1000)));
  ASSERT_TRUE(group->flush());
  ASSERT_EQ(value_of(decoder->push(std::span(bytes).subspan(half))), bytes.size() - half);
  ASSERT_TRUE(of_events->push(std::span(events).subspan(1000)));
  const auto images = value_of(group->u8_images());
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0], value_of(words_reference->u8_image()));
  EXPECT_EQ(images[1], value_of(events_reference->u8_image()));
}

}  // namespace
}  // namespace scarf
