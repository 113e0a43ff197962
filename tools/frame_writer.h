// Where rendered frames go: a folder of PNG files, a video, or one image.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "scarf/result.h"
#include "tools/instants.h"

namespace scarf::tools {

enum class OutputKind { folder, video, image };

/// The kind of output by its name: .mp4 and .avi are videos, .png and .pgm images, a name without an
/// extension or ending in / is a folder. Errors: illegal_parameter for any other extension.
Result<OutputKind> output_kind(const std::string& path);

/// Keeps the libraries behind videos from printing: what goes wrong is told by the writer. Sets environment
/// variables, so a program with threads calls it before it starts them.
void silence_video_messages();

/// Takes 8-bit single-channel pictures of one size, in order.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Errors: io.
  virtual Result<void> write(const Frame& frame, const cv::Mat& picture) = 0;
  /// Completes the output. Errors: io.
  virtual Result<void> finish() = 0;
};

/// `video_fps` is the speed at which a video is shown. A folder is made if it is not there, and frames of an
/// earlier rendering in it are removed. Errors: io.
Result<std::unique_ptr<FrameWriter>> make_frame_writer(const std::string& path, OutputKind kind,
                                                       double video_fps);

}  // namespace scarf::tools
