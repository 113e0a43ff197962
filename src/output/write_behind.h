// A writer of frames whose work is done by a thread of its own, a few frames behind who makes them.
#pragma once

#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include "output/frame_writer.h"
#include "session/hand_over.h"

namespace scarf {

class WriteBehind final : public FrameWriter {
 public:
  explicit WriteBehind(std::unique_ptr<FrameWriter> writer);
  /// Frames that wait are dropped.
  ~WriteBehind() override;
  WriteBehind(const WriteBehind&) = delete;
  WriteBehind& operator=(const WriteBehind&) = delete;

  /// Copies the picture. Errors: also those of earlier frames.
  Result<void> write(const Frame& frame, const PictureView& picture) override;
  Result<void> finish() override;

  /// A copy of what a view shows.
  using Picture = std::variant<Image<uint8_t>, Image<float>>;

 private:
  void write_all();
  Result<void> so_far();

  const std::unique_ptr<FrameWriter> writer_;
  HandOver<std::pair<Frame, std::unique_ptr<Picture>>> frames_;
  std::mutex mutex_;
  Result<void> result_;  // of the frames that were written
  std::thread thread_;
};

}  // namespace scarf
