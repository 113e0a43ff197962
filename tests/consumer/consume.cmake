# Configures, builds and runs the consumer in tests/consumer/project. WAY is find_package or add_subdirectory.
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(scarf)
if(WAY STREQUAL "find_package")
  # The copy of a prefix must work as well as the prefix itself.
  step("${CMAKE_COMMAND}" --install "${SCARF_BUILD}" --prefix "${WORK}/installed")
  file(RENAME "${WORK}/installed" "${WORK}/moved")
  set(scarf "-DCMAKE_PREFIX_PATH=${WORK}/moved")
else()
  set(scarf "-DSCARF_SOURCE=${SCARF_SOURCE}")
endif()
step("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/project" -B "${WORK}/build" -G "${GENERATOR}"
  -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
  "-DEXAMPLE=${SCARF_SOURCE}/examples/velocity_invariant.cpp" ${scarf})
step("${CMAKE_COMMAND}" --build "${WORK}/build")
step("${CMAKE_COMMAND}" -E chdir "${WORK}" "${WORK}/build/example")
step("${WORK}/build/reference")
if(NOT EXISTS "${WORK}/bar.pgm")
  message(FATAL_ERROR "the example wrote no picture")
endif()
