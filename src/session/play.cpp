#include "session/play.h"

#include <algorithm>
#include <vector>

namespace scarf {
namespace {

// Readers may return less than asked for at any time; a batch has its full size except at the end.
Result<size_t> read_fully(EventSource& source, std::span<Event> out) {
  size_t filled = 0;
  while (filled < out.size()) {
    const auto n = source.read(out.subspan(filled));
    if (!n) return n.error();
    if (*n == 0) break;
    filled += *n;
  }
  return filled;
}

}  // namespace

Result<uint64_t> play(EventSource& source, PlayOptions options, const Audience& audience) {
  std::vector<Event> buffer;
  uint64_t played = 0;
  while (true) {
    const size_t wanted = std::min<uint64_t>(options.batches.next(), options.max_events - played);
    if (buffer.size() < wanted) buffer.resize(wanted);
    const auto filled = read_fully(source, std::span(buffer).first(wanted));
    if (!filled) return filled.error();
    if (*filled == 0) {
      // The source has said so itself, unless it was not asked.
      if (wanted == 0) {
        if (auto r = source.unchanged(); !r) return r.error();
      }
      break;
    }

    std::span<const Event> rest = std::span(buffer).first(*filled);
    const auto hand_out = [&](size_t n) -> Result<void> {
      if (n == 0) return {};
      if (auto r = audience.events(rest.first(n)); !r) return r;
      rest = rest.subspan(n);
      played += n;
      return {};
    };
    if (options.instants) {
      const auto show = [&](const Frame& frame) -> Result<void> {
        if (auto r = hand_out(frame.events - played); !r) return r;
        return audience.frame(frame);
      };
      if (auto r = options.instants->due(rest, show); !r) return r.error();
    }
    if (auto r = hand_out(rest.size()); !r) return r.error();
  }
  if (options.instants) {
    if (auto r = options.instants->due_at_end(audience.frame); !r) return r.error();
  }
  return played;
}

}  // namespace scarf
