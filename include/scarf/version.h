// The version of the headers, and of the library that a program runs with.
#pragma once

#define SCARF_VERSION_MAJOR 0
#define SCARF_VERSION_MINOR 3
#define SCARF_VERSION_PATCH 0
/// One number that grows with every version.
#define SCARF_VERSION (SCARF_VERSION_MAJOR * 1'000'000 + SCARF_VERSION_MINOR * 1'000 + SCARF_VERSION_PATCH)

namespace scarf {

/// SCARF_VERSION of the library.
int version();
/// The same as text: "0.3.0".
const char* version_text();

}  // namespace scarf
