// A bar that moves over the sensor, and the picture of it after it has stopped.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <utility>
#include <vector>

#include "scarf/device/stream.h"

template <class T>
T value_of(scarf::Result<T> result) {
  if (result) return *std::move(result);
  std::cerr << "velocity_invariant: " << result.error().message << "\n";
  std::exit(1);
}

int main() {
  const auto context = value_of(scarf::GpuContext::create());
  const auto geometry = value_of(scarf::make_geometry(scarf::Preset::paper, {320, 240}));
  const auto stream = value_of(scarf::make_gpu_scarf(context, geometry));

  std::vector<scarf::Event> events;
  for (uint16_t x = 0; x < 200; ++x) {  // a column per millisecond
    for (uint16_t y = 60; y < 180; ++y) events.push_back({.t = x * 1000, .x = x, .y = y, .p = 1});
  }
  const scarf::PushReport report = value_of(stream->push(events));

  const scarf::Image<uint8_t> image = value_of(stream->u8_image().wait());
  std::ofstream file("bar.pgm", std::ios::binary);
  file << "P5 " << image.width << " " << image.height << " 255\n";
  file.write(reinterpret_cast<const char*>(image.pixels.data()), std::ssize(image.pixels));
  if (!file.flush()) value_of<int>(scarf::Error{scarf::ErrorCode::io, "cannot write bar.pgm"});
  std::cout << report.accepted << " events are bar.pgm on " << context->device().name << "\n";
}
