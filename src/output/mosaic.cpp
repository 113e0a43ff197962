#include "output/mosaic.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "output/opencv_picture.h"

namespace scarf {
namespace {

constexpr int kLabelHeight = 20;  // pixels, above each picture
constexpr int kGap = 8;           // pixels, between the pictures
constexpr int kMostInOneRow = 3;
const cv::Scalar kBackground(64);

void put(cv::Mat& canvas, cv::Point corner, const Tile& tile) {
  const cv::Size size = cv::Size(tile.picture.size.width, tile.picture.size.height);
  as_mat(tile.picture).copyTo(canvas(cv::Rect(corner + cv::Point(0, kLabelHeight), size)));
  cv::Mat strip = canvas(cv::Rect(corner, cv::Size(size.width, kLabelHeight)));
  cv::putText(strip, tile.label, cv::Point(4, kLabelHeight - 6), cv::FONT_HERSHEY_SIMPLEX, 0.45,
              cv::Scalar(255), 1, cv::LINE_AA);
}

}  // namespace

Image<uint8_t> mosaic(const std::vector<Tile>& tiles) {
  const int count = static_cast<int>(tiles.size());
  const int columns = count <= kMostInOneRow ? count : static_cast<int>(std::ceil(std::sqrt(count)));
  const int rows = (count + columns - 1) / columns;
  const SensorSize size = tiles.front().picture.size;
  const int step_x = size.width + kGap;
  const int step_y = kLabelHeight + size.height + kGap;
  Image<uint8_t> image(columns * step_x - kGap, rows * step_y - kGap);
  cv::Mat canvas = as_mat(image);
  canvas.setTo(kBackground);
  for (int i = 0; i < count; ++i) {
    put(canvas, {i % columns * step_x, i / columns * step_y}, tiles[static_cast<size_t>(i)]);
  }
  return image;
}

}  // namespace scarf
