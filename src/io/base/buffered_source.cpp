#include "io/base/buffered_source.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace scarf {
namespace {

// Events decoded in one go: few enough to be still in the first-level cache when they are counted.
constexpr size_t kChunk = 1024;

}  // namespace

BufferedSource::BufferedSource(ByteReader input, std::string name, std::optional<SensorSize> sensor,
                               const ReadOptions& options)
    : tally_(sensor, options), input_(std::move(input)), name_(std::move(name)) {}

BufferedSource::BufferedSource(Input input, std::optional<SensorSize> sensor, const ReadOptions& options)
    : BufferedSource(std::move(input.bytes), std::move(input.name), sensor, options) {
  if (input.header) header_ = std::move(input.header->camera);
}

Result<size_t> BufferedSource::read(std::span<Event> out) {
  size_t count = 0;
  while (count < out.size()) {
    if (tally_.failure()) {
      // What came before it is handed out first.
      if (count > 0) break;
      return Error{tally_.failure()->code, text(name_, ": ", tally_.failure()->message)};
    }
    const auto chunk = out.subspan(count, std::min(out.size() - count, kChunk));
    const uint64_t place = input_.consumed();
    const uint64_t unknown = tally_.report.unknown_words;
    const Decoded decoded = decode(input_.available(), input_.ended(), chunk);
    input_.skip(decoded.bytes);
    count += decoded.events;
    if (tally_.strict() && tally_.report.unknown_words > unknown) {
      tally_.fail({ErrorCode::bad_input,
                   text("bytes ", place, " to ", input_.consumed(), " hold ",
                        tally_.report.unknown_words - unknown, " words or lines that ", format(),
                        " does not define; leave out ReadOptions::strict to pass over them")});
    }
    if (!decoded.starved) continue;
    // Refilled only with empty hands: a pipe's events are not held back, and an error costs no event.
    if (count > 0) break;
    if (input_.ended()) {
      const size_t rest = input_.available().size();
      if (rest == 0) break;
      tally_.report.truncated_bytes += rest;
      if (tally_.strict()) {
        tally_.fail(
            {ErrorCode::bad_input, text("byte ", input_.consumed(), ": the last ", rest,
                                        " bytes are no whole word or line; leave out ReadOptions::strict")});
      }
      input_.skip(rest);
      continue;
    }
    if (const auto refilled = input_.refill(); !refilled) {
      // A broken member of an archive ends there; an input that cannot be read is an error.
      if (refilled.error().code == ErrorCode::bad_input) {
        tally_.note_damage(input_.consumed(), refilled.error().message);
        continue;
      }
      return Error{refilled.error().code, text(name_, ": ", refilled.error().message)};
    }
  }
  return count;
}

}  // namespace scarf
