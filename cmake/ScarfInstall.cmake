# Install rules: what find_package(scarf) needs, and the program. See scarfConfig.cmake.in for the consumer's side.
include(CMakePackageConfigHelpers)

# Public names, the same after add_subdirectory and after find_package. scarf_gpu is scarf::scarf already.
foreach(component core vulkan cpu_ref io digest simulate)
  if(TARGET scarf_${component})
    set_target_properties(scarf_${component} PROPERTIES EXPORT_NAME ${component})
    add_library(scarf::${component} ALIAS scarf_${component})
  endif()
endforeach()

option(SCARF_INSTALL "Add scarf to what cmake --install installs" ${PROJECT_IS_TOP_LEVEL})
if(NOT SCARF_INSTALL)
  return()
endif()

# scarf_component(TARGET [EXPORT set] HEADERS ...): installs a library, if it is built, and the headers that need it.
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/scarf")
set(known_headers)
function(scarf_component target)
  cmake_parse_arguments(ARG "" "EXPORT" "HEADERS" ${ARGN})
  list(APPEND known_headers ${ARG_HEADERS})
  set(known_headers "${known_headers}" PARENT_SCOPE)
  if(NOT TARGET ${target})
    return()
  endif()
  if(NOT ARG_EXPORT)
    set(ARG_EXPORT scarfTargets)
  endif()
  install(TARGETS ${target} EXPORT ${ARG_EXPORT} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  list(TRANSFORM ARG_HEADERS PREPEND "${PROJECT_SOURCE_DIR}/include/scarf/")
  install(FILES ${ARG_HEADERS} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/scarf")
endfunction()

scarf_component(scarf_core HEADERS encoding.h event.h filter.h geometry.h image.h parameters.h pending.h read_report.h representation.h result.h scarf.h)
scarf_component(scarf_vulkan)
scarf_component(scarf_gpu HEADERS gpu.h gpu_decoding.h gpu_encoding.h gpu_group.h replay.h)
scarf_component(scarf_cpu_ref HEADERS reference.h)
scarf_component(scarf_simulate HEADERS simulate.h)
# Sets of their own: only who asks for these components needs their libraries.
scarf_component(scarf_io EXPORT scarfIoTargets HEADERS frames.h io.h word_source.h)
scarf_component(scarf_digest EXPORT scarfDigestTargets HEADERS digest.h)

file(GLOB headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include/scarf" "${PROJECT_SOURCE_DIR}/include/scarf/*.h")
list(REMOVE_ITEM headers ${known_headers})
if(headers)
  message(FATAL_ERROR "No component installs ${headers}: name the header in cmake/ScarfInstall.cmake")
endif()


install(EXPORT scarfTargets NAMESPACE scarf:: DESTINATION "${package_folder}")
if(TARGET scarf_io)
  install(EXPORT scarfIoTargets NAMESPACE scarf:: DESTINATION "${package_folder}")
  foreach(package IN LISTS SCARF_IO_PACKAGES)
    install(FILES "${PROJECT_SOURCE_DIR}/cmake/Find${package}.cmake" DESTINATION "${package_folder}")
  endforeach()
endif()
if(TARGET scarf_digest)
  install(EXPORT scarfDigestTargets NAMESPACE scarf:: DESTINATION "${package_folder}")
endif()
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/scarfConfig.cmake.in" "${CMAKE_CURRENT_BINARY_DIR}/scarfConfig.cmake"
  INSTALL_DESTINATION "${package_folder}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/scarfConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/scarfConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/scarfConfigVersion.cmake"
  DESTINATION "${package_folder}")

if(TARGET scarf_program)
  install(TARGETS scarf_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
