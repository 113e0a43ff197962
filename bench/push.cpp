#include "bench/push.h"

#include <algorithm>
#include <deque>

#include "scarf/device/stream.h"

namespace scarf::bench {
namespace {

// Images that may be on their way before the oldest is waited for.
constexpr size_t kInFlight = 2;
constexpr size_t kQueries = 10;
constexpr size_t kWarmUp = 2 * kEventsPerImage;
constexpr double kLongestRepeat = 10;  // seconds

Result<void> push(Representation& representation, std::span<const Event> events, size_t batch) {
  for (size_t i = 0; i < events.size(); i += batch) {
    const auto pushed = representation.push(events.subspan(i, std::min(batch, events.size() - i)));
    if (!pushed) return pushed.error();
  }
  return {};
}

Result<double> median_query(Representation& representation, std::span<const Event> events) {
  std::vector<double> times;
  for (size_t i = 0; i < kQueries; ++i) {
    const size_t offset = i * kEventsPerImage % events.size();
    const auto some = events.subspan(offset, std::min(kEventsPerImage, events.size() - offset));
    if (auto r = push_and_finish(representation, some, kEventsPerImage); !r) return r.error();
    const auto time = time_query(representation);
    if (!time) return time.error();
    times.push_back(*time);
  }
  return median(times);
}

}  // namespace

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Result<void> push_and_render(Representation& representation, std::span<const Event> events,
                             size_t events_per_image, size_t batch) {
  std::deque<Pending<Image<uint8_t>>> images;
  const auto wait_for_oldest = [&]() -> Result<void> {
    const auto image = images.front().wait();
    images.pop_front();
    return image ? Result<void>() : Result<void>(image.error());
  };
  for (size_t i = 0; i < events.size(); i += events_per_image) {
    const auto some = events.subspan(i, std::min(events_per_image, events.size() - i));
    if (auto r = push(representation, some, batch); !r) return r;
    images.push_back(representation.u8_image());
    if (images.size() > kInFlight) {
      if (auto r = wait_for_oldest(); !r) return r;
    }
  }
  while (!images.empty()) {
    if (auto r = wait_for_oldest(); !r) return r;
  }
  return {};
}

Result<void> push_and_finish(Representation& representation, std::span<const Event> events, size_t batch) {
  if (auto r = push(representation, events, batch); !r) return r;
  auto* device = dynamic_cast<GpuRepresentation*>(&representation);
  return device == nullptr ? Result<void>() : device->finish();
}

Result<double> time_query(Representation& representation) {
  const auto start = Clock::now();
  const auto image = representation.u8_image().wait();
  const double time = seconds_since(start);
  if (!image) return image.error();
  return time;
}

Result<PushTime> time_push(Representation& representation, std::span<const Event> events, int repeats) {
  const auto run = [&](std::span<const Event> some) -> Result<double> {
    const auto start = Clock::now();
    if (auto r = push_and_render(representation, some, kEventsPerImage, kEventsPerImage); !r)
      return r.error();
    return seconds_since(start);
  };
  const auto warm_up = run(events.first(std::min(events.size(), kWarmUp)));
  if (!warm_up) return warm_up.error();
  const auto fitting = static_cast<size_t>(kLongestRepeat / *warm_up * kWarmUp);
  events = events.first(std::min(events.size(), std::max(fitting, kWarmUp)));

  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    if (auto r = representation.reset(); !r) return r.error();
    const auto time = run(events);
    if (!time) return time.error();
    times.push_back(*time);
  }
  const auto query = median_query(representation, events);
  if (!query) return query.error();
  return PushTime{median(times) * 1e9 / static_cast<double>(events.size()), *query * 1e6, events.size()};
}

}  // namespace scarf::bench
