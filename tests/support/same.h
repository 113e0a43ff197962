// Whether two implementations are in the same state, down to the last bit of everything that they hand out.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>

#include "scarf/core/patch_state.h"

namespace scarf::test {

/// The value; an error fails the test, and ends it.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}
template <class T>
T value_of(Pending<T> pending) {
  return value_of(pending.wait());
}

/// Totals and slots.
inline void expect_same_state(Scarf& device, Scarf& reference) {
  const Snapshot a = value_of(device.snapshot());
  const Snapshot b = value_of(reference.snapshot());
  ASSERT_EQ(a.totals, b.totals);
  ASSERT_EQ(a.slots.size(), b.slots.size());
  for (size_t i = 0; i < b.slots.size(); ++i) {
    ASSERT_EQ(a.slots[i], b.slots[i])
        << "patch " << i / b.geometry.capacity << " slot " << i % b.geometry.capacity;
  }
}

/// Totals, slots, images in every mode, event lists and patch queries.
inline void expect_same(Scarf& device, Scarf& reference) {
  ASSERT_NO_FATAL_FAILURE(expect_same_state(device, reference));
  for (PolarityMode mode : {PolarityMode::merged, PolarityMode::separate, PolarityMode::difference}) {
    ASSERT_EQ(value_of(device.count_image(mode)), value_of(reference.count_image(mode)));
    if (mode == PolarityMode::difference) continue;
    ASSERT_EQ(value_of(device.u8_planes(mode)), value_of(reference.u8_planes(mode)));
    ASSERT_EQ(value_of(device.float_planes(mode)), value_of(reference.float_planes(mode)));
  }
  for (EventOrder order : {EventOrder::by_patch, EventOrder::by_time}) {
    ASSERT_EQ(value_of(device.active_events(order)), value_of(reference.active_events(order)));
  }
  const int64_t last = reference.geometry().patches() - 1;
  for (int64_t patch : {int64_t{0}, last / 2, last}) {
    for (bool active_only : {false, true}) {
      ASSERT_EQ(value_of(device.patch_events(patch, active_only)),
                value_of(reference.patch_events(patch, active_only)));
    }
  }
}

}  // namespace scarf::test
