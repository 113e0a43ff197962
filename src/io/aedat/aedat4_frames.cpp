// Reader of the frames of AEDAT4.

#include <algorithm>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/aedat/aedat4.h"
#include "io/base/luma.h"
#include "scarf/core/patch_grid.h"

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

// Pixels are named as in OpenCV: the type of a sample in the lower three bits, one less than the channels
// above.
struct PixelType {
  explicit PixelType(int8_t format)
      : sample(format & 7), channels(static_cast<size_t>(format >> 3 & 31) + 1) {}

  size_t sample;
  size_t channels;

  size_t sample_bytes() const { return sample == kU16 ? 2 : 1; }
  bool is_read() const {
    return (sample == kU8 || sample == kU16) && (channels == 1 || channels == 3 || channels == 4);
  }
  std::string name() const {
    constexpr std::string_view kSamples[] = {"8U", "8S", "16U", "16S", "32S", "32F", "64F", "16F"};
    return text(kSamples[sample], "C", channels);
  }

  static constexpr size_t kU8 = 0;
  static constexpr size_t kU16 = 2;
};

// How many lower bits of samples of 16 bits an image of 8 bits leaves out. jAER's samples have 10 bits. Once
// a sample had more, all are taken to have 12 bits, and then 16.
class SampleBits {
 public:
  int shift(std::span<const uint8_t> samples) {
    uint32_t all = 0;
    for (size_t i = 0; i + 2 <= samples.size(); i += 2) all |= load_little_endian<uint16_t>(&samples[i]);
    if (all >> 10 != 0) shift_ = std::max(shift_, all >> 12 == 0 ? 4 : 8);
    return shift_;
  }

 private:
  int shift_ = 2;
};

class Aedat4Frames final : public FrameSource {
 public:
  Aedat4Frames(std::string name, Packets packets, bool strict)
      : name_(std::move(name)), packets_(std::move(packets)), strict_(strict) {}

  Result<std::optional<GreyFrame>> read() override {
    for (;;) {
      auto packet = packets_.next();
      if (!packet) return packet.error();
      if (!*packet) return std::optional<GreyFrame>();
      Packet& p = **packet;
      if (p.content) {
        auto frame = decode(*p.content, p.damage);
        if (frame) return frame;
      }
      if (strict_) return damage_error(name_, p);
      pass_over(p.byte, std::move(p.damage));
    }
  }

 private:
  std::optional<GreyFrame> decode(const FlatTable& table, std::string& damage) {
    damage = "the frame is broken";
    const auto t = table.number<int64_t>(kT, 0);
    const auto begin = table.number<int64_t>(kExposureBegin, 0);
    const auto end = table.number<int64_t>(kExposureEnd, 0);
    const auto format = table.number<int8_t>(kFormat, 0);
    const auto width = table.number<int16_t>(kWidth, 0);
    const auto height = table.number<int16_t>(kHeight, 0);
    if (!t || !begin || !end || !format || !width || !height) return std::nullopt;
    const PixelType type(*format);
    if (!type.is_read()) {
      damage = text("the frame has pixels of the type ", type.name(),
                    "; scarf reads 8U and 16U with 1, 3 or 4 channels");
      return std::nullopt;
    }
    const auto legal = [](int16_t size) { return size >= 1 && size <= kMaxSensorSize; };
    const auto pixels = table.vector(kPixels, 1);
    if (!legal(*width) || !legal(*height) || !pixels) return std::nullopt;
    GreyFrame frame;
    frame.t = *t;
    frame.exposure_begin = *begin > 0 ? *begin : *t;
    frame.exposure_end = *end > 0 ? *end : *t;
    if (pixels->size() !=
        type.sample_bytes() * type.channels * static_cast<size_t>(*width) * static_cast<size_t>(*height)) {
      return std::nullopt;
    }
    frame.image = Image<uint8_t>(*width, *height);
    const int shift = type.sample == PixelType::kU16 ? bits_.shift(*pixels) : 0;
    const auto sample = [&](size_t i) -> uint32_t {
      if (type.sample == PixelType::kU8) return (*pixels)[i];
      return uint32_t{load_little_endian<uint16_t>(&(*pixels)[2 * i])} >> shift;
    };
    for (size_t i = 0; i < frame.image.pixels.size(); ++i) {
      const size_t first = i * type.channels;
      // Colours come in the order blue, green, red.
      const uint32_t grey =
          type.channels == 1 ? sample(first) : luma(sample(first + 2), sample(first + 1), sample(first));
      frame.image.pixels[i] = static_cast<uint8_t>(grey);
    }
    return frame;
  }

  std::string name_;
  Packets packets_;
  bool strict_;
  SampleBits bits_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> open_frames(Input input, const ReadOptions& options) {
  const std::string name = input.name;
  auto packets = Packets::open(std::move(input), options, "FRME", "frame streams");
  if (!packets) return packets.error();
  return std::unique_ptr<FrameSource>(
      std::make_unique<Aedat4Frames>(name, *std::move(packets), options.strict));
}

}  // namespace scarf::aedat4
