# Installs the build to INSTALLED. The copy of a prefix must work as well as the prefix itself.
include("${CMAKE_CURRENT_LIST_DIR}/step.cmake")
file(REMOVE_RECURSE "${INSTALLED}" "${INSTALLED}_first")
step("${CMAKE_COMMAND}" --install "${SCARF_BUILD}" --prefix "${INSTALLED}_first")
file(RENAME "${INSTALLED}_first" "${INSTALLED}")
