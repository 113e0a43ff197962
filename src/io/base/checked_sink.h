// What the writers of all formats share: the check of everything before it is written.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/base/event_check.h"
#include "io/files/byte_writer.h"
#include "scarf/io/recordings.h"

namespace scarf {

class CheckedSink : public EventSink {
 public:
  CheckedSink(ByteWriter output, SensorSize sensor, const WriteLimits& limits);

  Result<void> write_header(std::span<const HeaderLine> lines) final;
  Result<void> write(std::span<const Event> events) final;
  Result<void> write_triggers(std::span<const Trigger> triggers) final;
  Result<void> finish() final;

 protected:
  /// Appends what stands before everything else to output_, with lines that were checked.
  virtual void encode_header(std::span<const HeaderLine> /*lines*/) {}
  /// Appends a trigger that was checked to output_.
  virtual void encode_trigger(const Trigger& /*trigger*/) {}
  /// Appends events that were checked to output_.
  virtual void encode(std::span<const Event> events) = 0;
  /// What is left to do before output_ is finished. Errors: io.
  virtual Result<void> complete() { return {}; }
  /// Events encoded so far.
  uint64_t count() const { return check_.count(); }

  ByteWriter output_;

 private:
  void begin();

  EventCheck check_;
  std::vector<HeaderLine> header_;
  bool begun_ = false;
};

/// Creates the file and the writer of it. Errors: as ByteWriter::create.
template <class Writer>
Result<std::unique_ptr<EventSink>> create_sink(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule) {
  auto output = ByteWriter::create(path, rule);
  if (!output) return output.error();
  return std::unique_ptr<EventSink>(std::make_unique<Writer>(*std::move(output), sensor));
}

}  // namespace scarf
