// AED-SAE (surface of active events with an adaptive exponential decay), as defined: how fast the surface
// decays follows from how densely the recent events lie.
#include <Eigen/Core>
#include <deque>
#include <new>
#include <unsupported/Eigen/FFT>

#include "cpu_ref/references.h"
#include "cpu_ref/surface.h"

namespace scarf {
namespace {

using Plane = Eigen::ArrayXXd;      // height x width
using Spectrum = Eigen::ArrayXXcd;  // height x width

constexpr double kDense = 0.001;  // filtered value above which a pixel counts

// A Gaussian of `length` samples around their centre, with the sum 1.
Eigen::ArrayXd gaussian(Eigen::Index length) {
  if (length == 1) return Eigen::ArrayXd::Ones(1);  // whose sigma would be 0
  const auto sigma = static_cast<double>(length / 2);
  Eigen::ArrayXd kernel(length);
  for (Eigen::Index i = 0; i < length; ++i) {
    const double distance = static_cast<double>(i) - static_cast<double>(length - 1) / 2;
    kernel(i) = std::exp(-distance * distance / (2 * sigma * sigma));
  }
  return kernel / kernel.sum();
}

// Exchanges the quadrants; an odd last row or column stays.
void swap_quadrants(Plane& plane) {
  const Eigen::Index rows = plane.rows() / 2;
  const Eigen::Index columns = plane.cols() / 2;
  plane.block(0, 0, rows, columns).swap(plane.block(rows, columns, rows, columns));
  plane.block(0, columns, rows, columns).swap(plane.block(rows, 0, rows, columns));
}

// What the spectrum of the events is multiplied by.
Plane make_filter(SensorSize sensor) {
  const Plane product =
      (gaussian(sensor.height).matrix() * gaussian(sensor.width).matrix().transpose()).array();
  Plane filter = product.maxCoeff() - product;
  swap_quadrants(filter);
  return filter;
}

class AedSae final : public ValueSurface {
 public:
  AedSae(const AedSaeParameters& parameters, SensorSize sensor)
      : ValueSurface(sensor),
        window_(parameters.window),
        lambda_(parameters.lambda),
        filter_(make_filter(sensor)),
        last_(pixels(), kNeverFired) {
    prepare();
  }

 private:
  void update(const Event& e) override {
    if (!received_.empty() && e.t < received_.front().t) clear();
    t_max_ = std::max(t_max_, e.t);
    last_[pixel(e)] = e.t;
    received_.push_back(e);
    // Times may step back, so there can be more such events further behind; listed() leaves them out.
    while (too_old(received_.front())) received_.pop_front();
  }

  void clear() override {
    t_max_ = kNeverFired;
    last_.assign(pixels(), kNeverFired);
    received_.clear();
  }

  void prepare() {
    fft_ = {};
    fft_.SetFlag(Eigen::FFT<double>::Unscaled);
  }

  bool too_old(const Event& e) const { return age_of(e.t, t_max_) > window_; }

  std::vector<Event> listed() const {
    std::vector<Event> events;
    for (const Event& e : received_) {
      if (!too_old(e)) events.push_back(e);
    }
    return events;
  }

  std::vector<double> values(std::optional<int64_t>) override {
    const std::vector<Event> events = listed();
    std::vector<double> values(pixels(), 0);
    if (events.empty()) return values;
    const Eigen::Index dense = (filtered(events) > kDense).count();
    // Microseconds in which a pixel falls to 1/e.
    const double decay = lambda_ * static_cast<double>(window_) * static_cast<double>(dense) /
                         static_cast<double>(events.size());
    for (size_t i = 0; i < pixels(); ++i) {
      if (last_[i] == kNeverFired) continue;
      const uint64_t age = age_of(last_[i], t_max_);
      if (dense == 0)
        values[i] = age == 0 ? 1 : 0;
      else
        values[i] = std::exp(-std::pow(static_cast<double>(age) / decay, 6.0));
    }
    return values;
  }

  // The pixels in the list, filtered.
  Plane filtered(const std::vector<Event>& events) {
    Spectrum plane = Spectrum::Zero(sensor().height, sensor().width);
    for (const Event& e : events) plane(e.y, e.x) = 1;
    try {
      transform(plane, /*inverse=*/false);
      plane *= filter_;
      transform(plane, /*inverse=*/true);
    } catch (const std::bad_alloc&) {
      prepare();  // Eigen would go on with what it has half prepared
      throw;
    }
    return plane.real();
  }

  // The discrete Fourier transform in two dimensions, or its inverse without a scale: by column, then by row.
  void transform(Spectrum& plane, bool inverse) {
    for (const bool by_row : {false, true}) {
      if (by_row) plane.transposeInPlace();
      if (plane.rows() > 1) {
        for (Eigen::Index i = 0; i < plane.cols(); ++i) {
          const Eigen::VectorXcd from = plane.col(i).matrix();
          Eigen::VectorXcd to;
          if (inverse)
            fft_.inv(to, from);
          else
            fft_.fwd(to, from);
          plane.col(i) = to.array();
        }
      }
      if (by_row) plane.transposeInPlace();
    }
  }

  Image<int64_t> raw_picture() override { return raw(last_); }

  std::vector<uint8_t> state_bytes() const override {
    const std::vector<Event> events = listed();
    std::vector<uint8_t> bytes;
    append_little_endian(bytes, t_max_);
    append_all(bytes, last_);
    append_list(bytes, events);
    return bytes;
  }

  const uint64_t window_;  // microseconds
  const double lambda_;
  const Plane filter_;
  Eigen::FFT<double> fft_;
  int64_t t_max_ = kNeverFired;  // the largest time since the list was last cleared
  std::vector<int64_t> last_;
  std::deque<Event> received_;  // in order of arrival; the first one is listed
};

}  // namespace

Reference make_reference(const AedSaeParameters& parameters, SensorSize sensor) {
  return std::make_unique<AedSae>(parameters, sensor);
}

}  // namespace scarf
