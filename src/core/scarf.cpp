// What a Scarf is as a Representation.
#include "core/little_endian.h"
#include "scarf/core/patch_state.h"

namespace scarf {

std::vector<uint8_t> state_bytes(const Snapshot& snapshot, size_t patch) {
  const Geometry& g = snapshot.geometry;
  const auto i = static_cast<int32_t>(patch % g.x.grid);
  const auto j = static_cast<int32_t>(patch / g.x.grid);
  const int64_t filled = snapshot.filled(patch);
  std::vector<uint8_t> bytes;
  bytes.reserve(8 + 14 * filled);
  append_little_endian(bytes, snapshot.totals[patch]);
  for (const Event& e : snapshot.ring(patch).first(filled)) {
    append_little_endian(bytes, e.x);
    append_little_endian(bytes, e.y);
    append_little_endian(bytes, e.p);
    append_little_endian(bytes, static_cast<uint8_t>(g.x.active(e.x, i) && g.y.active(e.y, j)));
    append_little_endian(bytes, static_cast<uint64_t>(e.t));
  }
  return bytes;
}

Pending<Image<int64_t>> Scarf::raw_image() {
  return count_image(PolarityMode::merged).then<Image<int64_t>>([](const Image<int32_t>& counts) {
    Image<int64_t> raw(counts.width, counts.height, counts.planes);
    raw.pixels.assign(counts.pixels.begin(), counts.pixels.end());
    return Result<Image<int64_t>>(std::move(raw));
  });
}

Pending<std::vector<uint8_t>> Scarf::state() {
  return snapshot().then<std::vector<uint8_t>>([](const Snapshot& snapshot) {
    std::vector<uint8_t> bytes;
    for (size_t patch = 0; patch < snapshot.totals.size(); ++patch) {
      const std::vector<uint8_t> of_patch = state_bytes(snapshot, patch);
      bytes.insert(bytes.end(), of_patch.begin(), of_patch.end());
    }
    return Result<std::vector<uint8_t>>(std::move(bytes));
  });
}

}  // namespace scarf
