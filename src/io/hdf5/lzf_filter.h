// LZF, the compression that h5py brings with it and libhdf5 lacks (filter 32000), for reading.
// Source: the format of liblzf, and h5py's filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace scarf::hdf5 {

inline constexpr int kLzfFilter = 32000;

/// Fills `out`. False: the bytes do not give exactly that many.
bool decode_lzf(std::span<const uint8_t> bytes, std::span<uint8_t> out);

/// Lets libhdf5 decompress LZF, in place of a plugin.
void register_lzf();

}  // namespace scarf::hdf5
