#include "scarf/version.h"

#define SCARF_TEXT_OF(x) #x
#define SCARF_TEXT(x) SCARF_TEXT_OF(x)

namespace scarf {

int version() {
  return SCARF_VERSION;
}

const char* version_text() {
  return SCARF_TEXT(SCARF_VERSION_MAJOR) "." SCARF_TEXT(SCARF_VERSION_MINOR) "." SCARF_TEXT(
      SCARF_VERSION_PATCH);
}

}  // namespace scarf
