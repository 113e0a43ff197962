// Twin of shaders/scarf/scarf_count.comp.
#include "cpu_ref/stages/scarf/stages.h"

namespace scarf::stages {

void scarf_count(std::span<const Event> events, std::span<const uint32_t> classes,
                 std::span<uint32_t> class_counts, const layout::BatchPush& push) {
  for (uint32_t e = 0; e < push.events; ++e) {
    const Event& event = events[push.first_event + e];
    const uint32_t column = classes[std::min<uint32_t>(event.x, push.width)];
    const uint32_t row = classes[push.width + 1 + std::min<uint32_t>(event.y, push.height)];
    class_counts[size_t{e / push.chunk_events} * push.class_words + row * push.class_columns + column] += 1;
  }
}

}  // namespace scarf::stages
