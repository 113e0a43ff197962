// Dumps of states: any bytes are patches whose events belong to them, or an error.
#include "compare/state_dump.h"
#include "fuzz/fuzz_reader.h"
#include "fuzz/input_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const scarf::InputFolder folder;
  auto dump = scarf::StateDump::open(folder.put("state", {data, size}));
  if (!dump) return 0;
  for (int64_t patch = 0; patch < dump->geometry().patches(); ++patch) {
    const auto read = dump->next();
    if (!read) return 0;
    scarf::require(read->slots.size() <= static_cast<size_t>(dump->geometry().capacity));
  }
  (void)dump->finish();
  return 0;
}
