#include "output/renderer.h"

#include <deque>
#include <utility>

#include "scarf/device/replay.h"

namespace scarf {
namespace {

class LiveRenderer final : public Renderer {
 public:
  LiveRenderer(const std::vector<Shown>& shown, std::vector<std::unique_ptr<FrameProduct>> products)
      : shown_(shown), products_(std::move(products)) {}

  Result<void> push(std::span<const Event> events) override {
    for (const Shown& s : shown_) {
      const auto report = s.representation->push(events);
      if (!report) return report.error();
    }
    return {};
  }

  Result<void> ask(const Frame& frame) override {
    for (const auto& product : products_) {
      if (auto r = product->ask(frame); !r) return r;
    }
    return {};
  }

  Result<void> finish() override {
    for (const auto& product : products_) {
      if (auto r = product->finish(); !r) return r;
    }
    return {};
  }

  std::optional<uint64_t> device_bytes() const override {
    std::optional<uint64_t> bytes;
    for (const Shown& s : shown_) {
      const auto* const on_device = dynamic_cast<const GpuRepresentation*>(s.representation.get());
      if (on_device != nullptr) bytes = bytes.value_or(0) + on_device->memory_bytes();
    }
    return bytes;
  }

 private:
  const std::vector<Shown>& shown_;
  const std::vector<std::unique_ptr<FrameProduct>> products_;
};

class ReplayRenderer final : public Renderer {
 public:
  Result<void> start(std::shared_ptr<GpuContext> context, const Geometry& geometry, double accumulation,
                     const MakeWriter& make_writer) {
    auto replay = make_gpu_replay<uint8_t>(
        std::move(context), geometry, [this](const ReplayFrame<uint8_t>& frame) { return write(frame); },
        accumulation);
    if (!replay) return replay.error();
    replay_ = *std::move(replay);
    auto writer = make_writer();
    if (!writer) return writer.error();
    writer_ = *std::move(writer);
    return {};
  }

  Result<void> push(std::span<const Event> events) override {
    const auto report = replay_->push(events);
    return report ? Result<void>() : report.error();
  }

  Result<void> ask(const Frame& frame) override {
    asked_.push_back(frame);
    return replay_->frame();
  }

  Result<void> finish() override {
    if (auto r = replay_->finish(); !r) return r;
    return writer_->finish();
  }

  std::optional<uint64_t> device_bytes() const override { return replay_->memory_bytes(); }

 private:
  Result<void> write(const ReplayFrame<uint8_t>& frame) {
    const PictureView picture(frame.sensor, frame.pixels);
    const Frame asked = asked_.front();
    asked_.pop_front();
    return writer_->write(asked, picture);
  }

  std::deque<Frame> asked_;  // and not written yet
  std::unique_ptr<FrameWriter> writer_;
  std::unique_ptr<Replay> replay_;
};

}  // namespace

std::unique_ptr<Renderer> make_live_renderer(const std::vector<Shown>& shown,
                                             std::vector<std::unique_ptr<FrameProduct>> products) {
  return std::make_unique<LiveRenderer>(shown, std::move(products));
}

Result<std::unique_ptr<Renderer>> make_replay_renderer(std::shared_ptr<GpuContext> context,
                                                       const Geometry& geometry, double accumulation,
                                                       const MakeWriter& make_writer) {
  auto renderer = std::make_unique<ReplayRenderer>();
  if (auto r = renderer->start(std::move(context), geometry, accumulation, make_writer); !r) return r.error();
  return std::unique_ptr<Renderer>(std::move(renderer));
}

}  // namespace scarf
