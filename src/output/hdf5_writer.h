// HDF5 files of what is computed frame by frame: pictures, tensors, and the sparse events of each frame.
// They appear complete or not at all. Every libhdf5 reads them: chunks, shuffle and deflate, no plugin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/event_list_writer.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"
#include "session/instants.h"

namespace scarf {

/// Pictures: dataset `frames` (n, height, width).
inline constexpr std::string_view kHdf5Frames = "frames";
/// Tensors: dataset `data` (n, channels, height, width), the layout that RVT reads.
inline constexpr std::string_view kHdf5Tensors = "data";

/// Arrays of one shape, one per frame, and beside them `times` (n, int64, microseconds: Frame::t) and
/// `events` (n, uint64: Frame::events). A frame is one chunk.
class Hdf5ArrayWriter {
 public:
  virtual ~Hdf5ArrayWriter() = default;
  /// `values`: one array, row-major, of the element type that the file was created with. Errors: io;
  /// illegal_parameter if number or type of the values is another one.
  virtual Result<void> write(const Frame& frame, std::span<const uint8_t> values) = 0;
  virtual Result<void> write(const Frame& frame, std::span<const float> values) = 0;
  /// Completes the file; without it there is none. Errors: io.
  virtual Result<void> finish() = 0;
};

enum class Hdf5Element { u8, f32 };

/// `dataset`: kHdf5Frames or kHdf5Tensors. `shape`: of one array, {height, width} or {channels, height,
/// width}; every number is at least 1. Errors: as OutputFile::create; illegal_parameter if this build has no
/// HDF5.
Result<std::unique_ptr<Hdf5ArrayWriter>> create_hdf5_arrays(const std::string& path, std::string_view dataset,
                                                            Hdf5Element element, std::vector<size_t> shape,
                                                            const OutputRule& rule);

/// The sparse events of each frame, one frame after the other: `events/x`, `events/y` (uint16), `events/p`
/// (uint8), `events/t` (int64, microseconds), and `events/width`, `events/height`; frame k has the rows
/// `frame_offsets[k]` up to `frame_offsets[k + 1]` (n + 1, uint64). `times` as above, `stream_events` is
/// Frame::events. Errors: as OutputFile::create; illegal_parameter if this build has no HDF5.
Result<std::unique_ptr<EventListWriter>> create_hdf5_events(const std::string& path, SensorSize sensor,
                                                            const OutputRule& rule);

}  // namespace scarf
