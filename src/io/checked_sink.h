// What the writers of all formats share: the check of every event before it is written.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "io/byte_writer.h"
#include "scarf/io.h"

namespace scarf {

/// What a format can hold.
struct WriteLimits {
  std::string_view format;
  int64_t t_min = std::numeric_limits<int64_t>::min();  ///< the earliest time ...
  int64_t t_end = std::numeric_limits<int64_t>::max();  ///< ... and the first one too late
  bool back_steps = false;                              ///< whether a time may be before the one before it
  int32_t max_coordinate = std::numeric_limits<uint16_t>::max();
};

class CheckedSink : public EventSink {
 public:
  CheckedSink(ByteWriter output, SensorSize sensor, const WriteLimits& limits);

  Result<void> write(std::span<const Event> events) final;
  Result<void> finish() final;

 protected:
  /// Appends events that were checked to output_.
  virtual void encode(std::span<const Event> events) = 0;
  /// What is left to do before output_ is finished. Errors: io.
  virtual Result<void> complete() { return {}; }
  /// Events encoded so far.
  uint64_t count() const { return count_; }

  ByteWriter output_;

 private:
  std::string_view objection(const Event& event) const;

  SensorSize sensor_;
  WriteLimits limits_;
  uint64_t count_ = 0;
  int64_t previous_t_;
};

}  // namespace scarf
