#include "tools/frame_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"
#include "tools/window_comparison.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

// A picture with all 256 values.
cv::Mat ramp(int shift) {
  cv::Mat picture(16, 18, CV_8UC1);
  for (int i = 0; i < 16 * 18; ++i) picture.data[i] = static_cast<uint8_t>(i + shift);
  return picture;
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

std::unique_ptr<FrameWriter> make(const std::string& path) {
  auto writer = make_frame_writer(path, *output_kind(path), 30);
  EXPECT_TRUE(writer.ok()) << writer.error().message;
  return *std::move(writer);
}

TEST(OutputKind, IsTakenFromTheName) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("a.folder"));
  EXPECT_EQ(*output_kind("out"), OutputKind::folder);
  EXPECT_EQ(*output_kind("out.d/"), OutputKind::folder);
  EXPECT_EQ(*output_kind(folder.path("a.folder")), OutputKind::folder);
  EXPECT_EQ(*output_kind("a.mp4"), OutputKind::video);
  EXPECT_EQ(*output_kind("a.avi"), OutputKind::video);
  EXPECT_EQ(*output_kind("b/a.png"), OutputKind::image);
  EXPECT_EQ(*output_kind("a.pgm"), OutputKind::image);
  EXPECT_EQ(output_kind("a.jpg").error().code, ErrorCode::illegal_parameter);
}

TEST(FolderWriter, NumbersFramesAndListsThem) {
  const TemporaryFolder folder;
  const auto writer = make(folder.path("a/b"));
  ASSERT_TRUE(writer->write({-7, 100}, ramp(0)).ok());
  ASSERT_TRUE(writer->write({33, 250}, ramp(9)).ok());
  ASSERT_TRUE(writer->finish().ok());
  EXPECT_TRUE(equal(cv::imread(folder.path("a/b/frame_000000.png"), cv::IMREAD_UNCHANGED), ramp(0)));
  EXPECT_TRUE(equal(cv::imread(folder.path("a/b/frame_000001.png"), cv::IMREAD_UNCHANGED), ramp(9)));
  EXPECT_EQ(content_of(folder.path("a/b/frames.csv")), "index,t_us,events\n0,-7,100\n1,33,250\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("a/b")), fs::directory_iterator()), 3);
}

TEST(FolderWriter, ReplacesAnEarlierRenderingAndNothingElse) {
  const TemporaryFolder folder;
  for (const char* name :
       {"frame_000000.png", "frame_000005.png", "frame_1.png", "frame_00000x.png", "notes"}) {
    write_text(folder.path(name), "old");
  }
  const auto writer = make(folder.path(""));
  ASSERT_TRUE(writer->write({0, 0}, ramp(0)).ok());
  EXPECT_FALSE(fs::exists(folder.path("frame_000005.png")));
  EXPECT_TRUE(equal(cv::imread(folder.path("frame_000000.png"), cv::IMREAD_UNCHANGED), ramp(0)));
  for (const char* name : {"frame_1.png", "frame_00000x.png", "notes"}) {
    EXPECT_EQ(content_of(folder.path(name)), "old") << name;
  }
}

TEST(ImageWriter, KeepsEveryValue) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.pgm"}) {
    ASSERT_TRUE(make(folder.path(name))->write({0, 0}, ramp(0)).ok());
    EXPECT_TRUE(equal(cv::imread(folder.path(name), cv::IMREAD_UNCHANGED), ramp(0))) << name;
  }
}

TEST(ImageWriter, AMissingFolderIsAnErrorAtOnce) {
  const TemporaryFolder folder;
  for (const char* name : {"none/a.png", "none/a.mp4"}) {
    const std::string path = folder.path(name);
    const auto writer = make_frame_writer(path, *output_kind(path), 30);
    ASSERT_FALSE(writer.ok());
    EXPECT_EQ(writer.error().code, ErrorCode::io);
  }
}

TEST(VideoWriter, HoldsAllFramesAtItsSpeed) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.avi"}) {
    const std::string path = folder.path(name);
    auto writer = *make_frame_writer(path, OutputKind::video, 25);
    for (int i = 0; i < 7; ++i) ASSERT_TRUE(writer->write({i, 0}, ramp(i)).ok()) << name;
    EXPECT_FALSE(fs::exists(path)) << "an unfinished video must not look like a finished one";
    const auto finished = writer->finish();
    ASSERT_TRUE(finished.ok()) << finished.error().message;
    cv::VideoCapture video(path);
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_COUNT), 7);
    EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 25, 0.01);
  }
}

TEST(VideoWriter, NoFrameIsAnError) {
  const TemporaryFolder folder;
  const auto finished = make(folder.path("a.mp4"))->finish();
  ASSERT_FALSE(finished.ok());
  EXPECT_THAT(finished.error().message, HasSubstr("no frame was due"));
}

TEST(TimeWindow, ShowsTheNewestEventsOnly) {
  TimeWindow window({4, 2}, 10);
  const std::vector<Event> events = {{.t = 9'999, .x = 0, .y = 0, .p = 1},
                                     {.t = 10'000, .x = 1, .y = 0, .p = 0},
                                     {.t = 19'999, .x = 2, .y = 1, .p = 1},
                                     {.t = 5'000, .x = 2, .y = 1, .p = 1}};  // a back-step hides nothing
  window.add(events);
  const cv::Mat picture = window.picture(20'000);
  const cv::Mat expected = (cv::Mat_<uint8_t>(2, 4) << 0, 255, 0, 0, 0, 0, 255, 0);
  EXPECT_TRUE(equal(picture, expected));
}

TEST(TimeWindow, PixelsWithoutEventsStayDarkAtAnyTime) {
  const TimeWindow window({4, 2}, 1'000'000'000);
  EXPECT_EQ(cv::countNonZero(window.picture(0)), 0);
  EXPECT_EQ(cv::countNonZero(window.picture(std::numeric_limits<int64_t>::min())), 0);
}

TEST(SideBySide, KeepsBothPictures) {
  const cv::Mat both = side_by_side(ramp(0), "a", ramp(5), "b");
  const int top = both.rows - 16;
  EXPECT_TRUE(equal(both(cv::Rect(0, top, 18, 16)), ramp(0)));
  EXPECT_TRUE(equal(both(cv::Rect(both.cols - 18, top, 18, 16)), ramp(5)));
}

}  // namespace
}  // namespace scarf::tools
