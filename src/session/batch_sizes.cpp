#include "session/batch_sizes.h"

#include "core/parse.h"
#include "core/text.h"

namespace scarf {

size_t BatchSizes::next() {
  if (!generator_) return events_;
  // A random magnitude first, so that batches of one event and of many thousands are both common. No
  // std::uniform_int_distribution: its numbers differ between standard libraries.
  const size_t limit = size_t{2} << (*generator_)() % 17;
  return 1 + (*generator_)() % limit;
}

Result<BatchSizes> parse_batch_sizes(const std::string& word) {
  constexpr std::string_view kRandom = "random";
  if (word == kRandom) return BatchSizes::random(0);
  if (word.starts_with("random:")) {
    if (const auto seed = parse_integer<uint64_t>(word.substr(kRandom.size() + 1)))
      return BatchSizes::random(*seed);
  } else if (const auto events = parse_integer<size_t>(word);
             events && *events >= 1 && *events <= kMaxBatch) {
    return BatchSizes::fixed(*events);
  }
  return Error{ErrorCode::illegal_parameter,
               text("batch is '", word, "', legal is 1 to ", kMaxBatch, " events, random, or random:SEED")};
}

}  // namespace scarf
