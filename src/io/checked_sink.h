// What the writers of all formats share: the check of every event before it is written.
#pragma once

#include <span>

#include "io/byte_writer.h"
#include "io/event_check.h"
#include "scarf/io.h"

namespace scarf {

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
  uint64_t count() const { return check_.count(); }

  ByteWriter output_;

 private:
  EventCheck check_;
};

}  // namespace scarf
