// Twin of shaders/decode/unpack_events.comp.
#include "cpu_ref/stages/decode/unpack_events.h"

#include <algorithm>
#include <cstring>

namespace scarf::stages {

void unpack_events(std::span<const uint32_t> packed, std::span<Event> events,
                   const layout::UnpackPush& push) {
  const uint32_t place_bits = push.x_bits + push.y_bits + 1;
  for (uint32_t first = 0; first < push.events; first += layout::kPackedBlock) {
    const uint32_t* const entry =
        &packed[(push.first_block + first / layout::kPackedBlock) * layout::kPackedTableWords];
    const uint32_t form = entry[0] & 3;
    const uint32_t* const data = &packed[entry[0] >> 2];
    const uint64_t base = entry[1] | uint64_t{entry[2]} << 32;
    const uint32_t count = std::min(layout::kPackedBlock, push.events - first);
    if (form == layout::kPackedRaw) {
      std::memcpy(static_cast<void*>(&events[first]), data, count * sizeof(Event));
      continue;
    }
    const auto* const more = reinterpret_cast<const uint8_t*>(data + count);
    for (uint32_t i = 0; i < count; ++i) {
      uint64_t offset = data[i] >> place_bits;
      for (uint32_t k = 0; k < form; ++k) {
        offset |= uint64_t{more[i * form + k]} << (32 - place_bits + 8 * k);
      }
      events[first + i] = {static_cast<int64_t>(base + offset),
                           static_cast<uint16_t>(data[i] & ((1u << push.x_bits) - 1)),
                           static_cast<uint16_t>(data[i] >> push.x_bits & ((1u << push.y_bits) - 1)),
                           static_cast<uint8_t>(data[i] >> (place_bits - 1) & 1)};
    }
  }
}

}  // namespace scarf::stages
