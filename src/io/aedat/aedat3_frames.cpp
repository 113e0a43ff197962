// Reader of the frames of AEDAT 3.1.

#include <utility>

#include "core/text.h"
#include "io/aedat/aedat3.h"
#include "io/base/luma.h"
#include "scarf/core/patch_grid.h"

namespace scarf::aedat3 {
namespace {

// Bytes of a frame in front of its pixels: a word, four times, and the size and place of the picture.
constexpr size_t kFrameBytes = 36;

// The upper half of a pixel's 16 bits, over which libcaer spreads the values of all cameras.
uint32_t upper(const uint8_t* pixel) {
  return pixel[1];
}

class Aedat3Frames final : public FrameSource {
 public:
  Aedat3Frames(std::string name, Packets packets, bool strict)
      : name_(std::move(name)), packets_(std::move(packets)), strict_(strict) {}

  Result<std::optional<GreyFrame>> read() override {
    for (;;) {
      while (next_ < packet_.count) {
        const auto record = packet_.record(next_++);
        if (!is_valid(record)) continue;
        std::string damage;
        auto frame = decode(record, damage);
        if (frame) return frame;
        if (auto r = passed(std::move(damage)); !r) return r.error();
      }
      auto packet = packets_.next(kFrame, kFrameBytes);
      if (!packet) return packet.error();
      if (!*packet) return std::optional<GreyFrame>();
      packet_ = **std::move(packet);
      next_ = packet_.damage.empty() && packet_.type == kFrame ? 0 : packet_.count;
      if (packet_.damage.empty()) continue;
      if (auto r = passed(packet_.damage); !r) return r.error();
    }
  }

 private:
  std::optional<GreyFrame> decode(std::span<const uint8_t> record, std::string& damage) const {
    const auto word = load_little_endian<uint32_t>(record.data());
    const auto width = load_little_endian<int32_t>(record.data() + 20);
    const auto height = load_little_endian<int32_t>(record.data() + 24);
    const size_t channels = word >> 1 & 7;
    if (channels != 1 && channels != 3 && channels != 4) {
      damage = text("the frame has ", channels, " channels; scarf reads grey, RGB and RGBA");
      return std::nullopt;
    }
    const auto begin = packet_.time(record, 12);
    const auto end = packet_.time(record, 16);
    const auto legal = [](int32_t size) { return size >= 1 && size <= kMaxSensorSize; };
    damage = "the frame is broken";
    if (!begin || !end || !legal(width) || !legal(height)) return std::nullopt;
    const size_t pixel_bytes = 2 * channels;
    const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
    if (pixels > (record.size() - kFrameBytes) / pixel_bytes) return std::nullopt;
    GreyFrame frame;
    frame.t = *begin + (*end - *begin) / 2;
    frame.exposure_begin = *begin;
    frame.exposure_end = *end;
    frame.image = Image<uint8_t>(width, height);
    const uint8_t* pixel = record.data() + kFrameBytes;
    for (uint8_t& grey : frame.image.pixels) {
      grey = static_cast<uint8_t>(channels == 1 ? upper(pixel)
                                                : luma(upper(pixel), upper(pixel + 2), upper(pixel + 4)));
      pixel += pixel_bytes;
    }
    return frame;
  }

  Result<void> passed(std::string damage) {
    if (strict_) {
      return Error{ErrorCode::bad_input, text(name_, ": byte ", packet_.byte, ": ", damage,
                                              "; leave out ReadOptions::strict to read the rest")};
    }
    pass_over(packet_.byte, std::move(damage));
    return {};
  }

  std::string name_;
  Packets packets_;
  bool strict_;
  Packet packet_;
  uint32_t next_ = 0;  // of the packet's records
};

}  // namespace

Result<std::unique_ptr<FrameSource>> open_frames(Input input, const ReadOptions& options) {
  auto packets = Packets::open(std::move(input.bytes), options);
  if (!packets) return packets.error();
  return std::unique_ptr<FrameSource>(
      std::make_unique<Aedat3Frames>(std::move(input.name), *std::move(packets), options.strict));
}

}  // namespace scarf::aedat3
