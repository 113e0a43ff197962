#include "bench/push.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <vector>

#include "scarf/gpu.h"

namespace scarf::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Images that may be on their way before the oldest is waited for.
constexpr size_t kInFlight = 2;
constexpr size_t kQueries = 10;

double nanoseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Result<void> push_and_render(Scarf& scarf, std::span<const Event> events) {
  std::deque<Pending<Image<uint8_t>>> images;
  const auto wait_for_oldest = [&]() -> Result<void> {
    const auto image = images.front().wait();
    images.pop_front();
    return image ? Result<void>() : Result<void>(image.error());
  };
  for (size_t i = 0; i < events.size(); i += kEventsPerImage) {
    const auto pushed = scarf.push(events.subspan(i, std::min(kEventsPerImage, events.size() - i)));
    if (!pushed) return pushed.error();
    images.push_back(scarf.u8_image());
    if (images.size() > kInFlight) {
      if (auto r = wait_for_oldest(); !r) return r;
    }
  }
  while (!images.empty()) {
    if (auto r = wait_for_oldest(); !r) return r;
  }
  return {};
}

Result<double> time_queries(Scarf& scarf, std::span<const Event> events) {
  std::vector<double> times;
  for (size_t i = 0; i < kQueries; ++i) {
    const size_t offset = i * kEventsPerImage % events.size();
    const auto pushed = scarf.push(events.subspan(offset, std::min(kEventsPerImage, events.size() - offset)));
    if (!pushed) return pushed.error();
    if (auto* device = dynamic_cast<GpuScarf*>(&scarf)) {
      if (auto r = device->finish(); !r) return r.error();
    }
    const auto start = Clock::now();
    const auto image = scarf.u8_image().wait();
    if (!image) return image.error();
    times.push_back(nanoseconds_since(start) / 1000);
  }
  return median(times);
}

}  // namespace

Result<PushTime> time_push(Scarf& scarf, std::span<const Event> events, int repeats) {
  if (auto r = push_and_render(scarf, events.first(std::min(events.size(), 2 * kEventsPerImage))); !r) {
    return r.error();
  }
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    if (auto r = scarf.reset(); !r) return r.error();
    const auto start = Clock::now();
    if (auto r = push_and_render(scarf, events); !r) return r.error();
    times.push_back(nanoseconds_since(start) / static_cast<double>(events.size()));
  }
  const auto query = time_queries(scarf, events);
  if (!query) return query.error();
  return PushTime{median(times), *query};
}

}  // namespace scarf::bench
