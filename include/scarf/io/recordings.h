// Recordings: readers of event files behind one EventSource, writers behind one EventSink.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarf/core/event.h"
#include "scarf/core/read_report.h"
#include "scarf/core/result.h"

namespace scarf {

/// What becomes of an event that is older than one before it. Every policy counts them.
enum class TimePolicy {
  keep,   ///< it stays as it is
  clamp,  ///< it gets the time of the newest event so far
  drop,   ///< it is left out
  error,  ///< reading ends with an error that names it
};

/// What becomes of an event outside the sensor.
enum class OutOfSensor { drop, error };

/// What is subtracted from all times.
enum class TimeShift {
  none,
  first_high,   ///< the first TIME_HIGH word's time, as Prophesee's own reader does; EVT formats only
  first_event,  ///< the time of the first event handed out, which then is 0
};

struct ReadOptions {
  /// Sensor size, for files that do not say. One that disagrees with the file is an error naming both.
  std::optional<SensorSize> sensor;
  /// A name of formats(); empty: recognised by content.
  std::string format = {};
  /// Which camera, of a file with several: a name out of the error that says there are several.
  std::string stream = {};
  TimePolicy time_policy = TimePolicy::keep;
  OutOfSensor out_of_sensor = OutOfSensor::drop;
  TimeShift time_shift = TimeShift::none;
  /// Damage, unknown words and truncated bytes are errors that name the place.
  bool strict = false;
  /// Columns of text and arrays in their order ("txyp"), or by names ("t=/a/ts,x=/a/xs,..."); empty: its own.
  std::string columns = {};
  /// Unit of times where a format leaves it open: "s", "ms", "us", "ns"; empty: the format's own.
  std::string time_unit = {};
  /// YARP packets without times of their events: "packet" (all have the packet's), "spread" (over its
  /// duration).
  std::string yarp_time = {};
};

/// An edge at the camera's trigger input.
struct Trigger {
  int64_t t = 0;      ///< microseconds, on the clock of the events
  uint16_t id = 0;    ///< the input
  uint8_t value = 0;  ///< 1: rising, 0: falling

  friend bool operator==(const Trigger&, const Trigger&) = default;
};

/// A line of the text header that the software of a camera wrote, such as `serial_number 00000042`.
struct HeaderLine {
  std::string key;
  std::string value;

  friend bool operator==(const HeaderLine&, const HeaderLine&) = default;
};

/// A stream of events out of a file. Memory use does not depend on the length of the file.
class EventSource {
 public:
  virtual ~EventSource() = default;

  /// Name of the format, one of formats().
  virtual std::string_view format() const = 0;
  /// Sensor size, from the file or from the options; nullopt if neither says. Without it no event is outside.
  virtual std::optional<SensorSize> sensor() const = 0;
  /// Reads up to out.size() events (at least 1) in file order; 0 means the end of the stream, fewer do not: a
  /// pipe's events come as they are there. After out_of_memory nothing is read any more: open it again.
  /// Errors: io; bad_input, also instead of the end if a file of the recording grew, shrank, was written or
  /// replaced since it was opened: what was read is then of no moment of it.
  virtual Result<size_t> read(std::span<Event> out) = 0;
  /// For who stops before the end: that error, if it is due now.
  virtual Result<void> unchanged() const { return {}; }
  virtual const ReadReport& report() const = 0;
  /// What the recording's text header says of the camera and of how it was recorded, in its order; without
  /// the lines that say how the file is to be read, which are format() and sensor(). Only Prophesee's formats
  /// have such a header.
  virtual std::span<const HeaderLine> header() const { return {}; }
  /// Bytes consumed so far and size of the file (0 if unknown, as for a pipe), for progress displays.
  virtual uint64_t bytes_read() const = 0;
  virtual uint64_t bytes_total() const = 0;
};

/// A format that scarf knows.
struct FormatInfo {
  std::string name;              ///< as ReadOptions::format and create_events take it
  std::string title;             ///< for people
  std::string missing;           ///< empty, or the library without which this build cannot read it
  bool recognised = false;       ///< by content; else ReadOptions::format must name it
  bool written = false;          ///< create_events can make it
  bool frames = false;           ///< its recordings may hold frames ...
  bool triggers = false;         ///< ... and triggers, see frames.h
  bool writes_header = false;    ///< EventSink::write_header has room in it ...
  bool writes_triggers = false;  ///< ... and EventSink::write_triggers
};

/// All formats, those that are not built in included.
std::vector<FormatInfo> formats();

/// Opens a recording: a file, a folder where the format is one, or "-", which is standard input. The format
/// is recognised by content, not by name, unless `options` names it. Errors: io (cannot open), unrecognised
/// (no format is like this, or it holds no events: most likely no recording), bad_input (broken from the
/// start, events in a format that is not read, the sensor disagrees with `options`), illegal_parameter (an
/// option that is out of range or of no use to the format).
Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options = {});

/// The sensor size of a source, or the error that asks for ReadOptions::sensor.
Result<SensorSize> require_sensor(const EventSource& source, const std::string& path);

/// A file that events are written to, in order, and triggers among them.
class EventSink {
 public:
  virtual ~EventSink() = default;
  /// Adds lines to the file's header, as EventSource::header gives them: before the first event or trigger.
  /// Errors: bad_input for a line that the format cannot hold, where nothing is added; illegal_parameter if
  /// it is too late.
  virtual Result<void> write_header(std::span<const HeaderLine> lines);
  /// The same as write() for triggers. In formats that refuse back-steps no trigger may be older than the
  /// event or trigger before it, and no event older than the trigger before it. Errors: io; bad_input for a
  /// trigger that the format cannot hold, naming it. The triggers before it are written.
  virtual Result<void> write_triggers(std::span<const Trigger> triggers);
  /// Errors: io; bad_input for an event that the format cannot hold, naming it (docs/FORMATS.md says what
  /// each can): the events before it are written. After out_of_memory nothing is written any more.
  virtual Result<void> write(std::span<const Event> events) = 0;
  /// Completes the file. It is written beside its place and appears there now, on the disk, unless another
  /// program has made one of that name meanwhile; destroyed without finish(), an EventSink leaves no file.
  virtual Result<void> finish() = 0;
};

struct WriteOptions {
  /// Whether a regular file that is there is replaced; it leaves its permissions.
  bool overwrite = false;
  /// Files and folders that the events come from, "-" for standard input: never replaced, whatever their
  /// names.
  std::vector<std::string> inputs = {};
};

/// Creates a recording in one of formats(); "-" is standard output, devices and pipes are written directly.
/// Errors: io; illegal_parameter for a format that is not written, naming those that are, for an illegal
/// sensor size, and for a file that is there and may not be replaced, a symbolic link or a folder.
Result<std::unique_ptr<EventSink>> create_events(const std::string& path, std::string_view format,
                                                 SensorSize sensor, const WriteOptions& options = {});

}  // namespace scarf
