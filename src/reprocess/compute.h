// One recording, played through one representation: its pictures on their way to a writer, and its digests.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "output/products.h"
#include "reprocess/settings.h"
#include "scarf/core/filter.h"
#include "scarf/core/image.h"
#include "scarf/device/stream.h"
#include "scarf/io/recordings.h"

namespace scarf::reprocess {

/// Who computes; may be shared by any number of threads.
struct Machine {
  std::shared_ptr<GpuContext> context;  ///< none: the CPU reference
  BatchSizes batches = BatchSizes::fixed(kDefaultBatch);

  std::string name() const;
};

/// How far a recording is, for a progress display.
struct Meter {
  std::atomic<uint64_t> bytes = 0;  ///< read of its input
  std::atomic<uint64_t> events = 0;
};

struct Digests {
  std::string state;
  std::string image;  ///< of the final picture
  std::string events;

  friend bool operator==(const Digests&, const Digests&) = default;
};

struct Computed {
  Digests digests;
  Image<uint8_t> image;   ///< the final picture
  int64_t last_time = 0;  ///< of the last event, microseconds
  std::string format;
  SensorSize sensor;
  ReadReport report;
  std::vector<FilterReport> filters;
  uint64_t frames = 0;
};

/// Makes what is written of each frame. `shown` has one representation.
using MakeProducts =
    std::function<Result<std::vector<std::unique_ptr<FrameProduct>>>(const std::vector<Shown>& shown)>;

/// `recording` as open_recording returned it, and `path` where it came from. Without `make_products` pictures
/// are made only where a later digest depends on them. Errors: whatever reader, representation or writer say;
/// bad_input if more frames than allowed are due.
Result<Computed> compute(OpenRecording recording, const std::string& path, const Options& options,
                         const Machine& machine, const MakeProducts& make_products, Meter& meter);

}  // namespace scarf::reprocess
