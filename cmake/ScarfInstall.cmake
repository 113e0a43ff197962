# Install rules: what find_package(scarf) needs, and the program. See scarfConfig.cmake.in for the consumer's side.
include(CMakePackageConfigHelpers)

option(SCARF_INSTALL "Add scarf to what cmake --install installs" ${PROJECT_IS_TOP_LEVEL})
if(NOT SCARF_INSTALL)
  return()
endif()

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/scarf")

# Each component is an export set of its own: only who asks for it needs its libraries.
set(components)
foreach(component core device reference digest simulate io)
  if(NOT TARGET scarf_${component})
    continue()
  endif()
  list(APPEND components ${component})
  set(targets scarf_${component})
  if(component STREQUAL "device")
    list(APPEND targets scarf_scarf)
  endif()
  install(TARGETS ${targets} EXPORT scarf-${component} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT scarf-${component} NAMESPACE scarf:: DESTINATION "${package_folder}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/scarf/${component}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/scarf")
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/include/scarf/scarf.h" "${PROJECT_SOURCE_DIR}/include/scarf/version.h"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/scarf")
if("io" IN_LIST components)
  foreach(package IN LISTS SCARF_IO_PACKAGES)
    install(FILES "${PROJECT_SOURCE_DIR}/cmake/Find${package}.cmake" DESTINATION "${package_folder}")
  endforeach()
endif()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/scarfConfig.cmake.in" "${CMAKE_CURRENT_BINARY_DIR}/scarfConfig.cmake"
  INSTALL_DESTINATION "${package_folder}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/scarfConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/scarfConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/scarfConfigVersion.cmake"
  DESTINATION "${package_folder}")

if(TARGET scarf_program)
  install(TARGETS scarf_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
