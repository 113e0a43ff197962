// A consumer of the rules and values alone, through the header of everything.
#include <scarf/scarf.h>

#include <string>

#include "check.h"

int main() {
  CHECK(scarf::version() == SCARF_VERSION);
  CHECK(scarf::version_text() == std::string(EXPECTED_VERSION));
  CHECK(std::to_string(SCARF_VERSION_MAJOR) + "." + std::to_string(SCARF_VERSION_MINOR) + "." +
            std::to_string(SCARF_VERSION_PATCH) ==
        EXPECTED_VERSION);
  CHECK(scarf::make_geometry(scarf::Preset::light, {64, 64}).ok());
  CHECK(!scarf::make_geometry(scarf::Preset::light, {0, 0}).ok());
}
