// A simulated event camera that watches moving shapes: streams whose truth is known, for demonstrations and
// tests.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/image.h"
#include "scarf/core/result.h"

namespace scarf {

struct SimulationOptions {
  SensorSize sensor = {346, 260};  ///< 16 to 4096 per axis
  /// "stop": shapes of different speeds, of which one stops half-way through and stays.
  /// "speeds": bars of very different speeds, one per lane.
  /// "shake": a textured scene; the camera rests for the first half, then shakes.
  std::string scene = "stop";
  double duration_s = 2.0;      ///< > 0, at most 86,400
  double threshold = 0.25;      ///< change of log intensity per event; 0.01 to 5
  double mismatch = 0.03;       ///< standard deviation of the pixels' thresholds, as a part of them; 0 to 0.3
  int64_t refractory_us = 300;  ///< a pixel is blind for so long after each of its events; 0 to 1,000,000
  double noise_hz = 0.1;        ///< background activity per pixel; 0 to 1000
  int32_t hot_pixels = 0;       ///< pixels that fire all the time, 50 to 500 Hz each; 0 to number of pixels
  uint64_t seed = 1;            ///< of the sensor's imperfections; the scene is always the same
};

/// A simulation in progress. The same options give the same events on every platform. Times begin at 0 and
/// the memory in use does not depend on the duration.
class Simulation {
 public:
  virtual ~Simulation() = default;

  virtual const SimulationOptions& options() const = 0;
  /// End of the last step, in microseconds.
  virtual int64_t time() const = 0;
  virtual int64_t duration() const = 0;
  bool finished() const { return time() >= duration(); }

  /// Simulates one step and returns its events: later than the time() before, not later than the time()
  /// after, sorted by t, then y, then x. In a step nothing moves more than a third of a pixel. Empty when
  /// finished() and wherever nothing happens. The events are valid until the next call.
  virtual std::span<const Event> next() = 0;

  /// What an ordinary camera would see at time t_us: the intensity, 255 = white.
  virtual Image<uint8_t> frame(int64_t t_us) const = 0;
  /// The true outlines at time t_us: 255 where the visible outline of a shape crosses a pixel, 0 elsewhere.
  virtual Image<uint8_t> edges(int64_t t_us) const = 0;
};

/// Errors: illegal_parameter, naming the option, the value and the legal range.
Result<std::unique_ptr<Simulation>> make_simulation(const SimulationOptions& options);

/// The names that SimulationOptions::scene takes.
std::vector<std::string_view> scene_names();

}  // namespace scarf
