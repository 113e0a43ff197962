// The words of EVT2.1, in the byte order that the first byte says.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const bool legacy = size > 0 && data[0] % 2 != 0;
  const size_t used = size > 0 ? 1 : 0;
  scarf::check_reader(legacy ? "% format EVT21;endianness=legacy;width=1280;height=720\n% end\n"
                             : "% format EVT21;endianness=little;width=1280;height=720\n% end\n",
                      {data + used, size - used});
  return 0;
}
