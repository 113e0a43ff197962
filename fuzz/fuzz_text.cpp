// The lines of text recordings.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scarf::check_reader("240 180\n0.5 1 2 1\n", {data, size});
  return 0;
}
