// A file that is made at once: one of the many in a scratch folder, which is put on the disk as a whole.
#pragma once

#include <string>
#include <string_view>

#include "scarf/core/result.h"

namespace scarf {

/// Makes a file that must not be there, and does not wait for the disk (see sync_tree). Errors: io.
Result<void> write_new_file(const std::string& path, std::string_view content);

}  // namespace scarf
