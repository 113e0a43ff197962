#include "tools/renderer.h"

#include <utility>

#include "tools/mosaic.h"
#include "tools/pictures.h"

namespace scarf::tools {
namespace {

constexpr size_t kFramesInFlight = 4;  // enough for a device to work while earlier frames are encoded

}  // namespace

Result<void> Renderer::push(std::span<const Event> events) {
  for (const Shown& s : shown_) {
    const auto report = s.representation->push(events);
    if (!report) return report.error();
  }
  return {};
}

Result<void> Renderer::ask(const Frame& frame) {
  InFlight asked{frame, {}};
  for (const Shown& s : shown_) asked.images.push_back(s.representation->u8_image(frame.t));
  in_flight_.push_back(std::move(asked));
  ++frames_;
  return in_flight_.size() > kFramesInFlight ? write_oldest() : Result<void>();
}

Result<void> Renderer::finish() {
  while (!in_flight_.empty()) {
    if (auto r = write_oldest(); !r) return r;
  }
  return writer_.finish();
}

Result<void> Renderer::write_oldest() {
  InFlight oldest = std::move(in_flight_.front());
  in_flight_.pop_front();
  std::vector<Image<uint8_t>> images;
  for (auto& pending : oldest.images) {
    auto image = pending.wait();
    if (!image) return image.error();
    images.push_back(*std::move(image));
  }
  if (images.size() == 1) return writer_.write(oldest.frame, as_picture(images.front()));
  std::vector<Tile> tiles;
  for (size_t i = 0; i < images.size(); ++i) tiles.push_back({shown_[i].title, as_picture(images[i])});
  return writer_.write(oldest.frame, mosaic(tiles));
}

}  // namespace scarf::tools
