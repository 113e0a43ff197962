# Builds from a folder that `bench/on_gpu --pack` made, on a machine that has a compiler, CMake and the Vulkan loader:
# headers and static libraries are there, shaders are compiled, and what needs more (OpenCV, recorded formats with
# libraries of their own) is left out.
set(CMAKE_PREFIX_PATH "${SCARF_PACK}")
set(Vulkan_INCLUDE_DIR "${SCARF_PACK}/include" CACHE PATH "" FORCE)
set(OPENSSL_ROOT_DIR "${SCARF_PACK}")
set(OPENSSL_USE_STATIC_LIBS ON)
foreach(option PICTURES BENCH INSTALL)
  set(SCARF_${option} OFF CACHE BOOL "" FORCE)
endforeach()

# Debian's packages of these libraries name their own places.
include_directories(SYSTEM "${SCARF_PACK}/include")
foreach(library gtest gtest_main gmock gmock_main)
  add_library(GTest::${library} STATIC IMPORTED GLOBAL)
  set_target_properties(GTest::${library} PROPERTIES IMPORTED_LOCATION "${SCARF_PACK}/lib/lib${library}.a")
endforeach()
find_package(Threads REQUIRED)
set_property(TARGET GTest::gtest PROPERTY INTERFACE_LINK_LIBRARIES Threads::Threads)
set_property(TARGET GTest::gmock PROPERTY INTERFACE_LINK_LIBRARIES GTest::gtest)
set_property(TARGET GTest::gtest_main PROPERTY INTERFACE_LINK_LIBRARIES GTest::gtest)
