// The built program from outside: runs it, and checks how it tells errors.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/text.h"
#include "scarf/reference/reference.h"
#include "tests/tools/event_fixtures.h"
#include "tests/tools/temporary_folder.h"

namespace scarf::tools {

inline constexpr SensorSize kSensor{64, 48};

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

class Program : public testing::Test {
 protected:
  // Standard error must be empty or one line that begins with "scarf: ", in every run of every test.
  Outcome run(const std::string& arguments) {
    // What the arguments redirect themselves comes last, and so counts.
    const std::string command =
        text("exec >", path("out"), " 2>", path("err"), "; exec ", SCARF_PROGRAM, " ", arguments);
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(path("out")),
                    content_of(path("err"))};
    if (!outcome.err.empty()) {
      EXPECT_THAT(outcome.err, testing::StartsWith("scarf: ")) << arguments;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << arguments << "\n"
                                                                             << outcome.err;
      EXPECT_NE(outcome.exit_code, 0) << arguments;
    }
    return outcome;
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  // A recording of random events, and its path.
  std::string recording(size_t count = 20'000) {
    events_ = random_events(count, kSensor);
    auto sink = *create_events(path("recording.txt"), "text", kSensor, {.overwrite = true});
    EXPECT_TRUE(sink->write(events_).ok());
    EXPECT_TRUE(sink->finish().ok());
    return path("recording.txt");
  }

  // The reference's picture after the first n events of the recording.
  cv::Mat reference_picture(size_t n, Preset preset = Preset::paper) const {
    const auto scarf = *make_reference_scarf(*make_geometry(preset, kSensor));
    EXPECT_TRUE(scarf->push(std::span(events_).first(n)).ok());
    const Image<uint8_t> image = *scarf->u8_image().wait();
    cv::Mat picture(image.height, image.width, CV_8UC1);
    std::copy(image.pixels.begin(), image.pixels.end(), picture.data);
    return picture;
  }

  void expect_picture(const std::string& file, const cv::Mat& expected) const {
    const cv::Mat picture = cv::imread(file, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(picture.type(), CV_8UC1) << file;
    ASSERT_EQ(picture.size(), expected.size()) << file;
    EXPECT_EQ(cv::countNonZero(picture != expected), 0) << file;
  }

  std::vector<Event> events_;

 private:
  const TemporaryFolder folder_;
};

}  // namespace scarf::tools
