// Reader of N-MNIST and N-Caltech101: 40-bit events.
// Source: Orchard et al., "Converting Static Image Datasets to Spiking Neuromorphic Datasets Using Saccades",
// 2015; big-endian x, y, polarity (1 bit), time (23 bits).

#include <utility>

#include "io/base/buffered_source.h"
#include "io/base/known_formats.h"
#include "io/base/sensor_size.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "nmnist";
constexpr size_t kEventBytes = 5;
// A row that no sensor of these data sets has marks that the camera's clock has overflowed.
constexpr uint8_t kOverflowRow = 240;
constexpr int64_t kOverflowTime = 1 << 13;

class NmnistReader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return kName; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool /*last*/, std::span<Event> out) override {
    size_t count = 0;
    size_t at = 0;
    for (; count < out.size() && at + kEventBytes <= bytes.size(); at += kEventBytes) {
      const uint8_t* const e = bytes.data() + at;
      if (e[1] == kOverflowRow) {
        overflow_ += kOverflowTime;
        continue;
      }
      const int64_t t = (e[2] & 0x7F) << 16 | e[3] << 8 | e[4];
      out[count++] = {overflow_ + t, e[0], e[1], static_cast<uint8_t>(e[2] >> 7)};
    }
    return {at, tally_.keep(out.first(count)), count < out.size()};
  }

 private:
  int64_t overflow_ = 0;
};

Result<std::unique_ptr<EventSource>> open_nmnist(Input input, const ReadOptions& options) {
  const auto sensor = agreed_sensor(std::nullopt, options.sensor);
  if (!sensor) return sensor.error();
  return std::unique_ptr<EventSource>(
      std::make_unique<NmnistReader>(std::move(input.bytes), std::move(input.name), *sensor, options));
}

}  // namespace

const Format kNmnistFormat = {
    .name = kName, .title = "N-MNIST and N-Caltech101, 40-bit events", .open = open_nmnist};

}  // namespace scarf
