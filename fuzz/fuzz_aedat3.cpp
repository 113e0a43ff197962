// Packets of AEDAT 3.1, or the header as well if the first byte is odd.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string_view header =
      data[0] % 2 == 1 ? "#!AER-DAT3.1\r\n#" : "#!AER-DAT3.1\r\n#Source 1: DVS128\r\n#!END-HEADER\r\n";
  scarf::check_reader(header, {data + 1, size - 1});
  return 0;
}
