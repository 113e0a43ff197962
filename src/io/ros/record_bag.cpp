#include "io/ros/record_bag.h"

#include <limits>
#include <utility>

#include "io/base/blocks.h"

namespace scarf {

Result<std::optional<RosMessage>> RecordBag::next() {
  for (;;) {
    if (!chunk_.empty()) {
      if (auto message = next_of_chunk()) return message;
      continue;
    }
    if (ended_) return Maybe();
    auto message = next_record();
    if (!message || *message) return message;
  }
}

std::optional<RosMessage> RecordBag::damage(std::string what, uint64_t truncated) const {
  RosMessage message;
  message.byte = byte_;
  message.damage = std::move(what);
  message.truncated = truncated;
  return message;
}

Result<std::optional<RosMessage>> RecordBag::cut_short(std::string what) {
  ended_ = true;
  const auto rest = skip_block(input_, std::numeric_limits<uint64_t>::max());
  if (!rest) return rest.error();
  return damage(std::move(what), input_.consumed() - byte_);
}

}  // namespace scarf
