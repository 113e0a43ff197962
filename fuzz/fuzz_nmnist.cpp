// N-MNIST, which has no header.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scarf::check_reader("", {data, size}, {scarf::SensorSize{34, 34}, "nmnist"});
  return 0;
}
