# Writes shaders as C++ constants. NAMES: list of shaders; FOLDER/storage/NAME.spv and, of those with views,
# FOLDER/texels/NAME.spv: their SPIR-V; VIEWED: list of those with views; OUTPUT: the header.
cmake_policy(SET CMP0057 NEW)  # IN_LIST
set(text "// Generated from shaders/*.comp.\n#pragma once\n\n#include \"vulkan/shader.h\"\n\nnamespace scarf::shaders {\n")
foreach(name IN LISTS NAMES)
  set(kinds storage)
  if(name IN_LIST VIEWED)
    list(APPEND kinds texels)
  endif()
  foreach(kind IN LISTS kinds)
    file(READ "${FOLDER}/${kind}/${name}.spv" hex HEX)
    # SPIR-V words are little-endian in the file.
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
    string(APPEND text "inline constexpr uint32_t ${name}_${kind}[] = {${words}};\n")
  endforeach()
  list(GET kinds -1 last)
  string(APPEND text "inline constexpr vulkan::Shader ${name} = {${name}_storage, ${name}_${last}};\n")
endforeach()
string(APPEND text "}  // namespace scarf::shaders\n")
# Not touched if nothing changed, so that nothing is compiled again.
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "${text}" @ONLY)
