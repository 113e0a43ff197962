// The picture that SCARF is commonly compared with: all events of a fixed time window.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "scarf/event.h"

namespace scarf::tools {

/// Remembers the newest event of each pixel.
class TimeWindow {
 public:
  TimeWindow(SensorSize sensor, int64_t milliseconds);

  /// Events must be inside the sensor.
  void add(std::span<const Event> events);
  /// 255 where one of the events so far has a time of `t` minus the window or later, else 0.
  cv::Mat picture(int64_t t) const;
  int64_t milliseconds() const { return milliseconds_; }

 private:
  const SensorSize sensor_;
  const int64_t milliseconds_;
  std::vector<int64_t> newest_;  // row-major
  std::vector<bool> seen_;
};

/// Two pictures of one size beside each other, each under its label. Their pixels are unchanged.
cv::Mat side_by_side(const cv::Mat& left, const std::string& left_label, const cv::Mat& right,
                     const std::string& right_label);

}  // namespace scarf::tools
