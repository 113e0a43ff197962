// The families of HDF5 files with events.
#pragma once

#include <cstddef>
#include <string_view>

namespace scarf::hdf5 {

/// One format each.
enum class Family { metavision, mvsec, m3ed, dsec, rvt, event_utils, other };

constexpr std::string_view name_of(Family family) {
  constexpr std::string_view kNames[] = {"metavision-h5", "mvsec",       "m3ed", "dsec",
                                         "rvt",           "event-utils", "hdf5"};
  return kNames[static_cast<size_t>(family)];
}

}  // namespace scarf::hdf5
