// Reader of text lines `t x y p`, t in seconds.
// Source: the layout of the Event-Camera Dataset, and of E2VID with its first line `width height`.

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include "io/buffered_source.h"
#include "io/decimal.h"
#include "io/known_formats.h"
#include "io/look_ahead.h"
#include "io/sensor_size.h"
#include "io/writers.h"

namespace scarf {
namespace {

// Longer lines are skipped unread.
constexpr size_t kMaxLine = 4096;
static_assert(kMaxLine < ByteReader::kCapacity);

constexpr size_t kFields = 4;

struct Fields {
  std::array<std::string_view, kFields> text;
  size_t count = 0;  // may be kFields + 1: too many
};

Fields split(std::string_view line) {
  const auto separates = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; };
  Fields fields;
  size_t at = 0;
  for (;;) {
    while (at < line.size() && separates(line[at])) ++at;
    if (at == line.size()) return fields;
    const size_t begin = at;
    while (at < line.size() && !separates(line[at])) ++at;
    if (fields.count == kFields) return ++fields.count, fields;
    fields.text[fields.count++] = line.substr(begin, at - begin);
  }
}

std::optional<uint8_t> polarity_from(std::string_view token) {
  if (token == "1" || token == "true" || token == "True") return uint8_t{1};
  if (token == "0" || token == "-1" || token == "false" || token == "False") return uint8_t{0};
  return std::nullopt;
}

struct Line {
  enum Kind { blank, event, outside, unknown } kind = unknown;
  Event content;  // of an event; of one outside, t alone
};

Line parse(std::string_view line) {
  if (line.starts_with('#')) return {Line::blank, {}};
  const Fields fields = split(line);
  if (fields.count == 0) return {Line::blank, {}};
  if (fields.count != kFields) return {};
  const auto t = microseconds_from_seconds(fields.text[0]);
  const auto x = integer_from(fields.text[1]);
  const auto y = integer_from(fields.text[2]);
  const auto p = polarity_from(fields.text[3]);
  if (!t || !x || !y || !p) return {};
  const auto fits = [](int64_t v) { return v >= 0 && v <= std::numeric_limits<uint16_t>::max(); };
  if (!fits(*x) || !fits(*y)) return {Line::outside, {*t}};
  return {Line::event, {*t, static_cast<uint16_t>(*x), static_cast<uint16_t>(*y), *p}};
}

std::string_view as_text(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<SensorSize> size_from(std::string_view line) {
  const Fields fields = split(line);
  if (fields.count != 2) return std::nullopt;
  const auto width = integer_from(fields.text[0]);
  const auto height = integer_from(fields.text[1]);
  if (!width || !height) return std::nullopt;
  const auto clamped = [](int64_t v) {
    return static_cast<int32_t>(std::min<int64_t>(v, std::numeric_limits<int32_t>::max()));
  };
  return SensorSize{clamped(*width), clamped(*height)};
}

class TextReader final : public BufferedSource {
 public:
  using BufferedSource::BufferedSource;

  std::string_view format() const override { return "text"; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  bool in_long_line_ = false;  // the beginning of a line longer than kMaxLine was skipped
};

BufferedSource::Decoded TextReader::decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) {
  const std::string_view all = as_text(bytes);
  ReadReport& report = tally_.report;
  size_t count = 0;
  size_t at = 0;
  while (count < out.size() && at < all.size()) {
    const std::string_view rest = all.substr(at);
    const size_t newline = rest.find('\n');
    if (newline == rest.npos && rest.size() >= kMaxLine) {
      report.unknown_words += in_long_line_ ? 0 : 1;
      in_long_line_ = true;
      at = all.size();
      break;
    }
    if (newline == rest.npos && !last && !in_long_line_) break;
    const size_t length = std::min(newline, rest.size());
    const bool whole = newline != rest.npos;
    if (in_long_line_) {
      in_long_line_ = !whole;
    } else {
      const Line line = length < kMaxLine ? parse(rest.substr(0, length)) : Line{};
      if (line.kind == Line::event) {
        out[count] = line.content;
        count += tally_.keep(out.subspan(count, 1));
      } else if (line.kind == Line::outside) {
        tally_.drop(line.content.t);
      } else if (line.kind == Line::unknown) {
        if (!whole) break;  // the file ends in the middle of a line
        ++report.unknown_words;
      }
    }
    at += whole ? length + 1 : length;
  }
  return {at, count, count < out.size()};
}

// What the beginning of a text recording says.
struct TextStart {
  std::optional<SensorSize> size;  // of the first line, if it is `width height`; as it stands, unchecked
  size_t bytes = 0;                // up to and with that line; 0 without it
};

// The start of a text recording, or nullopt if no line of `bytes` is one. `last`: nothing follows `bytes`.
std::optional<TextStart> find_text_start(std::span<const uint8_t> bytes, bool last) {
  const std::string_view all = as_text(bytes);
  TextStart start;
  bool first = true;
  for (size_t at = 0; at < all.size();) {
    const size_t newline = all.find('\n', at);
    if (newline == all.npos && !last) return std::nullopt;
    const std::string_view line = all.substr(at, std::min(newline, all.size()) - at);
    at += line.size() + (newline == all.npos ? 0 : 1);
    const Line::Kind kind = line.size() < kMaxLine ? parse(line).kind : Line::unknown;
    if (kind == Line::event || kind == Line::outside) return start;
    if (kind == Line::blank) continue;
    if (first && size_from(line))
      start = {size_from(line), at};
    else if (!first && start.size)
      return std::nullopt;
    first = false;
  }
  // A sensor size and no event is an empty recording.
  return start.size && last ? std::optional(start) : std::nullopt;
}

Result<std::unique_ptr<EventSource>> open_text(Input input, const ReadOptions& options) {
  // Without a start (the format was named, not recognised) every line is looked at.
  TextStart start;
  for (const size_t size : kLookAhead) {
    if (const auto filled = input.bytes.fill(size); !filled) return filled.error();
    const auto found = find_text_start(input.bytes.available(), input.bytes.ended());
    if (!found) continue;
    start = *found;
    break;
  }
  if (start.size) {
    const auto legal = checked_sensor(start.size->width, start.size->height, "the first line");
    if (!legal) return legal.error();
  }
  const auto sensor = agreed_sensor(start.size, options.sensor);
  if (!sensor) return sensor.error();
  input.bytes.skip(start.bytes);
  return std::unique_ptr<EventSource>(
      std::make_unique<TextReader>(std::move(input.bytes), std::move(input.name), *sensor, options));
}

bool looks_like_text(const Beginning& beginning) {
  return find_text_start(beginning.bytes, beginning.ended).has_value();
}

}  // namespace

const Format kTextFormat = {.name = "text",
                            .title = "text lines `t x y p` with t in seconds",
                            .recognise = looks_like_text,
                            .open = open_text,
                            .create = create_text};

}  // namespace scarf
