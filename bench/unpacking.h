// The decompression that a reader cannot do without, alone.
#pragma once

#include <string>
#include <string_view>

#include "scarf/core/result.h"
#include "scarf/io/recordings.h"

namespace scarf::bench {

/// Reads and unpacks the blocks of a recording's events, and looks at none of them: AEDAT4 packets, HDF5
/// chunks. False: the format, a name of formats(), has no such blocks. Errors: bad_input, io.
Result<bool> unpack_blocks(const std::string& path, std::string_view format, const ReadOptions& options);

}  // namespace scarf::bench
