// The records of DAT, and what stands before them.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scarf::check_reader("% Version 2\n% Width 1280\n% Height 720\n% end\n", {data, size});
  return 0;
}
