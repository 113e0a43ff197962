// Reader of text lines: `t x y p` with t in seconds, CSV of OpenEB and faery, any order of columns.
// Source: the layout of the Event-Camera Dataset, of E2VID with its first line `width height`, of OpenEB's
// metavision_file_to_csv with its first line `%geometry:width,height`, and of faery with its names of
// columns.

#include "io/text/text_reader.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/buffered_source.h"
#include "io/base/known_formats.h"
#include "io/base/look_ahead.h"
#include "io/base/sensor_size.h"
#include "io/base/writers.h"
#include "io/text/text_start.h"

namespace scarf {
namespace {

static_assert(kMaxLine < ByteReader::kCapacity);

constexpr std::string_view kText = "text";
constexpr std::string_view kCsv = "csv";

// So many lines without an event between them are in no recording; an archive of a megabyte unpacks to a
// thousand times as many bytes of them. Seconds of work.
constexpr uint64_t kMaxIdleLines = uint64_t{1} << 24;

class TextReader final : public BufferedSource {
 public:
  TextReader(std::string_view format, Input input, std::optional<SensorSize> sensor, TextLayout layout,
             const ReadOptions& options)
      : BufferedSource(std::move(input.bytes), std::move(input.name), sensor, options),
        format_(format),
        layout_(std::move(layout)),
        one_camera_(options.stream.empty()) {}

  std::string_view format() const override { return format_; }

 protected:
  Decoded decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) override;

 private:
  std::string_view format_;
  TextLayout layout_;
  const bool one_camera_;      // else lines without an event may be those of the others
  uint64_t idle_lines_ = 0;    // since the last event
  bool in_long_line_ = false;  // the beginning of a line longer than kMaxLine was skipped
};

BufferedSource::Decoded TextReader::decode(std::span<const uint8_t> bytes, bool last, std::span<Event> out) {
  using Line = TextLayout::Line;
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  ReadReport& report = tally_.report;
  size_t count = 0;
  size_t at = 0;
  while (count < out.size() && at < all.size()) {
    if (idle_lines_ > kMaxIdleLines) {
      tally_.fail({ErrorCode::bad_input, text("more than ", kMaxIdleLines,
                                              " lines in a row hold no event; this is no recording, or what "
                                              "was one ends before them")});
      return {at, count, false};
    }
    if (!in_long_line_ && all[at] == '\n') {  // there may be very many
      const size_t next = std::min(all.find_first_not_of('\n', at), all.size());
      idle_lines_ += next - at;
      at = next;
      continue;
    }
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
      const Line line = length < kMaxLine ? layout_.parse(rest.substr(0, length)) : Line{};
      const bool idle = line.kind == Line::unknown || (line.kind == Line::blank && one_camera_);
      idle_lines_ = idle ? idle_lines_ + 1 : 0;
      if (line.kind == Line::event) {
        out[count] = line.content;
        count += tally_.keep(out.subspan(count, 1));
      } else if (line.kind == Line::outside) {
        tally_.drop(line.content.t);
      } else if (line.kind == Line::undefined) {
        tally_.leave_out_polarity("the line at byte", bytes_read() + at);
      } else if (line.kind == Line::unknown) {
        if (!whole) break;  // the file ends in the middle of a line
        ++report.unknown_words;
      }
    }
    at += whole ? length + 1 : length;
  }
  return {at, count, count < out.size()};
}

std::optional<TextStart> text_start(const Beginning& beginning) {
  return find_text_start(beginning.bytes, beginning.ended);
}

Result<std::unique_ptr<EventSource>> open_text(Input input, const ReadOptions& options) {
  return open_text_lines(kText, std::move(input), std::nullopt, options);
}

Result<std::unique_ptr<EventSource>> open_csv(Input input, const ReadOptions& options) {
  return open_text_lines(kCsv, std::move(input), std::nullopt, options);
}

bool recognise_text(const Beginning& beginning) {
  const auto start = text_start(beginning);
  return start && !start->percent;
}

bool recognise_csv(const Beginning& beginning) {
  const auto start = text_start(beginning);
  return start && start->percent;
}

}  // namespace

Result<std::unique_ptr<EventSource>> open_text_lines(std::string_view format, Input input,
                                                     std::optional<SensorSize> sensor,
                                                     const ReadOptions& options) {
  const bool csv = format == kCsv;
  // Without a start (the format was named, not recognised) every line is looked at. What is decided depends
  // on so many bytes, not on how they come.
  TextStart start;
  Result<TextLayout> layout = text_layout(start, {}, csv, options);
  for (const size_t size : kLookAhead) {
    if (const auto filled = input.bytes.fill(size); !filled) return filled.error();
    const auto bytes = input.bytes.available().first(std::min(size, input.bytes.available().size()));
    const bool ended = input.bytes.ended() && bytes.size() == input.bytes.available().size();
    const auto found = find_text_start(bytes, ended);
    if (found) start = *found;
    layout = text_layout(start, bytes, csv, options);
    // A few lines say little of columns that nobody has named.
    const bool enough = size > kLookAhead.front() || !is_order_guessed(start, options);
    if (found && layout && enough) break;
  }
  if (start.size) {
    const auto legal = checked_sensor(start.size->width, start.size->height, "the line with the size");
    if (!legal) return legal.error();
  }
  const auto in_file = agreed_sensor(start.size, sensor);
  if (!in_file) return in_file.error();
  const auto agreed = agreed_sensor(*in_file, options.sensor);
  if (!agreed) return agreed.error();
  if (!layout) return layout.error();
  input.bytes.skip(start.bytes);
  return std::unique_ptr<EventSource>(
      std::make_unique<TextReader>(format, std::move(input), *agreed, *std::move(layout), options));
}

const Format kTextFormat = {
    .name = kText,
    .title = "text lines `t x y p` with t in seconds, or as ReadOptions::columns says",
    .options = kTakesColumns | kTakesTimeUnit | kTakesStream,
    .recognise = recognise_text,
    .open = open_text,
    .create = create_text};

const Format kCsvFormat = {.name = kCsv,
                           .title = "CSV lines `x,y,p,t` with t in us, as OpenEB writes them",
                           .options = kTakesColumns | kTakesTimeUnit | kTakesStream,
                           .recognise = recognise_csv,
                           .open = open_csv,
                           .create = create_csv};

}  // namespace scarf
