// The first place where two states, or all that two implementations hand out, differ.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarf/core/parameters.h"
#include "scarf/core/patch_state.h"

namespace scarf {

/// What the two sides of a comparison are called in its result.
struct SideNames {
  std::string a;
  std::string b;
};

/// One patch of a state. Both sides of a comparison show either all slots or the filled ones.
struct PatchView {
  uint64_t total = 0;
  std::span<const Event> slots;
};

// A difference is one line that names the place and both values; nullopt means there is none.

std::optional<std::string> patch_difference(size_t patch, const PatchView& a, const PatchView& b,
                                            const SideNames& names);
std::optional<std::string> geometry_difference(const Geometry& a, const Geometry& b, const SideNames& names);

/// How far apart the pictures of a representation may be that is computed in floating point: those of aed_sae
/// and aae. Counts what it let pass.
class Tolerance {
 public:
  Tolerance(const Parameters& parameters, SensorSize sensor);

  /// To be called before a picture is asked for: finds the blocks of aae where rounding may decide.
  /// Errors: whatever the reference returned.
  Result<void> prepare(Representation& reference);
  /// Whether the two 8-bit pictures are close enough.
  bool accepts(const Image<uint8_t>& a, const Image<uint8_t>& b);
  /// Whether the states must still be the same.
  bool exact_state() const { return close_blocks_ == 0; }
  /// What was let pass so far, for people; empty if nothing.
  std::string report() const;

 private:
  const Parameters parameters_;
  const SensorSize sensor_;
  std::vector<bool> close_;  // by block of aae
  uint64_t close_blocks_ = 0;
  uint64_t pixels_ = 0;
  uint64_t worst_pixels_ = 0;
};

/// Compares everything that two implementations hand out. A Scarf: totals and every slot, all images, both
/// event lists. Others: state, images, events; with a tolerance the 8-bit pictures only. `a` is the
/// reference. Errors: whatever a query of either side returned.
Result<std::optional<std::string>> first_difference(Representation& a, Representation& b,
                                                    const SideNames& names, Tolerance* tolerance = nullptr);

}  // namespace scarf
