// ECF, the compression of events in Metavision HDF5 files (filter 36559).
// Source: prophesee-ai/hdf5_ecf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

inline constexpr int kEcfFilter = 36559;
/// Events of one chunk, at most.
inline constexpr size_t kEcfMaxEvents = 65'535;

/// The events of a chunk, in place of what `events` held. Errors: bad_input, naming what is wrong; `events`
/// then holds nothing.
Result<void> decode_ecf(std::span<const uint8_t> chunk, std::vector<Event>& events);

}  // namespace scarf::hdf5
