// Reader of the frames of AEDAT4.

#include <algorithm>
#include <utility>

#include "io/aedat4.h"
#include "scarf/geometry.h"

namespace scarf::aedat4 {
namespace {

// Fields of the table Frame.
enum Field : size_t {
  kT,
  kBegin,
  kEnd,
  kExposureBegin,
  kExposureEnd,
  kFormat,
  kWidth,
  kHeight,
  kOffsetX,
  kOffsetY,
  kPixels
};

// Bytes per pixel of a format; 0 for one that AEDAT4 does not define.
size_t channels_of(int8_t format) {
  switch (format) {
    case 0:
      return 1;  // grey
    case 16:
      return 3;  // blue, green, red
    case 24:
      return 4;  // and opacity
    default:
      return 0;
  }
}

// Luma of ITU-R BT.601, in whole numbers.
uint8_t grey(std::span<const uint8_t> pixel) {
  return static_cast<uint8_t>((114u * pixel[0] + 587u * pixel[1] + 299u * pixel[2] + 500u) / 1000u);
}

std::optional<GreyFrame> decode(const FlatTable& table) {
  const auto t = table.number<int64_t>(kT, 0);
  const auto begin = table.number<int64_t>(kExposureBegin, 0);
  const auto end = table.number<int64_t>(kExposureEnd, 0);
  const auto format = table.number<int8_t>(kFormat, 0);
  const auto width = table.number<int16_t>(kWidth, 0);
  const auto height = table.number<int16_t>(kHeight, 0);
  if (!t || !begin || !end || !format || !width || !height) return std::nullopt;
  const auto legal = [](int16_t size) { return size >= 1 && size <= kMaxSensorSize; };
  const size_t channels = channels_of(*format);
  if (channels == 0 || !legal(*width) || !legal(*height)) return std::nullopt;
  const auto pixels = table.vector(kPixels, 1);
  if (!pixels || pixels->size() != channels * static_cast<size_t>(*width) * static_cast<size_t>(*height)) {
    return std::nullopt;
  }
  GreyFrame frame;
  frame.t = *t;
  frame.exposure_begin = *begin > 0 ? *begin : *t;
  frame.exposure_end = *end > 0 ? *end : *t;
  frame.image = Image<uint8_t>(*width, *height);
  for (size_t i = 0; i < frame.image.pixels.size(); ++i) {
    frame.image.pixels[i] = channels == 1 ? (*pixels)[i] : grey(pixels->subspan(i * channels, channels));
  }
  return frame;
}

class Aedat4Frames final : public FrameSource {
 public:
  Aedat4Frames(std::string name, Packets packets) : name_(std::move(name)), packets_(std::move(packets)) {}

  Result<std::optional<GreyFrame>> read() override {
    auto packet = packets_.next();
    if (!packet) return packet.error();
    if (!*packet) return std::optional<GreyFrame>();
    Packet& p = **packet;
    std::optional<GreyFrame> frame;
    if (p.content) {
      frame = decode(*p.content);
      if (!frame) p.damage = "the frame is broken";
    }
    if (!frame) return damage_error(name_, p);
    return frame;
  }

 private:
  std::string name_;
  Packets packets_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> open_frames(Input input, const ReadOptions& options) {
  const std::string name = input.name;
  auto packets = Packets::open(std::move(input), options, "FRME", "frame streams");
  if (!packets) return packets.error();
  return std::unique_ptr<FrameSource>(std::make_unique<Aedat4Frames>(name, *std::move(packets)));
}

}  // namespace scarf::aedat4
