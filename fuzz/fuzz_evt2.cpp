// The words of EVT2.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scarf::check_reader("% evt 2.0\n% geometry 1280x720\n% end\n", {data, size});
  return 0;
}
