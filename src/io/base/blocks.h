// Blocks of known length out of a ByteReader, which may be longer than its buffer.
#pragma once

#include <cstdint>
#include <vector>

#include "io/base/byte_reader.h"

namespace scarf {

/// Reads the next `size` bytes into `block`, which grows only as they come: a false size costs no memory.
/// False: the input ended before, and `block` holds its last bytes. Errors: io.
Result<bool> read_block(ByteReader& input, uint64_t size, std::vector<uint8_t>& block);

/// Passes over the next `size` bytes, or over the rest if it is shorter; returns how many those were.
Result<uint64_t> skip_block(ByteReader& input, uint64_t size);

}  // namespace scarf
