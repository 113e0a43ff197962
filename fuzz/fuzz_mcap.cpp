// Records of MCAP behind its magic.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace std::string_view_literals;
  scarf::check_reader("\x89MCAP0\r\n"sv, {data, size});
  return 0;
}
