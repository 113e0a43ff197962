#include "compare/compare_states.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/block_grid.h"
#include "core/text.h"
#include "cpu_ref/aae.h"

namespace scarf {
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
template <class R, class Ask, class Compare>
Result<Difference> asked(R& a, R& b, Ask ask, Compare compare) {
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

namespace {

Result<Difference> scarf_difference(Scarf& a, Scarf& b, const SideNames& names) {
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
        a, b, [=](Scarf& s) { return s.u8_planes(asked_mode); }, images("u8"));
    if (!d || *d) return d;
    d = asked(
        a, b, [=](Scarf& s) { return s.float_planes(asked_mode); }, images("float"));
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

using Bytes = std::vector<uint8_t>;

Result<Difference> state_difference(Representation& a, Representation& b, const SideNames& names) {
  const auto compare = [&](const Bytes& x, const Bytes& y) -> Difference {
    const auto [in_x, in_y] = std::mismatch(x.begin(), x.end(), y.begin(), y.end());
    if (in_x == x.end() && in_y == y.end()) return std::nullopt;
    return text("state, from byte ", in_x - x.begin(), " on (", values(x.size(), y.size(), names), " bytes)");
  };
  return asked(
      a, b, [](Representation& r) { return r.state(); }, compare);
}

Result<Difference> representation_difference(Representation& a, Representation& b, const SideNames& names) {
  const auto images = [&](const char* what) {
    return [&names, what](const auto& x, const auto& y) { return image_difference(what, x, y, names); };
  };
  auto d = state_difference(a, b, names);
  if (!d || *d) return d;
  d = asked(
      a, b, [](Representation& r) { return r.u8_image(); }, images("u8 image"));
  if (!d || *d) return d;
  d = asked(
      a, b, [](Representation& r) { return r.float_image(); }, images("float image"));
  if (!d || *d) return d;
  d = asked(
      a, b, [](Representation& r) { return r.raw_image(); }, images("raw image"));
  if (!d || *d) return d;
  return asked(
      a, b, [](Representation& r) { return r.filter_reports(); },
      [](const auto& x, const auto& y) {
        return x == y ? Difference() : Difference("reports of the filters");
      });
}

Result<Difference> intolerable_difference(Representation& a, Representation& b, const SideNames& names,
                                          Tolerance& tolerance) {
  if (tolerance.exact_state()) {
    auto d = state_difference(a, b, names);
    if (!d || *d) return d;
  }
  if (auto r = tolerance.prepare(a); !r) return r.error();
  return asked(
      a, b, [](Representation& r) { return r.u8_image(); },
      [&](const Image<uint8_t>& x, const Image<uint8_t>& y) {
        return tolerance.accepts(x, y) ? Difference() : image_difference("u8 image", x, y, names);
      });
}

}  // namespace

Result<Difference> first_difference(Representation& a, Representation& b, const SideNames& names,
                                    Tolerance* tolerance) {
  auto* const scarf_a = dynamic_cast<Scarf*>(&a);
  auto* const scarf_b = dynamic_cast<Scarf*>(&b);
  if (scarf_a != nullptr && scarf_b != nullptr) return scarf_difference(*scarf_a, *scarf_b, names);
  if (tolerance != nullptr) return intolerable_difference(a, b, names, *tolerance);
  return representation_difference(a, b, names);
}

Tolerance::Tolerance(const Parameters& parameters, SensorSize sensor)
    : parameters_(parameters), sensor_(sensor) {}

Result<void> Tolerance::prepare(Representation& reference) {
  const auto* aae = std::get_if<AaeParameters>(&parameters_);
  if (aae == nullptr) return {};
  const auto events = reference.events().wait();
  if (!events) return events.error();
  const BlockGrid grid = block_grid(*aae, sensor_);
  // A block that once was close may have another queue ever since.
  close_.resize(grid.blocks(), false);
  for (auto begin = events->begin(); begin != events->end();) {
    const size_t block = grid.block_of(*begin);
    const auto end =
        std::find_if(begin, events->end(), [&](const Event& e) { return grid.block_of(e) != block; });
    const std::span<const Event> queue(begin, end);
    const bool close = aae->esvo2 ? walk_block_esvo2(queue).close : walk_block(queue).close;
    close_blocks_ += close ? 1 : 0;
    close_[block] = close_[block] || close;
    begin = end;
  }
  return {};
}

bool Tolerance::accepts(const Image<uint8_t>& a, const Image<uint8_t>& b) {
  if (a.pixels.size() != b.pixels.size()) return false;
  const auto* aae = std::get_if<AaeParameters>(&parameters_);
  uint64_t different = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (a.pixels[i] == b.pixels[i]) continue;
    ++different;
    if (aae == nullptr) {
      if (std::abs(a.pixels[i] - b.pixels[i]) > 1) return false;
    } else {
      Event e;
      e.x = static_cast<uint16_t>(i % sensor_.width);
      e.y = static_cast<uint16_t>(i / sensor_.width);
      if (!close_[block_grid(*aae, sensor_).block_of(e)]) return false;
    }
  }
  pixels_ += different;
  worst_pixels_ = std::max(worst_pixels_, different);
  return aae != nullptr || different * 1000 <= a.pixels.size();
}

std::string Tolerance::report() const {
  if (std::holds_alternative<AaeParameters>(parameters_)) {
    return text(close_blocks_, " tests within 1e-9 of their threshold, ", pixels_, " pixels differed there");
  }
  return text("at most ", worst_pixels_, " of ", int64_t{sensor_.width} * sensor_.height,
              " pixels of a picture differed, by one level");
}

}  // namespace scarf
