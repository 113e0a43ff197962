// SCARF, as defined: patches with circular buffers of their last N events, of which the active ones are
// shown. Source: "An Event Preserving Velocity Invariant Representation for Event Cameras", 2026.
#include <Eigen/Core>
#include <mutex>

#include "core/batch_check.h"
#include "core/queries.h"
#include "scarf/reference/reference.h"

namespace scarf {
namespace {

template <class T>
using Plane = Eigen::Array<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class ReferenceScarf final : public Scarf {
 public:
  ReferenceScarf(const Geometry& geometry, const Levels& levels)
      : geometry_(geometry),
        u8_levels_(
            Eigen::Map<const Eigen::Array<uint8_t, Eigen::Dynamic, 1>>(levels.u8.data(), levels.u8.size())),
        f32_levels_(Eigen::Map<const Eigen::ArrayXf>(levels.f32.data(), levels.f32.size())),
        totals_(geometry.patches(), 0),
        slots_(geometry.patches() * geometry.capacity) {}

  const Geometry& geometry() const override { return geometry_; }

  Result<PushReport> push(std::span<const Event> events) override {
    return locked([&]() -> Result<PushReport> {
      const auto batch = check_batch(events, geometry_.sensor(), t_first_);
      if (!batch) return batch.error();
      t_first_ = batch->t_first;
      for (const Event& e : events) {
        if (geometry_.sensor().contains(e)) store(e);
      }
      return PushReport{events.size(), batch->outside};
    });
  }

  Result<void> reset() override {
    std::lock_guard lock(mutex_);
    totals_.assign(totals_.size(), 0);
    slots_.assign(slots_.size(), Event{});
    t_first_.reset();
    return {};
  }

  Pending<Image<int32_t>> count_image(PolarityMode mode) override {
    return locked([&]() -> Pending<Image<int32_t>> {
      return image<int32_t>(mode, [](int32_t count) { return count; });
    });
  }

  Pending<Image<uint8_t>> u8_planes(PolarityMode mode) override {
    return locked([&]() -> Pending<Image<uint8_t>> {
      if (auto r = check_dense_mode(mode); !r) return r.error();
      return image<uint8_t>(mode, [this](int32_t count) { return u8_levels_(count); });
    });
  }

  Pending<Image<float>> float_planes(PolarityMode mode) override {
    return locked([&]() -> Pending<Image<float>> {
      if (auto r = check_dense_mode(mode); !r) return r.error();
      return image<float>(mode, [this](int32_t count) { return f32_levels_(count); });
    });
  }

  Pending<std::vector<Event>> active_events(EventOrder order) override {
    return locked([&]() -> Pending<std::vector<Event>> {
      std::vector<Event> events;
      for (size_t patch = 0; patch < totals_.size(); ++patch) append(patch, /*active_only=*/true, events);
      return ordered(std::move(events), order);
    });
  }

  Pending<std::vector<Event>> patch_events(int64_t patch, bool active_only) override {
    return locked([&]() -> Pending<std::vector<Event>> {
      if (auto r = check_patch(geometry_, patch); !r) return r.error();
      std::vector<Event> events;
      append(patch, active_only, events);
      return events;
    });
  }

  Pending<Snapshot> snapshot() override {
    return locked([&]() -> Pending<Snapshot> { return Snapshot{geometry_, totals_, slots_}; });
  }

 private:
  template <class Call>
  std::invoke_result_t<Call&> locked(Call call) {
    return as_result([&] {
      std::lock_guard lock(mutex_);
      return call();
    });
  }

  // The update rule: every patch whose field holds the event overwrites its oldest slot.
  void store(const Event& e) {
    const PatchRange columns = geometry_.x.patches_holding(e.x);
    const PatchRange rows = geometry_.y.patches_holding(e.y);
    for (int32_t j = rows.first; j <= rows.last; ++j) {
      for (int32_t i = columns.first; i <= columns.last; ++i) {
        const size_t patch = static_cast<size_t>(j) * geometry_.x.grid + i;
        slots_[patch * geometry_.capacity + totals_[patch] % geometry_.capacity] = e;
        totals_[patch] += 1;
      }
    }
  }

  bool active(size_t patch, const Event& e) const {
    return geometry_.x.active(e.x, static_cast<int32_t>(patch % geometry_.x.grid)) &&
           geometry_.y.active(e.y, static_cast<int32_t>(patch / geometry_.x.grid));
  }

  // Events of a patch, oldest to newest.
  void append(size_t patch, bool active_only, std::vector<Event>& out) const {
    const uint64_t total = totals_[patch];
    const uint64_t capacity = geometry_.capacity;
    for (uint64_t n = total > capacity ? total - capacity : 0; n < total; ++n) {
      const Event& e = slots_[patch * capacity + n % capacity];
      if (!active_only || active(patch, e)) out.push_back(e);
    }
  }

  // Counts the active stored events of each pixel and maps them by `level`.
  template <class T, class Level>
  Image<T> image(PolarityMode mode, Level level) const {
    const int32_t planes = mode == PolarityMode::separate ? 2 : 1;
    const int32_t height = geometry_.y.size;
    Plane<int32_t> counts = Plane<int32_t>::Zero(int64_t{planes} * height, geometry_.x.size);
    for (size_t patch = 0; patch < totals_.size(); ++patch) {
      const uint64_t filled = std::min<uint64_t>(totals_[patch], geometry_.capacity);
      for (uint64_t slot = 0; slot < filled; ++slot) {
        const Event& e = slots_[patch * geometry_.capacity + slot];
        if (!active(patch, e)) continue;
        const int32_t plane = mode == PolarityMode::separate ? e.p : 0;
        counts(plane * height + e.y, e.x) += mode == PolarityMode::difference && e.p == 0 ? -1 : 1;
      }
    }
    Image<T> image(geometry_.x.size, height, planes);
    Eigen::Map<Plane<T>>(image.pixels.data(), counts.rows(), counts.cols()) = counts.unaryExpr(level);
    return image;
  }

  const Geometry geometry_;
  const Eigen::Array<uint8_t, Eigen::Dynamic, 1> u8_levels_;
  const Eigen::ArrayXf f32_levels_;
  std::mutex mutex_;
  std::optional<int64_t> t_first_;
  std::vector<uint64_t> totals_;
  std::vector<Event> slots_;  // patch-major
};

}  // namespace

Result<std::unique_ptr<Scarf>> make_reference_scarf(const Geometry& geometry, double accumulation) {
  return as_result([&]() -> Result<std::unique_ptr<Scarf>> {
    const auto checked = checked_geometry(geometry);
    if (!checked) return checked.error();
    const auto levels = make_levels(accumulation, geometry.capacity);
    if (!levels) return levels.error();
    return std::unique_ptr<Scarf>(std::make_unique<ReferenceScarf>(*checked, *levels));
  });
}

}  // namespace scarf
