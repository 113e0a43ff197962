# Writes shaders as C++ constants, OUTPUT/shaders.h and .cpp. NAMES: list of shaders; FOLDER/storage/NAME.spv and, of those
# with views, FOLDER/texels/NAME.spv: their SPIR-V; VIEWED: list of those with views.
cmake_policy(SET CMP0057 NEW)  # IN_LIST
set(header "// Generated from shaders/*/*.comp.\n#pragma once\n\n#include \"vulkan/shader.h\"\n\nnamespace scarf::shaders {\n")
set(source "// Generated from shaders/*/*.comp.\n#include \"compiled_shaders/shaders.h\"\n\nnamespace scarf::shaders {\nnamespace {\n\n")
set(constants)
foreach(name IN LISTS NAMES)
  set(kinds storage)
  if(name IN_LIST VIEWED)
    list(APPEND kinds texels)
  endif()
  foreach(kind IN LISTS kinds)
    file(READ "${FOLDER}/${kind}/${name}.spv" hex HEX)
    # SPIR-V words are little-endian in the file.
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
    string(APPEND source "constexpr uint32_t ${name}_${kind}[] = {${words}};\n")
  endforeach()
  list(GET kinds -1 last)
  string(APPEND header "extern const vulkan::Shader ${name};\n")
  string(APPEND constants "constinit const vulkan::Shader ${name} = {${name}_storage, ${name}_${last}};\n")
endforeach()
string(APPEND header "}  // namespace scarf::shaders\n")
string(APPEND source "\n}  // namespace\n\n${constants}\n}  // namespace scarf::shaders\n")
# Not touched if nothing changed, so that nothing is compiled again.
file(CONFIGURE OUTPUT "${OUTPUT}/shaders.h" CONTENT "${header}" @ONLY)
file(CONFIGURE OUTPUT "${OUTPUT}/shaders.cpp" CONTENT "${source}" @ONLY)
