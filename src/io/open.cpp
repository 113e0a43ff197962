// Recognition of a recording's format by its content.
#include "io/open.h"

#include <array>
#include <utility>

#include "core/text.h"
#include "io/evt2_reader.h"
#include "io/evt3_reader.h"
#include "io/foreign_format.h"
#include "io/prophesee_header.h"
#include "io/sensor_size.h"
#include "io/text_reader.h"

namespace scarf {
namespace {

constexpr std::string_view kFormats = "Prophesee RAW (EVT2, EVT3) and text lines `t x y p` with t in seconds";

// The beginning of the file that recognition looks at, in steps: a slow pipe is recognised by its first
// lines.
constexpr std::array<size_t, 3> kLookAhead = {256, 4096, 65'536};

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

Error unrecognised(std::span<const uint8_t> bytes) {
  std::string_view what = foreign_format(bytes);
  if (what.empty()) what = bytes.empty() ? "the file is empty" : "not recognised as events";
  return bad(text(what, "; scarf reads ", kFormats));
}

std::optional<WordFormat> guess_words(std::span<const uint8_t> bytes) {
  const bool evt2 = looks_like_evt2(bytes);
  const bool evt3 = looks_like_evt3(bytes);
  if (evt2 == evt3) return std::nullopt;
  return evt2 ? WordFormat::evt2 : WordFormat::evt3;
}

// The sensor that file and caller agree on.
Result<std::optional<SensorSize>> agreed_sensor(std::optional<SensorSize> file,
                                                std::optional<SensorSize> given) {
  if (given) {
    const auto legal = checked_sensor(given->width, given->height, "the sensor size given");
    if (!legal) return Error{ErrorCode::illegal_parameter, legal.error().message};
  }
  if (file && given && *file != *given) {
    return bad(text("the file's sensor is ", size_text(*file), ", but ", size_text(*given),
                    " was given; leave it out or correct it"));
  }
  return file ? file : given;
}

Result<std::unique_ptr<EventSource>> open_words(ByteReader input, const std::string& name,
                                                const PropheseeHeader& header, const ReadOptions& options) {
  const auto sensor = agreed_sensor(header.sensor, options.sensor);
  if (!sensor) return sensor.error();
  const auto make = *header.format == WordFormat::evt2 ? make_evt2_reader : make_evt3_reader;
  return make(std::move(input), name, *sensor);
}

Result<std::unique_ptr<EventSource>> open_text(ByteReader input, const std::string& name,
                                               const TextStart& start, const ReadOptions& options) {
  if (start.size) {
    const auto legal = checked_sensor(start.size->width, start.size->height, "the first line");
    if (!legal) return legal.error();
  }
  const auto sensor = agreed_sensor(start.size, options.sensor);
  if (!sensor) return sensor.error();
  input.skip(start.bytes);
  return make_text_reader(std::move(input), name, *sensor);
}

Result<std::unique_ptr<EventSource>> recognise(ByteReader input, const std::string& name,
                                               const ReadOptions& options) {
  auto header = read_prophesee_header(input);
  if (!header) return header.error();
  if (*header && (*header)->format) return open_words(std::move(input), name, **header, options);

  for (const size_t size : kLookAhead) {
    if (const auto filled = input.fill(size); !filled) return filled.error();
    if (*header) continue;
    if (!foreign_format(input.available()).empty()) return unrecognised(input.available());
    const auto start = find_text_start(input.available(), input.ended());
    if (start) return open_text(std::move(input), name, *start, options);
  }
  const auto guess = guess_words(input.available());
  if (guess) {
    const auto sensor = *header ? (*header)->sensor : std::nullopt;
    return open_words(std::move(input), name, {guess, sensor}, options);
  }
  if (*header)
    return bad(
        text("the header names no format, and the words do not tell; add a line `% evt 2.0` or "
             "`% evt 3.0`"));
  return unrecognised(input.available());
}

std::string display_name(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

}  // namespace

Result<std::unique_ptr<EventSource>> open_input(ByteReader input, const std::string& name,
                                                const ReadOptions& options) {
  auto source = recognise(std::move(input), name, options);
  if (!source) return Error{source.error().code, text(name, ": ", source.error().message)};
  return source;
}

Result<std::unique_ptr<EventSource>> open_events(const std::string& path, const ReadOptions& options) {
  auto input = ByteReader::open(path);
  if (!input) return Error{input.error().code, text(display_name(path), ": ", input.error().message)};
  return open_input(*std::move(input), display_name(path), options);
}

Result<SensorSize> require_sensor(const EventSource& source, const std::string& path) {
  if (const auto sensor = source.sensor()) return *sensor;
  return bad(
      text(display_name(path), ": the file does not say its sensor size; give it with --geometry WxH"));
}

}  // namespace scarf
