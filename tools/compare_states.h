// The first place where two SCARF states, or all that two implementations hand out, differ.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "scarf/scarf.h"

namespace scarf::tools {

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

/// Compares everything that a Scarf hands out: totals and every slot, all images, both event lists.
/// Errors: whatever a query of either side returned.
Result<std::optional<std::string>> first_difference(Scarf& a, Scarf& b, const SideNames& names);

}  // namespace scarf::tools
