#include "bench/wire.h"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <limits>
#include <vector>

#include "layout/event_packer.h"

namespace scarf::bench {
namespace {

constexpr size_t kSubmission = size_t{1} << 20;
// What push copies at a time where a batch is larger than the caches.
constexpr size_t kBatch = 100'000;

// Of this thread, not of a clock on the wall: others may be at work.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// `take`: called with every batch; `end`: called when a submission is full.
template <class Take, class End>
double nanoseconds(std::span<const Event> events, Take take, End end) {
  const double start = cpu_seconds();
  for (size_t i = 0; i < events.size(); i += kSubmission) {
    const auto submission = events.subspan(i, std::min(kSubmission, events.size() - i));
    for (size_t k = 0; k < submission.size(); k += kBatch) {
      take(submission.subspan(k, std::min(kBatch, submission.size() - k)), k);
    }
    end();
  }
  return (cpu_seconds() - start) * 1e9 / static_cast<double>(events.size());
}

}  // namespace

WireCost time_wire(std::span<const Event> events, SensorSize sensor, int repeats) {
  std::vector<uint32_t> memory(EventPacker::memory_words(kSubmission));
  std::vector<Event> copy(kSubmission);
  EventPacker packer(sensor, memory.data(), kSubmission);
  constexpr double kNever = std::numeric_limits<double>::max();
  WireCost cost{0, kNever, kNever};
  for (int i = 0; i < repeats; ++i) {
    size_t words = 0;
    const auto pack = [&](std::span<const Event> batch, size_t) { packer.append(batch); };
    const auto end_part = [&] {
      const EventPacker::Part part = packer.part();
      words += part.table_words + part.data_words;
      packer.restart();
    };
    cost.pack_ns = std::min(cost.pack_ns, nanoseconds(events, pack, end_part));
    const auto copy_batch = [&](std::span<const Event> batch, size_t at) {
      std::memcpy(copy.data() + at, batch.data(), batch.size_bytes());
    };
    cost.copy_ns = std::min(cost.copy_ns, nanoseconds(events, copy_batch, [] {}));
    cost.bytes_per_event = static_cast<double>(words * sizeof(uint32_t)) / static_cast<double>(events.size());
  }
  return cost;
}

}  // namespace scarf::bench
