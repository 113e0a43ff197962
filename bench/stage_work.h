// What the stages of SCARF have to do, counted on the host from plan, geometry and events: what their times
// are held against.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "pipelines/scarf/plan.h"
#include "scarf/core/event.h"
#include "scarf/core/patch_grid.h"

namespace scarf::bench {

/// What events do to the patches.
struct Hits {
  uint32_t events = 0;   ///< hit or not
  uint64_t hits = 0;     ///< pairs of an event and a patch that holds it
  uint64_t stored = 0;   ///< hits that are among the last N of their patch
  uint64_t patches = 0;  ///< with a hit
};
Hits count_hits(const Geometry& geometry, std::span<const Event> events);

/// Bytes are those that have to be read from or written to buffers of events, of the table, of the state and
/// of pictures, as if caches kept everything while a stage goes over a buffer once: each word counts once per
/// pass, read and written apart. Not counted: tables of the geometry and of levels, which any cache holds.
struct StageWork {
  std::string_view stage;  ///< as StageTime names it
  double bytes = 0;
  double atomics = 0;
};

/// Of one submission of the events that were counted.
/// - clear: counts of all chunks and classes written
/// - count: events read, an atomic each; counts read and written, at most one per event
/// - sum: counts read and written, twice
/// - scan: sums read; entries written, read and written; heads read and written
/// - append, instead of all these and place: for each part and band events read; heads read and
///   written, each at most once; all hits written, and positions if the plan paints
/// - prune: entries read, the result written
/// - place: for each band events and the result of prune read; entries read and written, each at most once;
///   slots written, and positions if the plan paints
std::vector<StageWork> push_work(const Plan& plan, const Hits& hits);

/// Of one 8-bit image, its copy for the host included. `hits`: of the events since the last one.
/// - paint: heads of now and of the last picture read; of changed patches head and cell written
///   and positions read
/// - render: counts set to 0; all slots and heads read; for each slot, at most one per pixel, its count read
///   and written
/// - tone: counts read, picture written
/// - copy: picture read and written
std::vector<StageWork> image_work(const Geometry& geometry, const Plan& plan, const Hits& hits);

}  // namespace scarf::bench
