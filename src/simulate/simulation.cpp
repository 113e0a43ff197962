#include "simulate/simulation.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "core/text.h"
#include "simulate/pixel.h"
#include "simulate/random.h"
#include "simulate/view.h"

namespace scarf {
namespace simulate {
namespace {

constexpr double kMaxMovement = 1.0 / 3;  // pixels per step
constexpr int64_t kMaxStep = 10'000;  // microseconds; bounds the events of a step where only noise happens
constexpr double kHotPixelHz[] = {50, 500};

// Pixels that fire by chance at a rate.
struct Source {
  double rate;        // per second; 0: never
  double next;        // seconds
  int32_t pixel = 0;  // of a hot pixel
};

class SceneSimulation final : public Simulation {
 public:
  SceneSimulation(const SimulationOptions& options, Scene scene)
      : options_(options),
        duration_(static_cast<int64_t>(options.duration_s * 1e6 + 0.5)),
        view_(options.sensor, std::move(scene)),
        logs_(log_table()),
        noise_random_(options.seed, 1),
        hot_random_(options.seed, 2) {
    view_.render(view_.whole(), 0, intensity_);
    make_pixels();
    make_noise();
  }

  const SimulationOptions& options() const override { return options_; }
  int64_t time() const override { return time_; }
  int64_t duration() const override { return duration_; }

  std::span<const Event> next() override {
    events_.clear();
    if (finished()) return events_;
    const int64_t end = std::min(time_ + step(), duration_);
    add_noise(end);
    for (const Box& box : view_.changed(seconds(time_), seconds(end))) follow(box, end);
    std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
      return std::tie(a.t, a.y, a.x) < std::tie(b.t, b.y, b.x);
    });
    time_ = end;
    return events_;
  }

  Image<uint8_t> frame(int64_t t_us) const override {
    std::vector<uint16_t> intensity;
    View(view_).render(view_.whole(), seconds(t_us), intensity);
    Image<uint8_t> image(options_.sensor.width, options_.sensor.height);
    std::transform(intensity.begin(), intensity.end(), image.pixels.begin(),
                   [](uint16_t i) { return static_cast<uint8_t>((i * 255 + 32'767) / 65'535); });
    return image;
  }

  Image<uint8_t> edges(int64_t t_us) const override { return view_.edges(seconds(t_us)); }

 private:
  static double seconds(int64_t t_us) { return static_cast<double>(t_us) / 1e6; }

  void make_pixels() {
    Random random(options_.seed, 0);
    const auto threshold = [&] {
      const double part = std::max(0.2, 1 + options_.mismatch * random.normal());
      return static_cast<int32_t>(std::nearbyint(options_.threshold * part * kLogUnit));
    };
    pixels_.reserve(intensity_.size());
    for (const uint16_t i : intensity_) {
      const int32_t on = threshold();
      const int32_t off = threshold();
      pixels_.emplace_back(logs_[i], on, off);
    }
  }

  void make_noise() {
    const auto count = static_cast<int32_t>(pixels_.size());
    noise_.rate = options_.noise_hz * count;
    noise_.next = noise_.rate > 0 ? noise_random_.interval(noise_.rate) : 0;
    std::vector<bool> taken(count);
    while (static_cast<int32_t>(hot_.size()) < options_.hot_pixels) {
      const int32_t pixel = hot_random_.below(count);
      if (taken[pixel]) continue;
      taken[pixel] = true;
      const double rate = kHotPixelHz[0] + (kHotPixelHz[1] - kHotPixelHz[0]) * hot_random_.uniform();
      hot_.push_back({rate, hot_random_.interval(rate), pixel});
    }
  }

  int64_t step() const {
    const double longest = view_.scene().longest_step(seconds(time_), kMaxMovement) * 1e6;
    if (longest >= static_cast<double>(kMaxStep)) return kMaxStep;
    return std::max<int64_t>(1, static_cast<int64_t>(longest));
  }

  // The pixels of a box see what happens until `end`.
  void follow(Box box, int64_t end) {
    view_.render(box, seconds(end), rendered_);
    size_t i = 0;
    for (int32_t y = box.y0; y < box.y1; ++y) {
      for (int32_t x = box.x0; x < box.x1; ++x, ++i) {
        const size_t at = static_cast<size_t>(y) * options_.sensor.width + x;
        if (intensity_[at] == rendered_[i]) continue;
        const Segment segment = {time_, end, logs_[intensity_[at]], logs_[rendered_[i]]};
        pixels_[at].follow(segment, options_.refractory_us, [&](int64_t t, bool on) {
          events_.push_back({t, static_cast<uint16_t>(x), static_cast<uint16_t>(y), on});
        });
        intensity_[at] = rendered_[i];
      }
    }
  }

  // Noise comes first in a step, so that its refractory time holds for the crossings of the step.
  void add_noise(int64_t end) {
    for (; noise_.rate > 0 && due(noise_) <= end; noise_.next += noise_random_.interval(noise_.rate)) {
      fire(noise_random_.below(static_cast<int32_t>(pixels_.size())), due(noise_), noise_random_);
    }
    for (Source& hot : hot_) {
      for (; due(hot) <= end; hot.next += hot_random_.interval(hot.rate))
        fire(hot.pixel, due(hot), hot_random_);
    }
  }

  static int64_t due(const Source& source) { return static_cast<int64_t>(source.next * 1e6) + 1; }

  void fire(int32_t pixel, int64_t t, Random& random) {
    const auto on = static_cast<uint8_t>(random.below(2));
    if (!pixels_[pixel].fire(t, options_.refractory_us)) return;
    const int32_t width = options_.sensor.width;
    events_.push_back({t, static_cast<uint16_t>(pixel % width), static_cast<uint16_t>(pixel / width), on});
  }

  const SimulationOptions options_;
  const int64_t duration_;
  View view_;
  const std::vector<int32_t> logs_;
  Random noise_random_;
  Random hot_random_;
  Source noise_ = {};
  std::vector<Source> hot_;
  std::vector<Pixel> pixels_;
  std::vector<uint16_t> intensity_;  // what each pixel saw at time_
  std::vector<uint16_t> rendered_;
  std::vector<Event> events_;
  int64_t time_ = 0;
};

}  // namespace

std::unique_ptr<Simulation> simulate_scene(const SimulationOptions& options, Scene scene) {
  return std::make_unique<SceneSimulation>(options, std::move(scene));
}

}  // namespace simulate

namespace {

template <class T>
Result<void> check_range(std::string_view name, T value, std::type_identity_t<T> low,
                         std::type_identity_t<T> high) {
  if (value >= low && value <= high) return {};
  return Error{ErrorCode::illegal_parameter, text(name, " is ", value, ", legal is ", low, " to ", high)};
}

Result<void> check(const SimulationOptions& o) {
  if (auto r = check_range("sensor width", o.sensor.width, 16, 4096); !r) return r;
  if (auto r = check_range("sensor height", o.sensor.height, 16, 4096); !r) return r;
  if (auto r = check_range("duration", o.duration_s, 1e-6, 86'400); !r) return r;
  if (auto r = check_range("threshold", o.threshold, 0.01, 5); !r) return r;
  if (auto r = check_range("mismatch", o.mismatch, 0, 0.3); !r) return r;
  if (auto r = check_range("refractory", o.refractory_us, 0, 1'000'000); !r) return r;
  if (auto r = check_range("noise", o.noise_hz, 0, 1000); !r) return r;
  return check_range("hot pixels", o.hot_pixels, 0, o.sensor.width * o.sensor.height);
}

}  // namespace

Result<std::unique_ptr<Simulation>> make_simulation(const SimulationOptions& options) {
  return as_result([&]() -> Result<std::unique_ptr<Simulation>> {
    if (auto r = check(options); !r) return r.error();
    const simulate::SceneMaker make_scene = simulate::scene_maker(options.scene);
    if (make_scene == nullptr) {
      std::string names;
      for (const auto name : scene_names()) names += (names.empty() ? "" : ", ") + std::string(name);
      return Error{ErrorCode::illegal_parameter, text("scene is '", options.scene, "', legal is ", names)};
    }
    return simulate::simulate_scene(options, make_scene(options.sensor, options.duration_s));
  });
}

std::vector<std::string_view> scene_names() {
  return simulate::names();
}

}  // namespace scarf
