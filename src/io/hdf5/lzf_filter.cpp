#include "io/hdf5/lzf_filter.h"

#include <hdf5.h>

#include <algorithm>

#include "io/hdf5/dataset.h"

namespace scarf::hdf5 {
namespace {

// 0 is a failure. `values`: versions of the filter and of LZF, bytes of a chunk.
size_t filter(unsigned flags, size_t count, const unsigned values[], size_t bytes, size_t* capacity,
              void** buffer) {
  if ((flags & H5Z_FLAG_REVERSE) == 0 || count < 3 || values[2] == 0 || values[2] > kMaxChunkBytes) return 0;
  const size_t size = values[2];
  void* const out = H5allocate_memory(size, /*clear=*/false);
  if (out == nullptr) return 0;
  if (!decode_lzf({static_cast<const uint8_t*>(*buffer), bytes}, {static_cast<uint8_t*>(out), size})) {
    H5free_memory(out);
    return 0;
  }
  H5free_memory(*buffer);
  *buffer = out;
  *capacity = size;
  return size;
}

}  // namespace

bool decode_lzf(std::span<const uint8_t> bytes, std::span<uint8_t> out) {
  size_t from = 0;
  size_t to = 0;
  while (from < bytes.size()) {
    const size_t control = bytes[from++];
    size_t length = control >> 5;
    if (length == 0) {
      length = control + 1;
      if (length > bytes.size() - from || length > out.size() - to) return false;
      std::copy_n(&bytes[from], length, &out[to]);
      from += length;
      to += length;
      continue;
    }
    if (length == 7) {
      if (from == bytes.size()) return false;
      length += bytes[from++];
    }
    if (from == bytes.size()) return false;
    const size_t distance = ((control & 31) << 8 | bytes[from++]) + 1;
    length += 2;
    if (distance > to || length > out.size() - to) return false;
    // One by one: what is copied may be what was just written.
    for (const size_t end = to + length; to < end; ++to) out[to] = out[to - distance];
  }
  return to == out.size();
}

void register_lzf() {
  static const bool done = [] {
    const H5Z_class2_t lzf = {H5Z_CLASS_T_VERS, kLzfFilter, 0, 1, "lzf", nullptr, nullptr, filter};
    return H5Zregister(&lzf) >= 0;
  }();
  static_cast<void>(done);
}

}  // namespace scarf::hdf5
