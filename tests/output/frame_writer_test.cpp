#include "output/frame_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "output/mosaic.h"
#include "output/opencv_picture.h"
#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;
using Json = nlohmann::json;

// A picture with all 256 values.
Image<uint8_t> ramp(int shift) {
  Image<uint8_t> picture(18, 16);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    picture.pixels[i] = static_cast<uint8_t>(static_cast<int>(i) + shift);
  }
  return picture;
}

bool equal(const cv::Mat& a, const PictureView& expected) {
  const cv::Mat b = as_mat(expected);
  return a.type() == b.type() && a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

std::unique_ptr<FrameWriter> make(const std::string& path) {
  auto writer = make_frame_writer(path, *output_kind(path), 30, OutputRule());
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
  {
    const auto writer = make(folder.path("a/b"));
    ASSERT_TRUE(writer->write({-7, 100}, ramp(0)).ok());
    ASSERT_TRUE(writer->write({33, 250}, ramp(9)).ok());
    EXPECT_FALSE(fs::exists(folder.path("a/b"))) << "an unfinished folder must not look like a finished one";
    ASSERT_TRUE(writer->finish().ok());
  }
  EXPECT_TRUE(equal(cv::imread(folder.path("a/b/frame_000000.png"), cv::IMREAD_UNCHANGED), ramp(0)));
  EXPECT_TRUE(equal(cv::imread(folder.path("a/b/frame_000001.png"), cv::IMREAD_UNCHANGED), ramp(9)));
  EXPECT_EQ(content_of(folder.path("a/b/frames.csv")), "index,t_us,events\n0,-7,100\n1,33,250\n");
  const Json list = Json::parse(content_of(folder.path("a/b/.scarf-files")));
  EXPECT_EQ(list["schema"], 1);
  ASSERT_EQ(list["files"].size(), 3u);
  EXPECT_EQ(list["files"][0]["name"], "frame_000000.png");
  EXPECT_EQ(list["files"][0]["bytes"], fs::file_size(folder.path("a/b/frame_000000.png")));
  EXPECT_EQ(list["files"][2]["name"], "frames.csv");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("a/b")), fs::directory_iterator()), 4);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("a")), fs::directory_iterator()), 1);
}

// One frame; the error, or "".
std::string render_one(const std::string& path, int shift, bool overwrite) {
  auto writer = make_frame_writer(path, OutputKind::folder, 30, OutputRule(overwrite));
  if (!writer) return writer.error().message;
  EXPECT_TRUE((*writer)->write({0, 0}, ramp(shift)).ok());
  const auto finished = (*writer)->finish();
  return finished ? "" : finished.error().message;
}

TEST(FolderWriter, ReplacesAnEarlierRenderingAndNothingElse) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("out"));
  write_text(folder.path("out/notes"), "precious");
  write_text(folder.path("out/frame_1.png"), "precious");
  {
    auto writer = make_frame_writer(folder.path("out"), OutputKind::folder, 30, OutputRule());
    ASSERT_TRUE(writer.ok()) << writer.error().message;
    for (int i = 0; i < 3; ++i) ASSERT_TRUE((*writer)->write({i, 0}, ramp(i)).ok());
    ASSERT_TRUE((*writer)->finish().ok());
  }
  EXPECT_THAT(render_one(folder.path("out"), 7, false), HasSubstr("WriteOptions::overwrite"));
  EXPECT_TRUE(fs::exists(folder.path("out/frame_000002.png")));
  EXPECT_EQ(render_one(folder.path("out"), 7, true), "");
  EXPECT_FALSE(fs::exists(folder.path("out/frame_000002.png")));
  EXPECT_TRUE(equal(cv::imread(folder.path("out/frame_000000.png"), cv::IMREAD_UNCHANGED), ramp(7)));
  for (const char* name : {"out/notes", "out/frame_1.png"}) {
    EXPECT_EQ(content_of(folder.path(name)), "precious") << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("out")), fs::directory_iterator()), 5);
}

TEST(FolderWriter, PicturesOfOthersAreInTheWay) {
  const TemporaryFolder folder;
  for (const char* name : {"frame_000005.png", "frame_00000000.png", "frames.csv", ".scarf-files"}) {
    const std::string out = folder.path("out");
    fs::create_directory(out);
    write_text(out + "/" + name, "precious");
    EXPECT_THAT(render_one(out, 0, true), HasSubstr(name));
    EXPECT_EQ(content_of(out + "/" + name), "precious");
    EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 1) << name;
    fs::remove_all(out);
  }
  EXPECT_THAT(render_one("/", 0, true), HasSubstr("root"));
}

TEST(FolderWriter, PicturesThatWereChangedBelongToWhoChangedThem) {
  const TemporaryFolder folder;
  const std::string picture = folder.path("out/frame_000000.png");
  for (const bool same_size : {false, true}) {
    ASSERT_EQ(render_one(folder.path("out"), 0, false), "");
    std::string content = content_of(picture);
    same_size ? void(content.back() ^= 1) : content.push_back('x');
    write_text(picture, content);
    EXPECT_THAT(render_one(folder.path("out"), 0, true), HasSubstr("frame_000000.png was changed"));
    EXPECT_EQ(content_of(picture), content);
    fs::remove_all(folder.path("out"));
  }
}

// A list that someone else has made cannot make scarf remove what it should not.
TEST(FolderWriter, AListNamesFilesOfItsFolderOnly) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("out"));
  write_text(folder.path("victim"), "precious");
  const std::string list = R"({"schema": 1, "files": [{"name": "../victim", "bytes": 8}]})";
  write_text(folder.path("out/.scarf-files"), list);
  EXPECT_THAT(render_one(folder.path("out"), 0, true), HasSubstr(".scarf-files"));
  EXPECT_EQ(content_of(folder.path("victim")), "precious");
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
    const auto writer = make_frame_writer(path, *output_kind(path), 30, OutputRule());
    ASSERT_FALSE(writer.ok());
    EXPECT_EQ(writer.error().code, ErrorCode::io);
  }
}

TEST(VideoWriter, HoldsAllFramesAtItsSpeed) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.avi"}) {
    const std::string path = folder.path(name);
    auto writer = *make_frame_writer(path, OutputKind::video, 25, OutputRule());
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

TEST(Mosaic, KeepsThePictures) {
  const Image<uint8_t> image = mosaic({{"a", ramp(0)}, {"b", ramp(5)}});
  const cv::Mat both = as_mat(image);
  const int top = both.rows - 16;
  EXPECT_TRUE(equal(both(cv::Rect(0, top, 18, 16)), ramp(0)));
  EXPECT_TRUE(equal(both(cv::Rect(both.cols - 18, top, 18, 16)), ramp(5)));
}

TEST(Mosaic, IsAsSquareAsItsTilesAllow) {
  const Image<uint8_t> one = mosaic({{"a", ramp(0)}});
  const Image<uint8_t> five = mosaic(std::vector<Tile>(5, {"a", ramp(0)}));  // 3 + 2
  EXPECT_EQ(five.width, 3 * one.width + 2 * 8);
  EXPECT_EQ(five.height, 2 * one.height + 8);
  const Image<uint8_t> nine = mosaic(std::vector<Tile>(9, {"a", ramp(0)}));
  EXPECT_EQ(nine.width, five.width);
  EXPECT_EQ(nine.height, 3 * one.height + 2 * 8);
}

}  // namespace
}  // namespace scarf::tools
