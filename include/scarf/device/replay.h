// Replay: SCARF pictures of a recording at many instants, computed at the same time. A picture depends on the
// events before it and on nothing else, so those of a recording need not wait for each other.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "scarf/device/stream.h"

namespace scarf {

/// A picture that is handed over. T as of make_gpu_replay.
template <class T>
struct ReplayFrame {
  uint64_t index = 0;   ///< 0 for the first frame that was asked for
  uint64_t events = 0;  ///< events inside the sensor that were pushed before it was asked for
  SensorSize sensor;
  std::span<const T> pixels;  ///< height x width, row-major; valid during the call only
};

/// Takes the frames in the order in which they were asked for. An error ends the replay: it is returned by
/// the call that hands the frame over, and by every later one.
template <class T>
using TakeReplayFrame = std::function<Result<void>(const ReplayFrame<T>&)>;

struct ReplayOptions {
  /// Most frames of one group, up to 4,096; 0: chosen for the device and the size of a picture. Never changes
  /// a picture.
  uint32_t group_frames = 0;
  /// Most events of one group, up to 16,777,216; 0: chosen for the device. Never changes a picture.
  uint32_t group_events = 0;
  /// Events walked by one team of invocations, up to 32,768; 0: chosen. Never changes a picture.
  uint32_t chunk_events = 0;
};

/// SCARF over a recording. Events and requests for frames are gathered into groups. A group is binned once;
/// then all its frames are computed by a number of dispatches that does not depend on how many they are.
/// Frames are handed over group by group, by the calls below, while the device works on the next group: so
/// memory is bounded, and a frame comes later than it was asked for. For pictures as soon as events arrive
/// use make_gpu_scarf.
///
/// One thread at a time may use a Replay.
class Replay {
 public:
  virtual ~Replay() = default;

  virtual const Geometry& geometry() const = 0;

  /// Appends events (any number). Those outside the sensor are counted and dropped.
  /// Errors: refused_batch as Representation::push; then nothing of the batch is used. Any other error is
  /// returned by every later call, unless no event had been used yet.
  virtual Result<PushReport> push(std::span<const Event> events) = 0;
  /// Asks for a picture of the state after everything pushed so far. Errors: as push.
  virtual Result<void> frame() = 0;
  /// Hands over all frames that were asked for. More may be pushed afterwards. Errors: as push.
  virtual Result<void> finish() = 0;

  /// Device time per stage of the groups that are done; empty where the device has no timestamps.
  virtual std::vector<StageTime> stage_times() const = 0;
  /// Device and host-visible memory, in bytes: fixed from the start.
  virtual uint64_t memory_bytes() const = 0;
};

/// T is uint8_t for 8-bit brightness (Scarf::u8_image), float for brightness (Scarf::float_image), int32_t
/// for counts of events (Scarf::count_image); both polarities alike. The pictures have the same bits as
/// those of a Scarf at these places of the stream.
/// Errors: illegal_parameter as checked_geometry and make_levels, for options out of range and a null
/// context; out_of_memory, naming size and limit, if a picture or the state does not fit the device.
template <class T>
Result<std::unique_ptr<Replay>> make_gpu_replay(std::shared_ptr<GpuContext> context, const Geometry& geometry,
                                                TakeReplayFrame<T> take,
                                                double accumulation = kDefaultAccumulation,
                                                const ReplayOptions& options = {});

extern template Result<std::unique_ptr<Replay>> make_gpu_replay<uint8_t>(std::shared_ptr<GpuContext>,
                                                                         const Geometry&,
                                                                         TakeReplayFrame<uint8_t>, double,
                                                                         const ReplayOptions&);
extern template Result<std::unique_ptr<Replay>> make_gpu_replay<float>(std::shared_ptr<GpuContext>,
                                                                       const Geometry&,
                                                                       TakeReplayFrame<float>, double,
                                                                       const ReplayOptions&);
extern template Result<std::unique_ptr<Replay>> make_gpu_replay<int32_t>(std::shared_ptr<GpuContext>,
                                                                         const Geometry&,
                                                                         TakeReplayFrame<int32_t>, double,
                                                                         const ReplayOptions&);

}  // namespace scarf
