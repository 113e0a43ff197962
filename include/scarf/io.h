// Recordings: readers of event files behind one EventSource, writers behind one EventSink.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scarf/event.h"
#include "scarf/result.h"

namespace scarf {

/// What a reader met so far.
struct ReadReport {
  uint64_t events = 0;            ///< events handed out (inside the sensor)
  uint64_t outside = 0;           ///< events outside the sensor (or beyond uint16_t): counted and dropped
  uint64_t back_steps = 0;        ///< events (outside ones included) older than the event before them
  int64_t largest_back_step = 0;  ///< microseconds
  uint64_t unknown_words = 0;     ///< words or lines that the format does not define
  uint64_t truncated_bytes = 0;   ///< bytes at the end that do not make a whole word or line
};

struct ReadOptions {
  /// Sensor size, for files that do not say. One that disagrees with the file is an error naming both.
  std::optional<SensorSize> sensor;
};

/// A stream of events out of a file. Memory use does not depend on the length of the file.
class EventSource {
 public:
  virtual ~EventSource() = default;

  /// Name of the recognised format: "EVT2", "EVT3" or "text".
  virtual std::string_view format() const = 0;
  /// Sensor size, from the file or from the options; nullopt if neither says. Without it no event is outside.
  virtual std::optional<SensorSize> sensor() const = 0;
  /// Reads up to out.size() events (at least 1) in file order; 0 means the end of the stream. Fewer than
  /// out.size() do not: a pipe's events are handed out as they come.
  virtual Result<size_t> read(std::span<Event> out) = 0;
  virtual const ReadReport& report() const = 0;
  /// Bytes consumed so far and size of the file (0 if unknown, as for a pipe), for progress displays.
  virtual uint64_t bytes_read() const = 0;
  virtual uint64_t bytes_total() const = 0;
};

/// Opens a recording; "-" is standard input. The format is recognised by content, not by name: Prophesee RAW
/// in EVT2 and EVT3, with or without its header, and text lines `t x y p` with t in seconds. Errors: io
/// (cannot open), bad_input (not recognised, the sensor disagrees with `options`), illegal_parameter
/// (`options` names a size outside 1..16,384).
Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options = {});

/// The sensor size of a source, or the error that asks for `--geometry WxH`.
Result<SensorSize> require_sensor(const EventSource& source, const std::string& path);

enum class WriteFormat { evt2, evt3, text };

/// A file that events are written to, in order.
class EventSink {
 public:
  virtual ~EventSink() = default;
  /// Errors: io; bad_input for an event that the format cannot hold (naming it): one outside the sensor, and
  /// in EVT2 and EVT3 a back-step, a coordinate above 2047, or a time below 0 or beyond 4096 turns of the
  /// format's clock (2^46 us, 2^36 us). The events before it are written.
  virtual Result<void> write(std::span<const Event> events) = 0;
  /// Completes the file. It is written beside its place and appears there now; destroyed without finish(), an
  /// EventSink leaves no file.
  virtual Result<void> finish() = 0;
};

/// Creates or replaces a recording; "-" is standard output. EVT2 and EVT3 are Prophesee RAW files with a
/// header that names the sensor size; text is `t x y p` with t in seconds and a first line `width height`.
Result<std::unique_ptr<EventSink>> create_events(const std::string& path, WriteFormat format,
                                                 SensorSize sensor);

}  // namespace scarf
