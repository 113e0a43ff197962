#include "bench/paper.h"

#include <algorithm>
#include <functional>

#include "bench/push.h"

namespace scarf::bench {
namespace {

constexpr double kRefillRate = 100;  // Hz: a query is measured after the events that come at this rate
constexpr size_t kLeastRepeats = 3;
constexpr size_t kMostRepeats = 200;
constexpr double kTooLong = 20;  // times the seconds that a measurement should take

// `run` does so many pieces of work and returns the seconds that they took. The median time of one piece, out
// of rounds that are long enough to be measured, and of at most `most` pieces.
Result<double> seconds_per_piece(const std::function<Result<double>(size_t)>& run, size_t most,
                                 double seconds) {
  size_t pieces = 1;
  auto time = run(pieces);
  if (time && *time < seconds) time = run(pieces);  // the first was to warm up
  while (time && *time < seconds / 4 && pieces < most) {
    pieces = std::min(2 * pieces, most);
    time = run(pieces);
  }
  if (!time) return time;
  std::vector<double> times = {*time};
  double sum = *time;
  while (times.size() < kMostRepeats && sum < (times.size() < kLeastRepeats ? seconds : seconds / 2)) {
    time = run(pieces);
    if (!time) return time;
    times.push_back(*time);
    sum += *time;
  }
  return median(times) / static_cast<double>(pieces);
}

class Measurement {
 public:
  Measurement(Representation& representation, const Parameters& parameters, EndlessStream& stream,
              double seconds)
      : representation_(representation), stream_(stream), seconds_(seconds) {
    const auto* aae = std::get_if<AaeParameters>(&parameters);
    queries_cut_ = aae != nullptr && !aae->keep;
  }

  Result<double> seconds_per_event() {
    const auto run = [&](size_t batches) -> Result<double> {
      if (auto r = cut_queues(); !r) return r.error();
      const auto events = stream_.next(batches * kBatch);
      const auto start = Clock::now();
      if (auto r = push_and_finish(representation_, events, kBatch); !r) return r.error();
      return seconds_since(start);
    };
    const auto time = seconds_per_piece(run, stream_.size() / kBatch, seconds_);
    if (!time) return time.error();
    return *time / static_cast<double>(kBatch);
  }

  Result<double> seconds_per_query() {
    const size_t refill = stream_.events_per_query(kRefillRate);
    const auto start = Clock::now();
    std::vector<double> times;
    bool warm = false;
    while (times.empty() || (times.size() < kMostRepeats && seconds_since(start) < seconds_)) {
      if (auto r = push_and_finish(representation_, stream_.next(refill), kBatch); !r) return r.error();
      const auto time = time_query(representation_);
      if (!time) return time.error();
      if (warm || *time > seconds_) times.push_back(*time);
      warm = true;
    }
    return median(times);
  }

  Result<double> events_per_second(size_t events_per_query) {
    const auto run = [&](size_t queries) -> Result<double> {
      const auto events = stream_.next(queries * events_per_query);
      const auto start = Clock::now();
      if (auto r = push_and_render(representation_, events, events_per_query, kBatch); !r) return r.error();
      return seconds_since(start);
    };
    const auto time = seconds_per_piece(run, stream_.size() / events_per_query, seconds_);
    if (!time) return time.error();
    return static_cast<double>(events_per_query) / *time;
  }

 private:
  // Queues that only a query cuts must not grow with the length of the measurement.
  Result<void> cut_queues() {
    if (!queries_cut_) return {};
    const auto time = time_query(representation_);
    return time ? Result<void>() : Result<void>(time.error());
  }

  Representation& representation_;
  EndlessStream& stream_;
  const double seconds_;
  bool queries_cut_ = false;
};

}  // namespace

Result<Costs> measure_costs(Representation& representation, const Parameters& parameters,
                            EndlessStream& stream, double seconds) {
  Measurement measurement(representation, parameters, stream, seconds);
  const auto per_event = measurement.seconds_per_event();
  if (!per_event) return per_event.error();
  const auto per_query = measurement.seconds_per_query();
  if (!per_query) return per_query.error();
  Costs costs{.ns_per_event = *per_event * 1e9, .query_us = *per_query * 1e6, .events_per_second = {}};
  for (size_t i = 0; i < kQueryRates.size(); ++i) {
    const size_t events = stream.events_per_query(kQueryRates[i]);
    if (*per_event * static_cast<double>(events) + *per_query > kTooLong * seconds) continue;
    const auto throughput = measurement.events_per_second(events);
    if (!throughput) return throughput.error();
    costs.events_per_second[i] = *throughput;
  }
  return costs;
}

}  // namespace scarf::bench
