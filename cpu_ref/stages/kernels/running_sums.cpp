// Twin of shaders/kernels/running_sums.comp.
#include "cpu_ref/stages/scarf/stages.h"

namespace scarf::stages {

void running_sums(std::span<uint32_t> table, const layout::SumPush& push) {
  for (uint32_t c = 0; c < push.chunks; ++c) {
    for (uint32_t line = 0; line < push.lines; ++line) {
      uint32_t* const first = &table[size_t{c} * push.chunk_words + size_t{line} * push.line_stride];
      for (uint32_t i = 1; i < push.entries; ++i)
        first[size_t{i} * push.entry_stride] += first[size_t{i - 1} * push.entry_stride];
    }
  }
}

}  // namespace scarf::stages
