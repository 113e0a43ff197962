// A writer of frames whose work is done by a thread of its own, a few frames behind who makes them.
#pragma once

#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "tools/frame_writer.h"
#include "tools/hand_over.h"

namespace scarf::tools {

class WriteBehind final : public FrameWriter {
 public:
  explicit WriteBehind(std::unique_ptr<FrameWriter> writer);
  /// Frames that wait are dropped.
  ~WriteBehind() override;
  WriteBehind(const WriteBehind&) = delete;
  WriteBehind& operator=(const WriteBehind&) = delete;

  /// Copies the picture. Errors: also those of earlier frames.
  Result<void> write(const Frame& frame, const cv::Mat& picture) override;
  Result<void> finish() override;

 private:
  void write_all();
  Result<void> so_far();

  const std::unique_ptr<FrameWriter> writer_;
  HandOver<std::pair<Frame, cv::Mat>> frames_;
  std::mutex mutex_;
  Result<void> result_;  // of the frames that were written
  std::thread thread_;
};

}  // namespace scarf::tools
