// Which program made a result.
#pragma once

#include <string>

#include "core/text.h"
#include "scarf/version.h"

namespace scarf::reprocess {

/// Version and commit.
inline std::string made_by() {
  return text(version_text(), " (", SCARF_COMMIT, ")");
}

}  // namespace scarf::reprocess
