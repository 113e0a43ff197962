// NumPy arrays: the first byte chooses a header for the rest, or none.
#include <array>
#include <string>

#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  constexpr std::array<std::string_view, 5> kTypes = {
      "", "'<i2', 'fortran_order': False, 'shape': (9, 4)}",
      "'<f4', 'fortran_order': False, 'shape': (99, 4)}",
      "[('x', '<u2'), ('', 'V1'), ('y', '>i4'), ('p', '|b1'), ('t', '<m8[ns]')], 'fortran_order': False, "
      "'shape': (99,)}",
      "[('t', '<f2'), ('x', '<f8'), ('y', '|i1'), ('p', '<u8')], 'fortran_order': False, 'shape': (99,)}"};
  const std::string_view type = kTypes[data[0] % kTypes.size()];
  std::string header("\x93NUMPY\1\0", 8);
  if (!type.empty()) {
    const std::string dictionary = "{'descr': " + std::string(type);
    header += static_cast<char>(dictionary.size());
    header += '\0';
    header += dictionary;
  }
  scarf::check_reader(header, {data + 1, size - 1});
  return 0;
}
