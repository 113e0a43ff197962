// Twin of shaders/scarf_sum.comp.
#include "cpu_ref/stages/stages.h"

namespace scarf::stages {

void scarf_sum(std::span<uint32_t> class_counts, const layout::SumPush& push) {
  for (uint32_t c = 0; c < push.chunks; ++c) {
    for (uint32_t line = 0; line < push.lines; ++line) {
      uint32_t* const first = &class_counts[size_t{c} * push.class_words + size_t{line} * push.line_stride];
      for (uint32_t i = 1; i < push.line_classes; ++i)
        first[size_t{i} * push.class_stride] += first[size_t{i - 1} * push.class_stride];
    }
  }
}

}  // namespace scarf::stages
