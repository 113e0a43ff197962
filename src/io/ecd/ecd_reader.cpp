// Reader of the Event-Camera Dataset's folders and zip archives, and of E2VID's zip archives.

#include <utility>

#include "io/base/known_formats.h"
#include "io/base/look_ahead.h"
#include "io/ecd/ecd_files.h"
#include "io/ecd/ecd_frames.h"
#include "io/text/text_reader.h"
#include "io/text/text_start.h"

namespace scarf {
namespace {

constexpr std::string_view kName = "ecd";

// Whether the text begins as events do.
Result<bool> begins_with_events(ByteReader& bytes) {
  if (const auto filled = bytes.fill(kLookAhead.back()); !filled) return filled.error();
  return find_text_start(bytes.available(), bytes.ended()).has_value();
}

Result<std::unique_ptr<EventSource>> open_ecd(Input input, const ReadOptions& options) {
  auto files = EcdFiles::find(input);
  if (!files) return files.error();
  // The size of the images is the sensor's, but none of the recording's if it cannot be told.
  const auto size = ecd_image_size(*files);
  if (!size && !options.sensor) return size.error();
  auto events = files->events();
  if (!events) return events.error();
  if (!files->named_events()) {
    const auto found = begins_with_events(*events);
    if (!found) return found.error();
    if (!*found) {
      return Error{ErrorCode::unrecognised, "the only text of the zip archive does not begin with events"};
    }
  }
  input.bytes = *std::move(events);
  return open_text_lines(kName, std::move(input), size ? *size : std::nullopt, options);
}

Result<std::unique_ptr<FrameSource>> open_frames_of_ecd(Input input, const ReadOptions& /*options*/) {
  auto files = EcdFiles::find(input);
  if (!files) return files.error();
  return open_ecd_frames(*std::move(files));
}

// Asked after other formats that are archives.
bool recognise_ecd(const Beginning& beginning) {
  return beginning.folder ? is_ecd_folder(beginning.path) : looks_like_zip(beginning.bytes);
}

}  // namespace

const Format kEcdFormat = {
    .name = kName,
    .title = "Event-Camera Dataset, folder or zip (events.txt, images); zip of E2VID (one text file)",
    .options = kTakesColumns | kTakesTimeUnit | kTakesStream,
    .recognise = recognise_ecd,
    .open = open_ecd,
    .open_frames = open_frames_of_ecd};

}  // namespace scarf
