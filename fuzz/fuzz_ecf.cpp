// The codecs of HDF5 chunks that are decoded here: ECF, and LZF.
#include <cstdlib>

#include "io/hdf5/ecf_codec.h"
#include "io/hdf5/lzf_filter.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<scarf::Event> events(3);
  const bool good = scarf::hdf5::decode_ecf({data, size}, events).ok();
  if (!good && !events.empty()) std::abort();
  for (const scarf::Event& e : events) {
    if (e.p > 1) std::abort();
  }
  std::vector<uint8_t> bytes(4 * size);
  static_cast<void>(scarf::hdf5::decode_lzf({data, size}, bytes));
  return 0;
}
