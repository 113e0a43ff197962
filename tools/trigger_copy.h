// The triggers of a recording, on their way into a copy of it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "scarf/digest/digest.h"
#include "scarf/io/frames.h"

namespace scarf::tools {

/// A recording that is open, and how it was opened.
struct Original {
  EventSource& source;
  const std::string& path;
  const ReadOptions& read;
};

/// Whether a recording can be read a second time, which a pipe cannot.
bool can_be_read_twice(const std::string& path);

/// Whether a trigger belongs to the copy. Asked before the first event that is not older than it.
using ChooseTrigger = std::function<bool(const Trigger&)>;

/// Reads the recording a second time, beside its events, and writes its triggers in the order of their times.
/// What is lost of them is counted and never ends the copy, unless ReadOptions::strict is set.
class TriggerCopy {
 public:
  /// `sink`: none, if its format has no room for triggers. Errors: io; with strict, bad_input.
  static Result<TriggerCopy> open(const Original& original, EventSink* sink, std::string_view sink_format,
                                  ChooseTrigger choose);

  /// Whether a trigger is due before an event of time t; asked for each event of the recording in order.
  bool due_before(int64_t t) const { return t >= next_; }
  /// Writes the triggers that are due before the event. Errors: io; with strict, bad_input.
  Result<void> write_before(const Event& event);
  /// Writes the rest. Errors: the same.
  Result<void> finish();

  uint64_t written() const { return written_; }
  /// SHA-256 of what was written, as triggers_digest() tells it of the copy.
  std::string digest() { return digest_.hex(); }
  /// What the copy does not have, or has in another way: a line each.
  std::string losses() const;

 private:
  TriggerCopy(const Original& original, EventSink* sink, std::string_view sink_format, ChooseTrigger choose);
  Result<void> fill();
  Result<void> write_front();

  Original original_;
  EventSink* sink_;
  std::string sink_format_;
  ChooseTrigger choose_;
  std::unique_ptr<TriggerSource> triggers_;  // none: there are no more
  std::string unread_;                       // why there are others that were not read
  std::deque<Trigger> sorted_;
  int64_t next_ = std::numeric_limits<int64_t>::max();  // the time of the first of them
  EventDigest digest_;
  uint64_t read_ = 0;
  uint64_t moved_ = 0;  // because they are older than one before them
  uint64_t written_ = 0;
  uint64_t no_room_ = 0;
  uint64_t refused_ = 0;
  std::string refusal_;  // of the first of them
};

/// SHA-256 of all triggers of a recording; of one that has none, that of no triggers.
/// Errors: io; bad_input.
Result<std::string> triggers_digest(const std::string& path, const ReadOptions& read);

}  // namespace scarf::tools
