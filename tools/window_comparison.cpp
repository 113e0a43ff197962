#include "tools/window_comparison.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace scarf::tools {
namespace {

constexpr int kLabelHeight = 20;  // pixels, above each picture
constexpr int kGap = 8;           // pixels, between the pictures

void put(cv::Mat& canvas, int x, const cv::Mat& picture, const std::string& label) {
  picture.copyTo(canvas(cv::Rect(x, kLabelHeight, picture.cols, picture.rows)));
  cv::Mat strip = canvas(cv::Rect(x, 0, picture.cols, kLabelHeight));
  cv::putText(strip, label, cv::Point(4, kLabelHeight - 6), cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar(255),
              1, cv::LINE_AA);
}

}  // namespace

TimeWindow::TimeWindow(SensorSize sensor, int64_t milliseconds)
    : sensor_(sensor),
      milliseconds_(milliseconds),
      newest_(static_cast<size_t>(sensor.width) * sensor.height),
      seen_(newest_.size()) {}

void TimeWindow::add(std::span<const Event> events) {
  for (const Event& e : events) {
    const size_t pixel = static_cast<size_t>(e.y) * sensor_.width + e.x;
    newest_[pixel] = seen_[pixel] ? std::max(newest_[pixel], e.t) : e.t;
    seen_[pixel] = true;
  }
}

cv::Mat TimeWindow::picture(int64_t t) const {
  int64_t begin = 0;
  if (__builtin_sub_overflow(t, milliseconds_ * 1000, &begin)) begin = std::numeric_limits<int64_t>::min();
  cv::Mat picture(sensor_.height, sensor_.width, CV_8UC1);
  for (size_t pixel = 0; pixel < newest_.size(); ++pixel) {
    picture.data[pixel] = seen_[pixel] && newest_[pixel] >= begin ? 255 : 0;
  }
  return picture;
}

cv::Mat side_by_side(const cv::Mat& left, const std::string& left_label, const cv::Mat& right,
                     const std::string& right_label) {
  cv::Mat canvas(kLabelHeight + left.rows, left.cols + kGap + right.cols, CV_8UC1, cv::Scalar(64));
  put(canvas, 0, left, left_label);
  put(canvas, left.cols + kGap, right, right_label);
  return canvas;
}

}  // namespace scarf::tools
