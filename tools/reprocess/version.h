// Which program made a result.
#pragma once

#include <string>

namespace scarf::tools::reprocess {

/// Version and commit.
inline std::string version() {
  return SCARF_VERSION " (" SCARF_COMMIT ")";
}

}  // namespace scarf::tools::reprocess
