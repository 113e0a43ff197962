#include "tools/renderer.h"

#include <deque>
#include <utility>

#include "tools/mosaic.h"
#include "tools/pictures.h"

namespace scarf::tools {
namespace {

constexpr size_t kFramesInFlight = 4;  // enough for a device to work while earlier frames are encoded

class LiveRenderer final : public Renderer {
 public:
  explicit LiveRenderer(std::vector<Shown> shown) : shown_(std::move(shown)) {}

  Result<void> push(std::span<const Event> events) override {
    for (const Shown& s : shown_) {
      const auto report = s.representation->push(events);
      if (!report) return report.error();
    }
    return {};
  }

  Result<void> ask(const Frame& frame) override {
    InFlight asked{frame, {}};
    for (const Shown& s : shown_) asked.images.push_back(s.representation->u8_image(frame.t));
    in_flight_.push_back(std::move(asked));
    ++frames_;
    return in_flight_.size() > kFramesInFlight ? write_oldest() : Result<void>();
  }

  Result<void> finish() override {
    while (!in_flight_.empty()) {
      if (auto r = write_oldest(); !r) return r;
    }
    return writer().finish();
  }

  uint64_t frames() const override { return frames_; }

 private:
  struct InFlight {
    Frame frame;
    std::vector<Pending<Image<uint8_t>>> images;
  };

  Result<void> write_oldest() {
    InFlight oldest = std::move(in_flight_.front());
    in_flight_.pop_front();
    std::vector<Image<uint8_t>> images;
    for (auto& pending : oldest.images) {
      auto image = pending.wait();
      if (!image) return image.error();
      images.push_back(*std::move(image));
    }
    if (images.size() == 1) return writer().write(oldest.frame, as_picture(images.front()));
    std::vector<Tile> tiles;
    for (size_t i = 0; i < images.size(); ++i) tiles.push_back({shown_[i].title, as_picture(images[i])});
    return writer().write(oldest.frame, mosaic(tiles));
  }

  const std::vector<Shown> shown_;
  std::deque<InFlight> in_flight_;
  uint64_t frames_ = 0;
};

class ReplayRenderer final : public Renderer {
 public:
  Result<void> start(std::shared_ptr<GpuContext> context, const Geometry& geometry, double accumulation) {
    auto made = make_gpu_replay<uint8_t>(
        std::move(context), geometry, [this](const ReplayFrame<uint8_t>& frame) { return write(frame); },
        accumulation);
    if (!made) return made.error();
    replay_ = std::move(*made);
    return {};
  }

  Result<void> push(std::span<const Event> events) override {
    const auto report = replay_->push(events);
    return report ? Result<void>() : report.error();
  }

  Result<void> ask(const Frame& frame) override {
    asked_.push_back(frame);
    ++frames_;
    return replay_->frame();
  }

  Result<void> finish() override {
    if (auto r = replay_->finish(); !r) return r;
    return writer().finish();
  }

  uint64_t frames() const override { return frames_; }

 private:
  Result<void> write(const ReplayFrame<uint8_t>& frame) {
    const cv::Mat picture(frame.sensor.height, frame.sensor.width, CV_8UC1,
                          const_cast<uint8_t*>(frame.pixels.data()));
    const Frame asked = asked_.front();
    asked_.pop_front();
    return writer().write(asked, picture);
  }

  std::deque<Frame> asked_;  // and not written yet
  uint64_t frames_ = 0;
  std::unique_ptr<Replay> replay_;
};

}  // namespace

std::unique_ptr<Renderer> make_live_renderer(std::vector<Shown> shown) {
  return std::make_unique<LiveRenderer>(std::move(shown));
}

Result<std::unique_ptr<Renderer>> make_replay_renderer(std::shared_ptr<GpuContext> context,
                                                       const Geometry& geometry, double accumulation) {
  auto renderer = std::make_unique<ReplayRenderer>();
  if (auto r = renderer->start(std::move(context), geometry, accumulation); !r) return r.error();
  return std::unique_ptr<Renderer>(std::move(renderer));
}

}  // namespace scarf::tools
