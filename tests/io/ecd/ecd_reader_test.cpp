// Recordings of the Event-Camera Dataset, in folders and zip archives, and their frames.
#include <gmock/gmock.h>

#include "scarf/io/frames.h"
#include "tests/io/io_test_helpers.h"
#include "tests/support/archive_bytes.h"

namespace scarf {
namespace {

using test::png_file;
using test::zip_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Bytes kEvents = bytes_of("0.5 1 2 1\n0.75 3 0 0\n");
const std::vector<Event> kTwo = {{500'000, 1, 2, 1}, {750'000, 3, 0, 0}};
const Bytes kPixels = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 255};
const Bytes kImage = png_file(4, 3, kPixels);

// Reads the one frame of a recording; its time and pixels, or the error.
struct Frames {
  std::vector<int64_t> times;
  std::vector<Bytes> pixels;
  std::string error;
};

Frames read_frames(const std::string& path) {
  Frames frames;
  auto source = open_frames(path);
  if (!source) return {{}, {}, source.error().message};
  for (;;) {
    const auto frame = (*source)->read();
    if (!frame) frames.error = frame.error().message;
    if (!frame || !*frame) return frames;
    EXPECT_EQ((*frame)->exposure_begin, (*frame)->t);
    EXPECT_EQ((*frame)->exposure_end, (*frame)->t);
    frames.times.push_back((*frame)->t);
    frames.pixels.emplace_back((*frame)->image.pixels.begin(), (*frame)->image.pixels.end());
  }
}

bool reads_png(const Frames& frames) {
  return frames.error.find("no libpng") == std::string::npos;
}

TEST(EcdReader, AFolderHasEventsAndFrames) {
  const TemporaryFolder folder;
  folder.add("events.txt", kEvents);
  folder.add("images.txt", bytes_of("0.6 images/a.png\n\n0.8 images/b.png\n"));
  folder.add("images/a.png", kImage);
  folder.add("images/b.png", png_file(4, 3, Bytes(12, 7)));
  const auto r = read_path(folder.path());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "ecd");
  EXPECT_EQ(r.sensor, (SensorSize{4, 3}));
  EXPECT_EQ(r.events, kTwo);
  const Frames frames = read_frames(folder.path());
  if (!reads_png(frames)) GTEST_SKIP() << frames.error;
  EXPECT_EQ(frames.error, "");
  EXPECT_THAT(frames.times, ElementsAre(600'000, 800'000));
  EXPECT_THAT(frames.pixels, ElementsAre(kPixels, Bytes(12, 7)));
}

TEST(EcdReader, AFolderWithoutImagesHasNoSizeAndNoFrames) {
  const TemporaryFolder folder;
  folder.add("events.txt", kEvents);
  const auto r = read_path(folder.path());
  EXPECT_EQ(r.sensor, std::nullopt);
  EXPECT_EQ(r.events, kTwo);
  EXPECT_THAT(read_frames(folder.path()).error, HasSubstr("no images.txt"));
}

TEST(EcdReader, BrokenFramesAreNamed) {
  const TemporaryFolder folder;
  folder.add("events.txt", kEvents);
  folder.add("images.txt", bytes_of("0.6 ../outside.png\n"));
  EXPECT_THAT(read_frames(folder.path()).error, HasSubstr("outside the recording"));
  folder.add("images.txt", bytes_of("0.6 /outside.png\n"));
  EXPECT_THAT(read_frames(folder.path()).error, HasSubstr("outside the recording"));
  folder.add("images.txt", bytes_of("0.6 missing.png\n"));
  EXPECT_THAT(read_frames(folder.path()).error, HasSubstr("missing.png"));
  folder.add("images.txt", bytes_of("0.6 a.png\nlater b.png\n"));
  folder.add("a.png", kImage);
  const Frames frames = read_frames(folder.path());
  if (!reads_png(frames)) GTEST_SKIP() << frames.error;
  EXPECT_EQ(frames.times.size(), 1u);
  EXPECT_THAT(frames.error, HasSubstr("line 2"));
  for (size_t length = 0; length < kImage.size() - 12; ++length) {
    folder.add("a.png", Bytes(kImage.begin(), kImage.begin() + static_cast<ptrdiff_t>(length)));
    EXPECT_THAT(read_frames(folder.path()).error, HasSubstr("a.png")) << length;
  }
  Bytes huge = kImage;
  huge[16] = 0x7F;
  folder.add("a.png", huge);
  EXPECT_THAT(read_frames(folder.path()).error, HasSubstr("a.png"));
  EXPECT_THAT(read_path(folder.path()).error, HasSubstr("a.png"));
  ReadOptions options;
  options.sensor = SensorSize{4, 3};
  EXPECT_EQ(read_path(folder.path(), options).events, kTwo);
}

class EcdZip : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto missing = missing_library("npz"); !missing.empty()) GTEST_SKIP() << missing;
  }
};

TEST_F(EcdZip, HasEventsAndFramesInAFolderOfItsOwn) {
  const TemporaryFile file(zip_file({{"__MACOSX/shapes/._events.txt", bytes_of("litter")},
                                     {"shapes/calib.txt", bytes_of("200 200 120 90 0 0 0 0 0\n")},
                                     {"shapes/events.txt", kEvents},
                                     {"shapes/images.txt", bytes_of("0.6 images/a.png\n")},
                                     {"shapes/images/a.png", kImage}}));
  const auto r = read_path(file.path());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "ecd");
  EXPECT_EQ(r.sensor, (SensorSize{4, 3}));
  EXPECT_EQ(r.events, kTwo);
  const Frames frames = read_frames(file.path());
  if (!reads_png(frames)) GTEST_SKIP() << frames.error;
  EXPECT_THAT(frames.times, ElementsAre(600'000));
  EXPECT_THAT(frames.pixels, ElementsAre(kPixels));
}

TEST_F(EcdZip, OfE2VidHasOneTextFile) {
  const TemporaryFile file(zip_file({{"boxes.txt", bytes_of("4 3\n0.5 1 2 1\n0.75 3 0 0\n")}}));
  const auto r = read_path(file.path());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.format, "ecd");
  EXPECT_EQ(r.sensor, (SensorSize{4, 3}));
  EXPECT_EQ(r.events, kTwo);
}

TEST_F(EcdZip, WithSeveralRecordingsIsRefused) {
  const TemporaryFile two(zip_file({{"a/events.txt", kEvents}, {"b/events.txt", kEvents}}));
  EXPECT_THAT(read_path(two.path()).error, HasSubstr("2 recordings"));
  const TemporaryFile none(zip_file({{"a.png", kImage}}));
  EXPECT_THAT(read_path(none.path()).error, HasSubstr("0 text files"));
  EXPECT_THAT(read_all(zip_file({{"events.txt", kEvents}})).error, HasSubstr("pipe"));
}

TEST_F(EcdZip, CutAnywhereIsAnError) {
  const Bytes zip = zip_file({{"events.txt", kEvents}, {"images.txt", bytes_of("")}});
  for (size_t length = 4; length < zip.size(); ++length) {
    const TemporaryFile file(Bytes(zip.begin(), zip.begin() + static_cast<ptrdiff_t>(length)));
    EXPECT_NE(read_path(file.path()).error, "") << length;
  }
}

}  // namespace
}  // namespace scarf
