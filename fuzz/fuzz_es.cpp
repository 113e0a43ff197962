// Events of Event Stream: DVS, or ATIS if the first byte is odd.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const bool atis = data[0] % 2 == 1;
  const std::string_view header(
      atis ? "Event Stream\2\0\0\2\x40\1\xF0\0" : "Event Stream\2\0\0\1\x40\1\xF0\0", 20);
  scarf::check_reader(header, {data + 1, size - 1});
  return 0;
}
