# Writes SPIR-V binaries as C++ arrays. BINARIES: list of .spv files; OUTPUT: the header.
set(text "// Generated from shaders/*.comp.\n#pragma once\n\n#include <cstdint>\n\nnamespace scarf::shaders {\n")
foreach(binary IN LISTS BINARIES)
  get_filename_component(name "${binary}" NAME_WE)
  file(READ "${binary}" hex HEX)
  # SPIR-V words are little-endian in the file.
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
  string(APPEND text "inline constexpr uint32_t ${name}[] = {${words}};\n")
endforeach()
string(APPEND text "}  // namespace scarf::shaders\n")
file(WRITE "${OUTPUT}" "${text}")
