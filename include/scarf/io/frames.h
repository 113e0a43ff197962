// What some recordings hold beside events: greyscale frames and external triggers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "scarf/core/image.h"
#include "scarf/core/read_report.h"
#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf {

/// A frame of the camera. Times in microseconds, on the clock of the events.
struct GreyFrame {
  int64_t t = 0;               ///< the frame's own time stamp
  int64_t exposure_begin = 0;  ///< equal to t where the file does not say
  int64_t exposure_end = 0;
  Image<uint8_t> image;  ///< one plane; colour is turned into grey
};

/// What a FrameSource passed over: frames that are broken or have pixels that scarf does not read, and places
/// where the file is broken.
struct PassedFrames {
  uint64_t count = 0;
  std::optional<Damage> first;
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The next frame in file order; nullopt at the end. What is passed over of AEDAT is no error, unless
  /// ReadOptions::strict says so, and the frames behind it follow.
  virtual Result<std::optional<GreyFrame>> read() = 0;
  virtual const PassedFrames& passed_over() const { return passed_over_; }

 protected:
  void pass_over(uint64_t byte, std::string what) {
    if (passed_over_.count++ == 0) passed_over_.first = Damage{byte, std::move(what)};
  }

 private:
  PassedFrames passed_over_;
};

class TriggerSource {
 public:
  virtual ~TriggerSource() = default;
  /// Reads up to out.size() triggers (at least 1) in file order; 0 means the end.
  virtual Result<size_t> read(std::span<Trigger> out) = 0;
};

/// As open_events, for what accompanies the events. Errors: also unrecognised, if the format or the recording
/// has none.
Result<std::unique_ptr<FrameSource>> open_frames(const std::string& path, const ReadOptions& options = {});
Result<std::unique_ptr<TriggerSource>> open_triggers(const std::string& path,
                                                     const ReadOptions& options = {});

}  // namespace scarf
