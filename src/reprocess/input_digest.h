// SHA-256 of a recording as it lies on the disk.
#pragma once

#include <string>
#include <vector>

#include "scarf/core/result.h"

namespace scarf::reprocess {

/// Of a file: over its bytes, as sha256sum. Of a folder: over each regular file below it, in the order of
/// their relative paths: the path, a zero byte, the size (u64, little-endian), the bytes. Not over those in
/// `out`, where the results go. Errors: io.
Result<std::string> input_digest(const std::string& path, const std::string& out);

/// The relative paths of these files, in order. Errors: io.
Result<std::vector<std::string>> files_below(const std::string& folder, const std::string& out);

}  // namespace scarf::reprocess
