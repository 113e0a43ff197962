// The words of a recording, decoded on the device of some representations.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scarf/device/decoder.h"
#include "scarf/io/words.h"
#include "session/request.h"

namespace scarf {

class DeviceWords {
 public:
  /// Errors: illegal_parameter, if a representation is not on a device, and for standard input; bad_input for
  /// recordings that are not EVT2 or EVT3.
  static Result<DeviceWords> open(const StreamRequest& options, std::span<Representation* const> to);

  /// Hands about so many bytes, or those that are left, to every representation; 0: there are none.
  Result<size_t> push(size_t bytes);
  /// Of the first representation.
  Result<ReadReport> report() { return decoders_.front()->report(); }
  Result<std::optional<int64_t>> newest() { return decoders_.front()->newest(); }

 private:
  std::unique_ptr<WordSource> source_;
  std::vector<std::unique_ptr<GpuDecoder>> decoders_;
  std::vector<uint8_t> bytes_;
};

}  // namespace scarf
