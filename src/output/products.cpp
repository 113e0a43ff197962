#include "output/products.h"

#include <utility>

#include "output/mosaic.h"
#include "output/pictures.h"
#include "scarf/device/encoder.h"

namespace scarf {
namespace {

using Images = std::vector<Image<uint8_t>>;

// All images of a frame, once each is there.
Pending<Images> all_of(std::vector<Pending<Image<uint8_t>>> pending) {
  const auto shared = std::make_shared<std::vector<Pending<Image<uint8_t>>>>(std::move(pending));
  const auto ready = [shared] {
    for (const auto& p : *shared) {
      if (!p.ready()) return false;
    }
    return true;
  };
  const auto wait = [shared]() -> Result<Images> {
    Images images;
    for (auto& p : *shared) {
      auto image = p.wait();
      if (!image) return image.error();
      images.push_back(*std::move(image));
    }
    return images;
  };
  return Pending<Images>(ready, wait);
}

}  // namespace

std::unique_ptr<FrameProduct> picture_product(const std::vector<Shown>& shown,
                                              std::unique_ptr<FrameWriter> given) {
  const std::shared_ptr<FrameWriter> writer = std::move(given);
  const auto ask = [&shown](const Frame& frame) {
    std::vector<Pending<Image<uint8_t>>> images;
    for (const Shown& s : shown) images.push_back(s.representation->u8_image(frame.t));
    return all_of(std::move(images));
  };
  const auto write = [&shown, writer](const Frame& frame, const Images& images) {
    if (images.size() == 1) return writer->write(frame, images.front());
    std::vector<Tile> tiles;
    for (size_t i = 0; i < images.size(); ++i) tiles.push_back({shown[i].title, images[i]});
    return writer->write(frame, mosaic(tiles));
  };
  return std::make_unique<PendingProduct<Images>>(ask, write, [writer] { return writer->finish(); });
}

std::unique_ptr<FrameProduct> float_product(Representation& representation,
                                            std::unique_ptr<FrameWriter> given) {
  const std::shared_ptr<FrameWriter> writer = std::move(given);
  return std::make_unique<PendingProduct<Image<float>>>(
      [&representation](const Frame& frame) { return representation.float_image(frame.t); },
      [writer](const Frame& frame, const Image<float>& image) { return writer->write(frame, image); },
      [writer] { return writer->finish(); });
}

std::unique_ptr<FrameProduct> event_product(Representation& representation,
                                            std::unique_ptr<EventListWriter> given) {
  const std::shared_ptr<EventListWriter> writer = std::move(given);
  return std::make_unique<PendingProduct<std::vector<Event>>>(
      [&representation](const Frame&) { return representation.events(); },
      [writer](const Frame& frame, const std::vector<Event>& events) { return writer->write(frame, events); },
      [writer] { return writer->finish(); });
}

Result<std::unique_ptr<FrameProduct>> tensor_product(Representation& representation,
                                                     const EncodingParameters& encoding,
                                                     const std::string& path, const OutputRule& rule) {
  const EncodingShape shape = shape_of(encoding, representation.sensor());
  auto created = create_hdf5_arrays(path, kHdf5Tensors, Hdf5Element::f32,
                                    {static_cast<size_t>(shape.planes), static_cast<size_t>(shape.height),
                                     static_cast<size_t>(shape.width)},
                                    rule);
  if (!created) return created.error();
  const std::shared_ptr<Hdf5ArrayWriter> writer = *std::move(created);

  std::shared_ptr<GpuEncoder> on_device;
  auto* const scarf = dynamic_cast<GpuScarf*>(&representation);
  if (scarf != nullptr && !info_of(encoding).cpu_only) {
    auto encoder = make_gpu_encoder(*scarf, encoding);
    if (!encoder) return encoder.error();
    on_device = *std::move(encoder);
  }
  const auto ask = [on_device, &representation, encoding](const Frame&) {
    if (on_device) return on_device->encode();
    return representation.events().then<Image<float>>(
        [encoding, sensor = representation.sensor()](const std::vector<Event>& events) {
          return encode(encoding, sensor, events);
        });
  };
  const auto write = [writer](const Frame& frame, const Image<float>& tensor) {
    return writer->write(frame, std::span(tensor.pixels));
  };
  return std::unique_ptr<FrameProduct>(
      std::make_unique<PendingProduct<Image<float>>>(ask, write, [writer] { return writer->finish(); }));
}

}  // namespace scarf
