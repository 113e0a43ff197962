// Every representation in every variant, and what its tests share.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "scarf/reference/reference.h"
#include "tests/support/same.h"

namespace scarf::test {

struct Case {
  std::string label;  ///< letters, digits and underscores: a name for a parameterised test
  Parameters parameters;

  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.label; }
};

/// Every representation with every rule and option, and its parameters at the ends of their ranges. The two
/// presets event_driven of scarf need a sensor of 20x20 pixels, the rest are on any sensor.
inline std::vector<Case> representation_cases() {
  using Decay = SaeParameters::Decay;
  using Sits = SitsParameters::Rule;
  using Chain = ChainSaeParameters::Rule;
  return {
      {"scarf_paper", ScarfParameters{}},
      {"scarf_paper_narrow", ScarfParameters{Preset::paper, {5, 0.4, 0.5}, 0.7}},
      {"scarf_light", ScarfParameters{Preset::light, {}}},
      {"scarf_event_driven", ScarfParameters{Preset::event_driven, {}}},
      {"scarf_event_driven_flex", ScarfParameters{Preset::event_driven_flex, {}}},
      {"time_window", TimeWindowParameters{}},
      {"time_window_tiny", TimeWindowParameters{.window = 1}},
      {"time_window_long", TimeWindowParameters{.window = 100'000'000}},
      {"time_window_counts", TimeWindowParameters{.counts = true}},
      {"time_window_counts_tiny", TimeWindowParameters{.window = 1, .counts = true, .accumulation = 1}},
      {"time_window_counts_long",
       TimeWindowParameters{.window = 100'000'000, .counts = true, .accumulation = 0.001}},
      {"sae", SaeParameters{}},
      {"sae_tiny", SaeParameters{.tau = 1}},
      {"sae_long", SaeParameters{.tau = 10'000'000}},
      {"sae_coarse", SaeParameters{.tau = 100'003}},  // steps of 12 us
      {"sae_linear", SaeParameters{.decay = Decay::linear}},
      {"sae_linear_tiny", SaeParameters{.decay = Decay::linear, .tau = 1}},
      {"sae_linear_odd", SaeParameters{.decay = Decay::linear, .tau = 777}},
      {"sae_linear_long", SaeParameters{.decay = Decay::linear, .tau = 10'000'000}},
      {"eros", ErosParameters{}},
      {"eros_k3", ErosParameters{.kernel = 3, .decay = 0.01}},
      {"eros_k13", ErosParameters{.kernel = 13, .decay = 0.99}},
      {"eros_even", ErosParameters{.kernel = 6, .decay = 0.5}},
      {"eros_k63", ErosParameters{.kernel = 63, .decay = 0.3}},
      {"tos", TosParameters{}},
      {"tos_k3", TosParameters{.kernel = 3, .decay = 84.9}},
      {"tos_k13", TosParameters{.kernel = 13, .decay = 0.1}},
      {"tos_even", TosParameters{.kernel = 6, .decay = 4.25}},
      {"tos_k63", TosParameters{.kernel = 63, .decay = 4}},
      {"sits", SitsParameters{}},
      {"sits_k3", SitsParameters{.kernel = 3}},
      {"sits_k13", SitsParameters{.kernel = 13}},
      {"sits_even", SitsParameters{.kernel = 6}},
      {"sits_k63", SitsParameters{.kernel = 63}},
      {"sits_greater", SitsParameters{.rule = Sits::greater}},
      {"sits_greater_k3", SitsParameters{.rule = Sits::greater, .kernel = 3}},
      {"sits_greater_k13", SitsParameters{.rule = Sits::greater, .kernel = 13}},
      {"sits_greater_even", SitsParameters{.rule = Sits::greater, .kernel = 6}},
      {"sits_event_driven", SitsParameters{.rule = Sits::event_driven}},
      {"sits_event_driven_k3", SitsParameters{.rule = Sits::event_driven, .kernel = 3}},
      {"sits_event_driven_k13", SitsParameters{.rule = Sits::event_driven, .kernel = 13}},
      {"sits_event_driven_k17", SitsParameters{.rule = Sits::event_driven, .kernel = 17}},  // 289 > 255
      {"sits_event_driven_even", SitsParameters{.rule = Sits::event_driven, .kernel = 6}},
      {"chain_sae", ChainSaeParameters{}},
      {"chain_sae_linear", ChainSaeParameters{.linear = true}},
      {"chain_sae_event_driven", ChainSaeParameters{.rule = Chain::event_driven}},
      {"chain_sae_event_driven_linear", ChainSaeParameters{.rule = Chain::event_driven, .linear = true}},
      {"aed_sae", AedSaeParameters{}},
      {"aed_sae_tiny", AedSaeParameters{.window = 1'000, .lambda = 2.5}},
      {"aed_sae_long", AedSaeParameters{.window = 100'000'000, .lambda = 1e-3}},
      {"aae", AaeParameters{}},
      {"aae_keep", AaeParameters{.keep = true}},
      {"aae_block1", AaeParameters{.block = 1}},
      {"aae_block7", AaeParameters{.block = 7}},
      {"aae_block_beyond_sensor", AaeParameters{.block = 1024}},
      {"aae_block_beyond_sensor_keep", AaeParameters{.block = 1024, .keep = true}},
      {"aae_esvo2", AaeParameters{.esvo2 = true}},
      {"aae_esvo2_keep", AaeParameters{.keep = true, .esvo2 = true}},
  };
}

inline Event event(int64_t t, int32_t x, int32_t y = 0, uint8_t p = 1) {
  return {t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), p};
}

/// The reference, with some events pushed as one batch.
inline std::unique_ptr<Representation> reference(const Parameters& parameters, SensorSize sensor,
                                                 const std::vector<Event>& events = {}) {
  auto made = make_reference_representation(parameters, sensor);
  if (!made) {
    ADD_FAILURE() << made.error().message;
    return nullptr;
  }
  EXPECT_TRUE((*made)->push(events).ok());
  return std::move(*made);
}

inline std::vector<uint8_t> u8_of(Representation& r, std::optional<int64_t> now = {}) {
  return value_of(r.u8_image(now)).pixels;
}
inline std::vector<float> float_of(Representation& r, std::optional<int64_t> now = {}) {
  return value_of(r.float_image(now)).pixels;
}
inline std::vector<int64_t> raw_of(Representation& r) {
  return value_of(r.raw_image()).pixels;
}

/// Asks both for everything, in the same order, and expects the same bits.
inline void expect_same_outputs(Representation& a, Representation& b, std::optional<int64_t> now = {}) {
  ASSERT_EQ(value_of(a.state()), value_of(b.state()));
  ASSERT_EQ(value_of(a.u8_image(now)), value_of(b.u8_image(now)));
  ASSERT_EQ(value_of(a.state()), value_of(b.state()));
  const Image<float> fa = value_of(a.float_image(now));
  const Image<float> fb = value_of(b.float_image(now));
  ASSERT_EQ(fa.width, fb.width);
  ASSERT_EQ(fa.pixels.size(), fb.pixels.size());
  for (size_t i = 0; i < fa.pixels.size(); ++i) {
    ASSERT_EQ(std::bit_cast<uint32_t>(fa.pixels[i]), std::bit_cast<uint32_t>(fb.pixels[i]))
        << "pixel " << i << ": " << fa.pixels[i] << " and " << fb.pixels[i];
  }
  ASSERT_EQ(value_of(a.raw_image()), value_of(b.raw_image()));
  const auto events_a = a.events().wait();
  const auto events_b = b.events().wait();
  ASSERT_EQ(events_a.ok(), events_b.ok());
  if (events_a) {
    ASSERT_EQ(*events_a, *events_b);
  }
  ASSERT_EQ(value_of(a.state()), value_of(b.state()));
}

/// The bytes of a state, put together by hand.
class StateBytes {
 public:
  template <class T>
  StateBytes& add(T value) {
    for (size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(static_cast<uint8_t>(static_cast<uint64_t>(value) >> (8 * i)));
    }
    return *this;
  }
  StateBytes& add(const Event& e) { return add(e.t).add(e.x).add(e.y).add(e.p); }
  template <class T>
  StateBytes& add(const std::vector<T>& values) {
    for (const T& value : values) add(value);
    return *this;
  }
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<uint8_t> bytes_;
};

}  // namespace scarf::test
