// Lines `t name` of images.txt, t in seconds, and the PNG images that they name.
#include "io/ecd/ecd_frames.h"

#include <utility>

#include "core/text.h"
#include "io/base/decimal.h"
#include "io/base/line_reader.h"
#include "io/base/sensor_size.h"
#include "io/ecd/png_image.h"
#include "io/text/text_lines.h"

namespace scarf {
namespace {

// The largest sensor has 16,384 x 16,384 pixels, and no recording holds such frames uncompressed.
constexpr size_t kMaxImageBytes = size_t{64} << 20;

Error bad(std::string message) {
  return {ErrorCode::bad_input, std::move(message)};
}

struct Entry {
  int64_t t;
  std::string name;
};

// The list of images, line by line.
class ImageList {
 public:
  explicit ImageList(ByteReader lines) : lines_(std::move(lines), kMaxLine) {}

  Result<std::optional<Entry>> next() {
    for (size_t blank = 0; blank < kMaxBlankLines; ++blank) {
      const auto line = lines_.next();
      if (!line) return Error{line.error().code, text("images.txt: ", line.error().message)};
      if (!*line) return std::optional<Entry>();
      if (is_blank_or_comment(**line)) continue;
      const Fields fields = split(**line, separator_of(**line));
      const auto t = microseconds_from_seconds(fields.text[0]);
      if (fields.count != 2 || !t) {
        return bad(text("images.txt: line ", lines_.number(), " is not a time in seconds and a name"));
      }
      return std::optional(Entry{*t, std::string(fields.text[1])});
    }
    return bad(text("images.txt: the ", kMaxBlankLines, " lines up to line ", lines_.number(), " are empty"));
  }

 private:
  // An archive of a few kilobytes unpacks to any number of them.
  static constexpr size_t kMaxBlankLines = 1'000'000;

  LineReader lines_;
};

class EcdFrames final : public FrameSource {
 public:
  EcdFrames(EcdFiles files, ByteReader list) : files_(std::move(files)), list_(std::move(list)) {}

  Result<std::optional<GreyFrame>> read() override {
    auto entry = list_.next();
    if (!entry) return entry.error();
    if (!*entry) return std::optional<GreyFrame>();
    auto image = image_of((*entry)->name);
    if (!image) return Error{image.error().code, text((*entry)->name, ": ", image.error().message)};
    const int64_t t = (*entry)->t;
    return std::optional(GreyFrame{t, t, t, *std::move(image)});
  }

 private:
  Result<Image<uint8_t>> image_of(const std::string& name) const {
    auto file = files_.open(name);
    if (!file) return file.error();
    std::vector<uint8_t> content;
    for (;;) {
      if (const auto filled = file->fill(1); !filled) return filled.error();
      const auto bytes = file->available();
      if (bytes.empty()) return decode_png(content);
      if (content.size() + bytes.size() > kMaxImageBytes) {
        return bad(text("the image has more than ", kMaxImageBytes, " bytes"));
      }
      content.insert(content.end(), bytes.begin(), bytes.end());
      file->skip(bytes.size());
    }
  }

  EcdFiles files_;
  ImageList list_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> open_ecd_frames(EcdFiles files) {
  if (!files.has_images()) {
    return Error{ErrorCode::unrecognised, "this recording has no images.txt, so no frames"};
  }
  auto list = files.images();
  if (!list) return list.error();
  return std::unique_ptr<FrameSource>(std::make_unique<EcdFrames>(std::move(files), *std::move(list)));
}

Result<std::optional<SensorSize>> ecd_image_size(const EcdFiles& files) {
  if (!files.has_images()) return std::optional<SensorSize>();
  auto lines = files.images();
  if (!lines) return lines.error();
  const auto first = ImageList(*std::move(lines)).next();
  if (!first) return first.error();
  if (!*first) return std::optional<SensorSize>();
  auto file = files.open((*first)->name);
  if (!file) return file.error();
  constexpr size_t kBytes = 64;
  if (const auto filled = file->fill(kBytes); !filled) return filled.error();
  const auto size = png_size(file->available());
  if (!size) return bad(text((*first)->name, " is no PNG image"));
  const auto legal = checked_sensor(size->width, size->height, (*first)->name);
  if (!legal) return legal.error();
  return std::optional(*legal);
}

}  // namespace scarf
