// Reader of the triggers of AEDAT 3.1: special records of certain kinds.

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/aedat/aedat3.h"

namespace scarf::aedat3 {
namespace {

constexpr size_t kSpecialBytes = 8;  // a word and a time

// What a special record says happened, in bits 7 to 1. Those that are not here mark frames and exposures, or
// wraps and resets of the clock. Inputs 0, 1 and 2 are the external ones; 3 is the camera's own generator. A
// pulse is an edge that rises.
std::optional<Trigger> edge(int64_t t, uint32_t word) {
  switch (word >> 1 & 0x7F) {
    case 2:
    case 4:
      return Trigger{t, 0, 1};
    case 3:
      return Trigger{t, 0, 0};
    case 6:
    case 8:
      return Trigger{t, 1, 1};
    case 7:
      return Trigger{t, 1, 0};
    case 9:
    case 11:
      return Trigger{t, 2, 1};
    case 10:
      return Trigger{t, 2, 0};
    case 12:
      return Trigger{t, 3, 1};
    case 13:
      return Trigger{t, 3, 0};
    default:
      return std::nullopt;
  }
}

class Aedat3Triggers final : public TriggerSource {
 public:
  Aedat3Triggers(std::string name, Packets packets) : name_(std::move(name)), packets_(std::move(packets)) {}

  Result<size_t> read(std::span<Trigger> out) override {
    while (at_ == triggers_.size()) {
      triggers_.clear();
      at_ = 0;
      const auto packet = packets_.next(kSpecial, kSpecialBytes);
      if (!packet) return packet.error();
      if (!*packet) return size_t{0};
      if (!(*packet)->damage.empty()) {
        return Error{ErrorCode::bad_input, text(name_, ": byte ", (*packet)->byte, ": ", (*packet)->damage)};
      }
      if ((*packet)->type == kSpecial) take(**packet);
    }
    const size_t count = std::min(out.size(), triggers_.size() - at_);
    std::copy_n(triggers_.begin() + static_cast<ptrdiff_t>(at_), count, out.begin());
    at_ += count;
    return count;
  }

 private:
  void take(const Packet& packet) {
    for (uint32_t i = 0; i < packet.count; ++i) {
      const auto record = packet.record(i);
      const auto t = packet.time(record, sizeof(uint32_t));
      if (!is_valid(record) || !t) continue;
      if (const auto trigger = edge(*t, load_little_endian<uint32_t>(record.data()))) {
        triggers_.push_back(*trigger);
      }
    }
  }

  std::string name_;
  Packets packets_;
  std::vector<Trigger> triggers_;
  size_t at_ = 0;
};

}  // namespace

Result<std::unique_ptr<TriggerSource>> open_triggers(Input input, const ReadOptions& options) {
  auto packets = Packets::open(std::move(input.bytes), options);
  if (!packets) return packets.error();
  return std::unique_ptr<TriggerSource>(
      std::make_unique<Aedat3Triggers>(std::move(input.name), *std::move(packets)));
}

}  // namespace scarf::aedat3
