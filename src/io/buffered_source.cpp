#include "io/buffered_source.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace scarf {
namespace {

// Events decoded in one go: few enough to be still in the first-level cache when they are counted.
constexpr size_t kChunk = 1024;

}  // namespace

BufferedSource::BufferedSource(ByteReader input, std::string name, std::optional<SensorSize> sensor)
    : tally_(sensor), input_(std::move(input)), name_(std::move(name)) {}

Result<size_t> BufferedSource::read(std::span<Event> out) {
  size_t count = 0;
  while (count < out.size()) {
    const auto chunk = out.subspan(count, std::min(out.size() - count, kChunk));
    const Decoded decoded = decode(input_.available(), input_.ended(), chunk);
    input_.skip(decoded.bytes);
    count += decoded.events;
    if (!decoded.starved) continue;
    // Refilled only with empty hands: a pipe's events are not held back, and an error costs no event.
    if (count > 0) break;
    if (input_.ended()) {
      tally_.report.truncated_bytes += input_.available().size();
      input_.skip(input_.available().size());
      break;
    }
    if (const auto refilled = input_.refill(); !refilled) {
      return Error{refilled.error().code, text(name_, ": ", refilled.error().message)};
    }
  }
  return count;
}

}  // namespace scarf
