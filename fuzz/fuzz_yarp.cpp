// Lines of YARP logs behind a first packet; the first byte chooses version and options.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  scarf::ReadOptions options;
  const bool escaped = (data[0] & 1) != 0;
  // Without a choice the second camera ends the reading.
  options.stream = (data[0] & 2) != 0 ? "right" : "left";
  if ((data[0] & 4) != 0 && escaped) options.yarp_time = "spread";
  scarf::check_reader(escaped ? "1 0.5 AE 3 \"\\0\\0\\0\\0\"\n2 0.6 AE 9 \"" : "1 0.5 AE (1 2)\n2 0.6 AE (",
                      {data + 1, size - 1}, options);
  return 0;
}
