// Recognition and headers.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scarf::check_reader("", {data, size});
  return 0;
}
