// Text with columns, units, cameras and first lines of CSV; the first byte chooses among them.
#include <array>

#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  constexpr std::array<std::string_view, 4> kHeaders = {"", "%geometry:240,180\n", "t,x,y,on\n",
                                                        "10 1 2 1 0\n"};
  constexpr std::array<std::string_view, 4> kColumns = {"", "xypt", "txypc", "tx_yp"};
  constexpr std::array<std::string_view, 4> kUnits = {"", "us", "ns", "ms"};
  scarf::ReadOptions options;
  options.format = (data[0] & 64) != 0 ? "csv" : "text";
  options.columns = kColumns[data[0] >> 2 & 3];
  options.time_unit = kUnits[data[0] >> 4 & 3];
  if (options.columns == "txypc") options.stream = "0";
  scarf::check_reader(kHeaders[data[0] & 3], {data + 1, size - 1}, options);
  return 0;
}
