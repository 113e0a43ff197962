#include "tools/compare_states.h"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "core/text.h"

namespace scarf::tools {
namespace {

using Difference = std::optional<std::string>;

std::string shown(const Event& e) {
  return text("(t ", e.t, ", x ", e.x, ", y ", e.y, ", p ", int{e.p}, ")");
}

template <class T>
std::string shown(const T& value) {
  return text(+value);  // + shows an 8-bit pixel as a number
}

// With its bits: two different floats may look the same in decimal.
std::string shown(float value) {
  return text(value, " (bits ", std::bit_cast<uint32_t>(value), ")");
}

template <class T>
bool same(const T& a, const T& b) {
  return a == b;
}

bool same(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

template <class T>
std::string values(const T& a, const T& b, const SideNames& names) {
  return text(shown(a), " in ", names.a, ", ", shown(b), " in ", names.b);
}

Difference snapshot_difference(const Snapshot& a, const Snapshot& b, const SideNames& names) {
  if (auto d = geometry_difference(a.geometry, b.geometry, names)) return d;
  if (a.totals.size() != b.totals.size()) {
    return text("number of patches: ", values(a.totals.size(), b.totals.size(), names));
  }
  for (size_t patch = 0; patch < a.totals.size(); ++patch) {
    if (auto d = patch_difference(patch, {a.totals[patch], a.ring(patch)}, {b.totals[patch], b.ring(patch)},
                                  names)) {
      return d;
    }
  }
  return std::nullopt;
}

template <class T>
Difference image_difference(const std::string& what, const Image<T>& a, const Image<T>& b,
                            const SideNames& names) {
  if (a.width != b.width || a.height != b.height || a.planes != b.planes ||
      a.pixels.size() != b.pixels.size()) {
    return text(what, ": ", a.width, "x", a.height, "x", a.planes, " in ", names.a, ", ", b.width, "x",
                b.height, "x", b.planes, " in ", names.b);
  }
  const auto [in_a, in_b] = std::mismatch(a.pixels.begin(), a.pixels.end(), b.pixels.begin(),
                                          [](const T& x, const T& y) { return same(x, y); });
  if (in_a == a.pixels.end()) return std::nullopt;
  const auto index = in_a - a.pixels.begin();
  return text(what, " plane ", index / a.width / a.height, " pixel ", index % a.width, ",",
              index / a.width % a.height, ": ", values(*in_a, *in_b, names));
}

Difference list_difference(const std::string& what, const std::vector<Event>& a, const std::vector<Event>& b,
                           const SideNames& names) {
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (in_a != a.end() && in_b != b.end()) {
    return text(what, " event ", in_a - a.begin(), ": ", values(*in_a, *in_b, names));
  }
  if (a.size() != b.size()) return text(what, " length: ", values(a.size(), b.size(), names));
  return std::nullopt;
}

// Asks both sides the same question and compares the answers; both are asked before either is waited for.
template <class Ask, class Compare>
Result<Difference> asked(Scarf& a, Scarf& b, Ask ask, Compare compare) {
  auto pending_a = ask(a);
  auto pending_b = ask(b);
  const auto answer_a = pending_a.wait();
  const auto answer_b = pending_b.wait();
  if (!answer_a) return answer_a.error();
  if (!answer_b) return answer_b.error();
  return compare(*answer_a, *answer_b);
}

}  // namespace

Difference patch_difference(size_t patch, const PatchView& a, const PatchView& b, const SideNames& names) {
  if (a.total != b.total) return text("patch ", patch, " total: ", values(a.total, b.total, names));
  const auto [in_a, in_b] = std::mismatch(a.slots.begin(), a.slots.end(), b.slots.begin(), b.slots.end());
  if (in_a == a.slots.end() || in_b == b.slots.end())
    return std::nullopt;  // equal totals have equally many slots
  return text("patch ", patch, " slot ", in_a - a.slots.begin(), ": ", values(*in_a, *in_b, names));
}

Difference geometry_difference(const Geometry& a, const Geometry& b, const SideNames& names) {
  if (a == b) return std::nullopt;
  return text("geometry: ", to_string(a), " in ", names.a, ", ", to_string(b), " in ", names.b);
}

Result<Difference> first_difference(Scarf& a, Scarf& b, const SideNames& names) {
  const auto snapshots = [&](const Snapshot& x, const Snapshot& y) {
    return snapshot_difference(x, y, names);
  };
  auto d = asked(
      a, b, [](Scarf& s) { return s.snapshot(); }, snapshots);
  if (!d || *d) return d;

  constexpr std::pair<PolarityMode, const char*> kModes[] = {{PolarityMode::merged, "merged"},
                                                             {PolarityMode::separate, "separate"},
                                                             {PolarityMode::difference, "difference"}};
  for (const auto& [mode, mode_name] : kModes) {
    const auto images = [&, name = mode_name](const std::string& kind) {
      return [&names, what = text(kind, " image (", name, ")")](const auto& x, const auto& y) {
        return image_difference(what, x, y, names);
      };
    };
    const auto asked_mode = mode;
    d = asked(
        a, b, [=](Scarf& s) { return s.count_image(asked_mode); }, images("count"));
    if (!d || *d) return d;
    if (mode == PolarityMode::difference) continue;  // dense images refuse it
    d = asked(
        a, b, [=](Scarf& s) { return s.u8_image(asked_mode); }, images("u8"));
    if (!d || *d) return d;
    d = asked(
        a, b, [=](Scarf& s) { return s.float_image(asked_mode); }, images("float"));
    if (!d || *d) return d;
  }

  constexpr std::pair<EventOrder, const char*> kOrders[] = {{EventOrder::by_patch, "active events by patch,"},
                                                            {EventOrder::by_time, "active events by time,"}};
  for (const auto& [order, what] : kOrders) {
    const auto lists = [&, name = what](const auto& x, const auto& y) {
      return list_difference(name, x, y, names);
    };
    d = asked(
        a, b, [order = order](Scarf& s) { return s.active_events(order); }, lists);
    if (!d || *d) return d;
  }
  return Difference();
}

}  // namespace scarf::tools
