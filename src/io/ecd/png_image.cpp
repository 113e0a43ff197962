#include "io/ecd/png_image.h"

#include <limits>

#include "core/text.h"
#include "io/base/format.h"
#include "io/base/sensor_size.h"

#ifdef SCARF_HAS_LIBPNG
#include <png.h>
#endif

namespace scarf {
namespace {

// The signature, and behind it the chunk that comes first: its length, its name, width and height.
constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr size_t kWidthAt = 16;
constexpr size_t kHeightAt = 20;

int32_t load_big_endian(const uint8_t* from) {
  const uint32_t value = uint32_t{from[0]} << 24 | from[1] << 16 | from[2] << 8 | from[3];
  constexpr uint32_t kLargest = std::numeric_limits<int32_t>::max();
  return static_cast<int32_t>(value > kLargest ? kLargest : value);
}

}  // namespace

std::optional<SensorSize> png_size(std::span<const uint8_t> bytes) {
  if (!starts_with(bytes, kSignature) || bytes.size() < kHeightAt + 4) return std::nullopt;
  return SensorSize{load_big_endian(bytes.data() + kWidthAt), load_big_endian(bytes.data() + kHeightAt)};
}

#ifdef SCARF_HAS_LIBPNG

Result<Image<uint8_t>> decode_png(std::span<const uint8_t> bytes) {
  const auto size = png_size(bytes);
  if (!size) return Error{ErrorCode::bad_input, "this is no PNG image"};
  if (const auto legal = checked_sensor(size->width, size->height, "the PNG image"); !legal) {
    return legal.error();
  }
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  const auto broken = [&] {
    const Error error{ErrorCode::bad_input, text("the PNG image is broken: ", png.message)};
    png_image_free(&png);
    return error;
  };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return broken();
  png.format = PNG_FORMAT_GRAY;
  Image<uint8_t> image(size->width, size->height);
  const png_color black = {};
  if (png_image_finish_read(&png, &black, image.pixels.data(), 0, nullptr) == 0) return broken();
  return image;
}

#else

Result<Image<uint8_t>> decode_png(std::span<const uint8_t> /*bytes*/) {
  return Error{ErrorCode::bad_input,
               "this build of scarf has no libpng (Debian: libpng-dev); install it and build again"};
}

#endif

}  // namespace scarf
