// scarf frames: the pictures and times of a recording's frames; of the Event-Camera Dataset, made by hand.
#include <opencv2/core.hpp>

#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(Program, FramesOfARecording) {
  fs::create_directories(path("ecd/images"));
  write_text(path("ecd/events.txt"), "0.000100000 1 2 1\n0.000300000 3 4 0\n");
  write_text(path("ecd/images.txt"), "0.000200000 images/a.png\n0.025000000 images/b.png\n");
  const cv::Mat first(kSensor.height, kSensor.width, CV_8UC1, cv::Scalar(7));
  cv::Mat second = first.clone();
  second.at<uchar>(40, 60) = 200;
  cv::imwrite(path("ecd/images/a.png"), first);
  cv::imwrite(path("ecd/images/b.png"), second);

  EXPECT_EQ(run("frames " + path("ecd") + " -o " + path("pictures")).exit_code, 0);
  EXPECT_EQ(content_of(path("pictures/frames.csv")),
            "index,t_us,exposure_begin_us,exposure_end_us\n0,200,200,200\n1,25000,25000,25000\n");
  expect_picture(path("pictures/frame_000000.png"), first);
  expect_picture(path("pictures/frame_000001.png"), second);

  fs::remove(path("ecd/images/b.png"));
  EXPECT_EQ(run("frames " + path("ecd") + " -o " + path("pictures")).exit_code, 2);
  const Outcome broken = run("frames " + path("ecd") + " --overwrite -o " + path("pictures"));
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.err, HasSubstr("images/b.png"));
  EXPECT_EQ(content_of(path("pictures/frames.csv")),
            "index,t_us,exposure_begin_us,exposure_end_us\n0,200,200,200\n");
  EXPECT_FALSE(fs::exists(path("pictures/frame_000001.png"))) << "of the earlier run";
}

// A packet of AEDAT 3.1 with one frame, which says that it has so many columns and rows.
std::string frame_packet(int32_t width, int32_t height) {
  std::string bytes("\2\0\0\0", 4);
  const auto put = [&bytes](int32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xFF);
  };
  constexpr int32_t kPixels = 4;
  for (const int32_t word : {36 + 2 * kPixels, 4, 0, 1, 1, 1}) put(word);  // of one record
  for (const int32_t word : {3, 10, 40, 20, 30, width, height, 0, 0}) put(word);
  return bytes + std::string("\0\1\0\2\0\3\0\4", 2 * kPixels);
}

TEST_F(Program, FramesThatArePassedOverAreTold) {
  const std::string header = "#!AER-DAT3.1\r\n#Source 0: DVS128\r\n#!END-HEADER\r\n";
  write_text(path("some.aedat"), header + frame_packet(99, 99) + frame_packet(2, 2));
  const Outcome some = run("frames " + path("some.aedat") + " -o " + path("pictures"));
  EXPECT_EQ(some.exit_code, 0) << some.err;
  EXPECT_THAT(some.out, HasSubstr("lost: 1 frames"));
  EXPECT_THAT(some.out, HasSubstr("byte " + std::to_string(header.size())));
  EXPECT_EQ(content_of(path("pictures/frames.csv")),
            "index,t_us,exposure_begin_us,exposure_end_us\n0,25,20,30\n");
  EXPECT_EQ(run("frames --strict --overwrite " + path("some.aedat") + " -o " + path("pictures")).exit_code,
            1);

  write_text(path("none.aedat"), header + frame_packet(99, 99));
  const Outcome none = run("frames --overwrite " + path("none.aedat") + " -o " + path("pictures"));
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("no frame was read"));
}

TEST_F(Program, FramesOfAFormatWithoutThemAreAnError) {
  const Outcome outcome = run("frames " + recording(10) + " -o " + path("pictures"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no frames"));
  EXPECT_FALSE(fs::exists(path("pictures")));
  EXPECT_EQ(run("frames " + recording(10)).exit_code, 2);
}

}  // namespace
}  // namespace scarf::tools
