// Camera words that are decoded on the device: the bytes of a recording or a camera go there as they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "scarf/core/read_report.h"
#include "scarf/core/result.h"
#include "scarf/device/stream.h"

namespace scarf {

/// Formats that a device decodes: Prophesee's EVT2 (words of 4 bytes) and EVT3 (of 2), little-endian, without
/// the text header of a file. docs/FORMATS.md says what each word means.
enum class CameraWords { evt2, evt3 };

/// Feeds one representation on a device. Event for event the same as the reader of the format
/// (scarf/io/recordings.h) and GpuRepresentation::push behind it, for any bytes and any way of cutting them;
/// events outside the sensor are dropped here, as readers do.
///
/// Words are gathered like pushed events: every query of the representation sees exactly the bytes whose push
/// returned before it. The host has to know how many events there are before the representation can take
/// them, so flush(), finish() and queries of the representation, and the pushes of later words, wait for the
/// decoding of earlier ones (not for the representation's work on them).
///
/// Threads: the decoder belongs to the pushing thread of the representation; between its pushes that thread
/// may push events too. Both may be destroyed in any order.
class GpuDecoder {
 public:
  virtual ~GpuDecoder() = default;

  /// Appends bytes, any number of them; a word may be cut anywhere. Returns how many were taken from the
  /// front: all, or fewer with GpuOptions::WhenFull::would_block. Errors: would_block, if none were taken;
  /// refused_batch, as Representation::push for the events of these bytes: then none of them is stored, but
  /// the bytes count as read. More than max_batch() bytes are taken in batches of that size; what follows a
  /// refused one is then not taken. After any other error it is not known how many bytes were decoded: the
  /// representation is broken until its reset, and the decoder says so for good. Make a new one.
  virtual Result<size_t> push(std::span<const uint8_t> bytes) = 0;
  virtual size_t max_batch() const = 0;

  /// What was met in all bytes so far, equal to the reader's report: waits until they are decoded.
  /// truncated_bytes are those at the end that do not make a whole word yet; they count with the next push.
  virtual Result<ReadReport> report() = 0;
  /// The time of the representation's newest event; nullopt if it has none. Waits as report() does.
  virtual Result<std::optional<int64_t>> newest() = 0;
};

/// A decoder that stands at the beginning of a stream of words. A reset of the representation empties that,
/// not the decoder, which goes on with the words that follow.
/// Errors: illegal_parameter, if the representation has a decoder already or was not made by this library;
/// out_of_memory.
Result<std::unique_ptr<GpuDecoder>> make_gpu_decoder(GpuRepresentation& representation, CameraWords words);

}  // namespace scarf
