// Encodings of a SCARF's active events, computed on its device: the events do not travel to the host.
#pragma once

#include <memory>

#include "scarf/core/encoding.h"
#include "scarf/device/stream.h"

namespace scarf {

/// One encoding of one SCARF. Keeps the stream's memory alive, and may outlive the GpuScarf.
class GpuEncoder {
 public:
  virtual ~GpuEncoder() = default;

  /// The tensor of the active events as they are now, of shape_of(parameters, sensor): the same bits as
  /// encode() of active_events().
  virtual Pending<Image<float>> encode() = 0;
};

/// Errors: illegal_parameter as checked_encoding, for encodings that are on the CPU only (hats, hots), and
/// for a GpuScarf that is not of this library; out_of_memory.
Result<std::unique_ptr<GpuEncoder>> make_gpu_encoder(GpuScarf& scarf, const EncodingParameters& parameters);

}  // namespace scarf
