#include "tools/trigger_copy.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "core/text.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

// Triggers that are in order but for some of these many are put in order.
constexpr size_t kMostSorted = 4096;

// The time of a trigger that no number holds.
constexpr int64_t kNever = std::numeric_limits<int64_t>::max();

constexpr size_t kReadAtOnce = 256;

bool may_have_triggers(std::string_view format) {
  const auto all = formats();
  return std::any_of(all.begin(), all.end(),
                     [&](const FormatInfo& f) { return f.name == format && f.triggers; });
}

// Some formats have triggers in streams of their own, which --stream does not mean if it names one of events.
Result<std::unique_ptr<TriggerSource>> open_beside(const Original& original) {
  ReadOptions read = original.read;
  read.time_shift = TimeShift::none;
  auto triggers = open_triggers(original.path, read);
  if (!triggers && triggers.error().code == ErrorCode::illegal_parameter && !read.stream.empty()) {
    read.stream.clear();
    triggers = open_triggers(original.path, read);
  }
  return triggers;
}

void add(EventDigest& digest, const Trigger& trigger) {
  digest.add({.t = trigger.t, .x = trigger.id, .y = 0, .p = trigger.value});
}

}  // namespace

bool can_be_read_twice(const std::string& path) {
  std::error_code ignored;
  return path != "-" &&
         (std::filesystem::is_regular_file(path, ignored) || std::filesystem::is_directory(path, ignored));
}

TriggerCopy::TriggerCopy(const Original& original, EventSink* sink, std::string_view sink_format,
                         ChooseTrigger choose)
    : original_(original), sink_(sink), sink_format_(sink_format), choose_(std::move(choose)) {}

Result<TriggerCopy> TriggerCopy::open(const Original& original, EventSink* sink, std::string_view sink_format,
                                      ChooseTrigger choose) {
  TriggerCopy copy(original, sink, sink_format, std::move(choose));
  if (!may_have_triggers(original.source.format())) return copy;
  if (!can_be_read_twice(original.path)) {
    copy.unread_ = "a pipe cannot be read a second time for them; name a file";
    return copy;
  }
  auto triggers = open_beside(original);
  if (triggers) {
    copy.triggers_ = *std::move(triggers);
    copy.next_ = std::numeric_limits<int64_t>::min();  // not known before events have been read
  } else if (triggers.error().code == ErrorCode::io || original.read.strict) {
    if (triggers.error().code != ErrorCode::unrecognised) return triggers.error();
  } else if (triggers.error().code != ErrorCode::unrecognised) {
    copy.unread_ = in_options(triggers.error().message);
  }
  return copy;
}

Result<void> TriggerCopy::fill() {
  std::array<Trigger, kReadAtOnce> some;
  while (triggers_ && sorted_.size() < kMostSorted) {
    const auto count = triggers_->read(some);
    if (!count) {
      if (count.error().code == ErrorCode::io || original_.read.strict) return count.error();
      unread_ = in_options(count.error().message);
    }
    if (!count || *count == 0) {
      triggers_.reset();
      break;
    }
    read_ += *count;
    for (Trigger t : std::span(some).first(*count)) {
      if (__builtin_sub_overflow(t.t, original_.source.report().time_shift, &t.t)) t.t = kNever;
      const auto place = std::upper_bound(sorted_.begin(), sorted_.end(), t.t,
                                          [](int64_t time, const Trigger& other) { return time < other.t; });
      if (place != sorted_.end()) ++moved_;
      sorted_.insert(place, t);
    }
  }
  next_ = sorted_.empty() ? std::numeric_limits<int64_t>::max() : sorted_.front().t;
  return {};
}

Result<void> TriggerCopy::write_front() {
  const Trigger trigger = sorted_.front();
  sorted_.pop_front();
  if (choose_(trigger)) {
    if (sink_ == nullptr) {
      ++no_room_;
    } else if (const auto r = sink_->write_triggers({&trigger, 1}); r) {
      ++written_;
      add(digest_, trigger);
    } else if (r.error().code == ErrorCode::bad_input && !original_.read.strict) {
      if (refused_++ == 0) refusal_ = in_options(r.error().message);
    } else {
      return r;
    }
  }
  return fill();
}

Result<void> TriggerCopy::write_before(const Event& event) {
  if (auto r = fill(); !r) return r;
  while (!sorted_.empty() && sorted_.front().t <= event.t) {
    if (auto r = write_front(); !r) return r;
  }
  return {};
}

Result<void> TriggerCopy::finish() {
  if (auto r = fill(); !r) return r;
  while (!sorted_.empty()) {
    if (auto r = write_front(); !r) return r;
  }
  return {};
}

std::string TriggerCopy::losses() const {
  std::string lines;
  if (no_room_ > 0) {
    lines += text("not copied: ", no_room_, " triggers; ", sink_format_,
                  " has no room for them, scarf triggers lists them\n");
  }
  if (refused_ > 0) lines += text("lost: ", refused_, " triggers, the first one: ", refusal_, "\n");
  if (!unread_.empty()) {
    lines += text("not copied: triggers, ",
                  read_ > 0 ? text("but for the first ", read_) : "if there are any", ": ", unread_, "\n");
  }
  if (moved_ > 0)
    lines += text("changed: ", moved_, " triggers were older than one before them, and moved\n");
  return lines;
}

Result<std::string> triggers_digest(const std::string& path, const ReadOptions& read) {
  EventDigest digest;
  const auto triggers = open_triggers(path, read);
  if (!triggers) {
    return triggers.error().code == ErrorCode::unrecognised ? Result<std::string>(digest.hex())
                                                            : triggers.error();
  }
  std::array<Trigger, kReadAtOnce> some;
  for (;;) {
    const auto count = (*triggers)->read(some);
    if (!count) return count.error();
    if (*count == 0) return digest.hex();
    for (const Trigger& t : std::span(some).first(*count)) add(digest, t);
  }
}

}  // namespace scarf::tools
