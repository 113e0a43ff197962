#include "io/base/block_source.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace scarf {

BlockSource::BlockSource(std::string name, std::optional<SensorSize> sensor, const ReadOptions& options)
    : tally_(sensor, options), name_(std::move(name)) {}

Result<size_t> BlockSource::read(std::span<Event> out) {
  for (;;) {
    if (tally_.failure()) return Error{tally_.failure()->code, text(name_, ": ", tally_.failure()->message)};
    if (at_ < block_.size()) {
      const size_t count = std::min(out.size(), block_.size() - at_);
      std::copy_n(block_.begin() + static_cast<ptrdiff_t>(at_), count, out.begin());
      at_ += count;
      // Only what is handed out is counted, so that the report never runs ahead of the events.
      if (const size_t kept = tally_.keep(out.first(count)); kept > 0) return kept;
      continue;
    }
    if (ended_) return size_t{0};
    block_.clear();
    at_ = 0;
    const auto more = next(block_);
    if (!more) return Error{more.error().code, text(name_, ": ", more.error().message)};
    ended_ = !*more;
  }
}

}  // namespace scarf
