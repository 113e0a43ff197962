// SHA-256 of a recording as it lies on the disk.
#pragma once

#include <string>

#include "scarf/result.h"

namespace scarf::tools::reprocess {

/// Of a file: over its bytes, as sha256sum. Of a folder: over each regular file below it, in the order of
/// their relative paths: the path, a zero byte, the size (u64, little-endian), the bytes. Errors: io.
Result<std::string> input_digest(const std::string& path);

}  // namespace scarf::tools::reprocess
