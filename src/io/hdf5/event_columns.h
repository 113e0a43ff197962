// Events as columns of a file that is written: /events/x, y, p, t, and the size of the sensor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/hdf5/growing_dataset.h"
#include "scarf/core/event.h"
#include "scarf/core/result.h"

namespace scarf::hdf5 {

/// `Time`: the type of the column t.
template <class Time>
class EventColumns {
 public:
  /// Errors: io.
  static Result<EventColumns> create(const WrittenFile& file, SensorSize sensor) {
    EventColumns made;
    for (const auto& r :
         {column<uint16_t>(file, "events/x", made.x_), column<uint16_t>(file, "events/y", made.y_),
          column<uint8_t>(file, "events/p", made.p_), column<Time>(file, "events/t", made.t_),
          write_scalar(file, "events/width", int64_t{sensor.width}),
          write_scalar(file, "events/height", int64_t{sensor.height})}) {
      if (!r) return r.error();
    }
    return made;
  }

  /// The times are written as their distance from `origin`, which must fit. Errors: io.
  Result<void> append(std::span<const Event> events, int64_t origin) {
    if (auto r = append_as<uint16_t>(x_, events, [](const Event& e) { return e.x; }); !r) return r;
    if (auto r = append_as<uint16_t>(y_, events, [](const Event& e) { return e.y; }); !r) return r;
    if (auto r = append_as<uint8_t>(p_, events, [](const Event& e) { return e.p; }); !r) return r;
    return append_as<Time>(t_, events, [origin](const Event& e) { return static_cast<Time>(e.t - origin); });
  }

  /// Errors: io.
  Result<void> close() {
    for (GrowingDataset* dataset : {&x_, &y_, &p_, &t_}) {
      if (auto r = dataset->close(); !r) return r;
    }
    return {};
  }

 private:
  static constexpr size_t kRowsPerChunk = 64 * 1024;

  template <class T>
  static Result<void> column(const WrittenFile& file, const char* path, GrowingDataset& made) {
    auto dataset = GrowingDataset::create<T>(file, path, {}, kRowsPerChunk);
    if (!dataset) return dataset.error();
    made = *std::move(dataset);
    return {};
  }

  template <class T, class Member>
  static Result<void> append_as(GrowingDataset& dataset, std::span<const Event> events, Member member) {
    std::vector<T> values(events.size());
    for (size_t i = 0; i < events.size(); ++i) values[i] = member(events[i]);
    return dataset.append(std::span<const T>(values));
  }

  GrowingDataset x_;
  GrowingDataset y_;
  GrowingDataset p_;
  GrowingDataset t_;
};

}  // namespace scarf::hdf5
