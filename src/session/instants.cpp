#include "session/instants.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/parse.h"
#include "core/text.h"
#include "core/time_unit.h"
#include "io/base/decimal.h"
#include "io/base/line_reader.h"

namespace scarf {
namespace {

constexpr uint64_t kMicroseconds = 1'000'000;  // per second
constexpr size_t kMaxTimesLine = 65'536;       // characters of a line of times
constexpr size_t kMaxQuote = 40;               // characters of a line that is no time
constexpr size_t kMaxDecimals = 6;             // of a frame rate: keeps the fraction within 64 bits

__extension__ using Int128 = __int128;  // holds any number of frames times any step, so nothing overflows

class AtRate final : public Instants {
 public:
  AtRate(FrameRate rate, uint64_t max_empty) : rate_(rate), max_empty_(max_empty) {}

  Result<void> due(std::span<const Event> events, const TakeFrame& take) override {
    if (!t_first_ && !events.empty()) {
      t_first_ = events.front().t;
      next_time_ = time_of(next_);
    }
    for (const Event& e : events) {
      // Told before the first of them is taken: one corrupt time must not fill a disk.
      if (e.t >= next_time_ && e.t >= time_of(Int128{next_} + max_empty_)) return flood(e);
      while (e.t >= next_time_) {
        if (auto r = take({static_cast<int64_t>(next_time_), events_}); !r) return r;
        next_time_ = time_of(++next_);
      }
      previous_ = e.t;
      ++events_;
    }
    return {};
  }

  Result<void> due_at_end(const TakeFrame&) override { return {}; }

 private:
  Error flood(const Event& e) const {
    return {ErrorCode::bad_input, text("event ", events_, " (t ", e.t, " us) follows one at ", previous_,
                                       " us, which makes more than ", max_empty_,
                                       " frames in a row without an event; if that is right, raise "
                                       "FrameRequest::max_frames, else cut the "
                                       "recording, or lower FrameRequest::rate")};
  }

  Int128 time_of(Int128 frame) const {
    return *t_first_ + frame * kMicroseconds * rate_.denominator / rate_.numerator;
  }

  const FrameRate rate_;
  const uint64_t max_empty_;
  std::optional<int64_t> t_first_;
  uint64_t next_ = 1;
  Int128 next_time_ = 0;
  int64_t previous_ = 0;  // the time of the event in front
  uint64_t events_ = 0;
};

class EveryN final : public Instants {
 public:
  explicit EveryN(uint64_t n) : n_(n) {}

  Result<void> due(std::span<const Event> events, const TakeFrame& take) override {
    for (const Event& e : events) {
      if (++events_ % n_ != 0) continue;
      if (auto r = take({e.t, events_}); !r) return r;
    }
    return {};
  }

  Result<void> due_at_end(const TakeFrame&) override { return {}; }

 private:
  const uint64_t n_;
  uint64_t events_ = 0;
};

class AtTimes final : public Instants {
 public:
  explicit AtTimes(std::vector<int64_t> times) : times_(std::move(times)) {}

  Result<void> due(std::span<const Event> events, const TakeFrame& take) override {
    for (const Event& e : events) {
      for (; next_ < times_.size() && e.t >= times_[next_]; ++next_) {
        if (auto r = take({times_[next_], events_}); !r) return r;
      }
      ++events_;
    }
    return {};
  }

  Result<void> due_at_end(const TakeFrame& take) override {
    for (; next_ < times_.size(); ++next_) {
      if (auto r = take({times_[next_], events_}); !r) return r;
    }
    return {};
  }

 private:
  const std::vector<int64_t> times_;
  size_t next_ = 0;
  uint64_t events_ = 0;
};

class AtEnd final : public Instants {
 public:
  Result<void> due(std::span<const Event> events, const TakeFrame&) override {
    if (!events.empty()) last_.t = events.back().t;
    last_.events += events.size();
    return {};
  }

  Result<void> due_at_end(const TakeFrame& take) override { return take(last_); }

 private:
  Frame last_;
};

// The n-th column of a line, the first being 1; empty if there are fewer.
std::string_view column_of(std::string_view line, uint64_t n) {
  constexpr std::string_view kSeparators = " \t,";
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(kSeparators), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kSeparators));
    if (--n == 0 || word.empty()) return word;
    line.remove_prefix(word.size());
  }
}

}  // namespace

Result<int> parse_time_unit(const std::string& word) {
  if (const auto exponent = time_exponent(word)) return *exponent;
  return Error{ErrorCode::illegal_parameter, text("'", word, "' is no unit of time; there are ", kTimeUnits)};
}

Result<FrameRate> parse_frame_rate(const std::string& word) {
  const size_t point = word.find('.');
  const std::string whole = word.substr(0, point);
  const std::string decimals = point == std::string::npos ? "" : word.substr(point + 1);
  const bool digits_only = (whole + decimals).find_first_not_of("0123456789") == std::string::npos;
  FrameRate rate{0, 1};
  if (digits_only && !whole.empty() && whole.size() <= 7 && decimals.size() <= kMaxDecimals) {
    for (size_t i = 0; i < decimals.size(); ++i) rate.denominator *= 10;
    rate.numerator = parse_integer<uint64_t>(whole + decimals).value_or(0);
  }
  if (rate.numerator < 1 || rate.numerator > kMicroseconds * rate.denominator) {
    return Error{ErrorCode::illegal_parameter,
                 text("frame rate is '", word, "', legal is 0.000001 to 1000000 with up to 6 decimals")};
  }
  return rate;
}

std::unique_ptr<Instants> frames_at_rate(FrameRate rate, uint64_t max_empty) {
  return std::make_unique<AtRate>(rate, max_empty);
}

std::unique_ptr<Instants> frames_every(uint64_t n) {
  return std::make_unique<EveryN>(n);
}

std::unique_ptr<Instants> frames_at_times(std::vector<int64_t> times) {
  return std::make_unique<AtTimes>(std::move(times));
}

std::unique_ptr<Instants> frame_at_end() {
  return std::make_unique<AtEnd>();
}

Result<std::vector<int64_t>> read_times(const std::string& path, const TimesFormat& format) {
  const auto unreadable = [&](const Error& error) {
    return Error{error.code, text("cannot read the times file ", path, ": ", error.message)};
  };
  auto lines = LineReader::open(path, kMaxTimesLine);
  if (!lines) return unreadable(lines.error());
  std::vector<int64_t> times;
  for (;;) {
    const auto line = lines->next();
    if (!line) return unreadable(line.error());
    if (!*line) break;
    if ((*line)->empty() || (*line)->starts_with('#')) continue;
    const std::string_view word = column_of(**line, format.column);
    const auto t = microseconds_from(word, format.exponent);
    if (!t) {
      return Error{ErrorCode::bad_input,
                   text(path, " line ", lines->number(), ": '", word.substr(0, kMaxQuote), "' in column ",
                        format.column, " is not a time")};
    }
    if (!times.empty() && *t < times.back()) {
      return Error{ErrorCode::bad_input, text(path, " line ", lines->number(), ": time ", word,
                                              " is before the one above it; sort the times")};
    }
    times.push_back(*t);
  }
  if (times.empty()) return Error{ErrorCode::bad_input, text(path, " holds no times; write one per line")};
  return times;
}

}  // namespace scarf
