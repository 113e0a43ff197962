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

TEST_F(Program, FramesOfAFormatWithoutThemAreAnError) {
  const Outcome outcome = run("frames " + recording(10) + " -o " + path("pictures"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no frames"));
  EXPECT_FALSE(fs::exists(path("pictures")));
  EXPECT_EQ(run("frames " + recording(10)).exit_code, 2);
}

}  // namespace
}  // namespace scarf::tools
