// Files that are written as a whole: they appear complete or not at all.
#pragma once

#include <string>
#include <string_view>

#include "io/files/output_files.h"
#include "scarf/core/result.h"

namespace scarf {

/// Errors: as OutputFile::create; io, also for a disk that is full.
Result<void> write_file(const std::string& path, std::string_view content, const OutputRule& rule);

}  // namespace scarf
