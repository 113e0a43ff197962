// What is common to the queries of every implementation: refusals, and the optional order by time.
#pragma once

#include <algorithm>
#include <vector>

#include "core/text.h"
#include "scarf/core/patch_state.h"

namespace scarf {

/// Brightness is not negative, so dense images cannot show ON minus OFF.
inline Result<void> check_dense_mode(PolarityMode mode) {
  if (mode != PolarityMode::difference) return {};
  return Error{ErrorCode::illegal_parameter,
               "a dense image cannot show ON minus OFF; use count_image for that, or merged or separate"};
}

inline Result<void> check_patch(const Geometry& geometry, int64_t patch) {
  if (patch >= 0 && patch < geometry.patches()) return {};
  return Error{ErrorCode::illegal_parameter,
               text("patch is ", patch, ", legal is 0 to ", geometry.patches() - 1)};
}

/// For the representations that keep no events.
inline Error no_events() {
  return {ErrorCode::illegal_parameter,
          "this representation keeps no events; scarf, aae and time_window with counts do"};
}

/// Events that come in by_patch order, in the order asked for.
inline std::vector<Event> ordered(std::vector<Event> events, EventOrder order) {
  if (order == EventOrder::by_time) {
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
  }
  return events;
}

}  // namespace scarf
