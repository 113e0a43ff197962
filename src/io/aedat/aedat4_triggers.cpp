// Reader of the triggers of AEDAT4.

#include <algorithm>
#include <utility>

#include "io/aedat/aedat4.h"

namespace scarf::aedat4 {
namespace {

// What a record says happened. Those that are not here mark frames and exposures, or a reset of the clock.
enum Source : int8_t {
  kExternalRising = 1,
  kExternalFalling = 2,
  kExternalPulse = 3,
  kGeneratorRising = 4,
  kGeneratorFalling = 5,
};

// Input 0 is the external signal, input 1 the camera's own generator. A pulse is an edge that rises.
std::optional<Trigger> edge(int64_t t, int8_t source) {
  switch (source) {
    case kExternalRising:
    case kExternalPulse:
      return Trigger{t, 0, 1};
    case kExternalFalling:
      return Trigger{t, 0, 0};
    case kGeneratorRising:
      return Trigger{t, 1, 1};
    case kGeneratorFalling:
      return Trigger{t, 1, 0};
    default:
      return std::nullopt;
  }
}

class Aedat4Triggers final : public TriggerSource {
 public:
  Aedat4Triggers(std::string name, Packets packets) : name_(std::move(name)), packets_(std::move(packets)) {}

  Result<size_t> read(std::span<Trigger> out) override {
    while (at_ == triggers_.size()) {
      const auto packet = packets_.next();
      if (!packet) return packet.error();
      if (!*packet) return size_t{0};
      triggers_.clear();
      at_ = 0;
      if (Packet p = **packet; !take(p)) return damage_error(name_, p);
    }
    const size_t count = std::min(out.size(), triggers_.size() - at_);
    std::copy_n(triggers_.begin() + static_cast<ptrdiff_t>(at_), count, out.begin());
    at_ += count;
    return count;
  }

 private:
  // False: the packet is damaged.
  bool take(Packet& packet) {
    if (!packet.content) return false;
    packet.damage = "the packet's triggers lie outside it";
    const auto count = packet.content->table_count(0);
    if (!count) return false;
    for (size_t i = 0; i < *count; ++i) {
      const auto record = packet.content->table(0, i);
      if (!record) return false;
      const auto t = record->number<int64_t>(0, 0);
      const auto source = record->number<int8_t>(1, 0);
      if (!t || !source) return false;
      if (const auto trigger = edge(*t, *source)) triggers_.push_back(*trigger);
    }
    return true;
  }

  std::string name_;
  Packets packets_;
  std::vector<Trigger> triggers_;
  size_t at_ = 0;
};

}  // namespace

Result<std::unique_ptr<TriggerSource>> open_triggers(Input input, const ReadOptions& options) {
  const std::string name = input.name;
  auto packets = Packets::open(std::move(input), options, "TRIG", "trigger streams");
  if (!packets) return packets.error();
  return std::unique_ptr<TriggerSource>(std::make_unique<Aedat4Triggers>(name, *std::move(packets)));
}

}  // namespace scarf::aedat4
