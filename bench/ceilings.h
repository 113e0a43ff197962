// What a device can do at most, measured: what the times of stages and streams are held against.
#pragma once

#include "scarf/device/context.h"

namespace scarf::bench {

struct Ceilings {
  double copy_bytes_per_s = 0;      ///< by a shader, in device memory: bytes read and written
  double atomics_per_s = 0;         ///< integer additions at addresses without an order, in 4 MiB
  double upload_bytes_per_s = 0;    ///< host memory to device memory, by the copy engine
  double readback_bytes_per_s = 0;  ///< device memory to host memory
  double submission_us = 0;  ///< an empty dispatch, from submission until the host knows that it is done
};

/// Each is the best of a few runs. Errors: device, out_of_memory.
Result<Ceilings> measure_ceilings(GpuContext& context);

}  // namespace scarf::bench
