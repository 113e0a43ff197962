// Encodings of events that are in device memory: tensors that never leave it unless somebody copies them.
#pragma once

#include <cstdint>
#include <memory>

#include "kernels/pipeline_builder.h"
#include "scarf/core/encoding.h"
#include "vulkan/commands.h"

namespace scarf {

/// Events in device memory, 16 bytes each.
struct DeviceEvents {
  const vulkan::Buffer* first = nullptr;   ///< events 0 .. first_events-1
  const vulkan::Buffer* second = nullptr;  ///< the rest; may be null if there is no rest
  const vulkan::Buffer* total = nullptr;   ///< one word: how many events there are
  uint64_t first_events = 0;               ///< room of `first`
  uint64_t most_events = 0;                ///< room of both
  /// Most events of one pixel, if that is known (of SCARF's active events: a patch's capacity); 0: it is not.
  uint64_t most_per_pixel = 0;
};

/// One encoding; equals encode() of the same events bit for bit. Events outside the sensor are ignored; the
/// polarity of an event is the lowest bit of p. Not for hats and hots.
class Encoder {
 public:
  /// Kernels bound to some events. The encoder and the buffers must outlive it.
  struct Bound {
    DeviceEvents events;
    vulkan::BoundKernel span;
    vulkan::BoundKernel stages[3];  // of the encoding
  };

  virtual ~Encoder() = default;

  /// Errors: illegal_parameter as checked_encoding, for a sensor outside 1..16,384 pixels per axis, and for
  /// encodings that are on the CPU only; out_of_memory. `most_events`: of any bind().
  static Result<std::unique_ptr<Encoder>> create(vulkan::Device& device, const EncodingParameters& parameters,
                                                 SensorSize sensor, uint64_t most_events);

  virtual Result<std::unique_ptr<Bound>> bind(const DeviceEvents& events) const = 0;
  /// Encodes the events into tensor(). What was written before must be visible (a barrier in front is the
  /// caller's); the tensor is visible to what follows.
  virtual void record(vulkan::Commands& commands, const Bound& bound) const = 0;

  /// Floats, row-major: planes, rows, columns.
  virtual const vulkan::Buffer& tensor() const = 0;
  virtual EncodingShape shape() const = 0;
  virtual uint64_t memory_bytes() const = 0;
};

}  // namespace scarf
