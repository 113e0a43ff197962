# Compiler settings of every target, and the helpers that make targets.

add_library(scarf_settings INTERFACE)
target_compile_features(scarf_settings INTERFACE cxx_std_20)
target_compile_options(scarf_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  # g++ 12 sees overlaps in std::string that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${SCARF_WERROR}>:-Werror>)
set(SCARF_SANITIZE_FLAGS "")
if(SCARF_SANITIZE MATCHES "^(address|ON)$")
  set(SCARF_SANITIZE_FLAGS -fsanitize=address,undefined)
  target_compile_options(scarf_settings INTERFACE ${SCARF_SANITIZE_FLAGS} -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
elseif(SCARF_SANITIZE STREQUAL "thread")
  set(SCARF_SANITIZE_FLAGS -fsanitize=thread)
  target_compile_options(scarf_settings INTERFACE ${SCARF_SANITIZE_FLAGS} -fno-omit-frame-pointer)
elseif(SCARF_SANITIZE)
  message(FATAL_ERROR "SCARF_SANITIZE is ${SCARF_SANITIZE}: give address or thread, or leave it empty")
endif()
target_link_options(scarf_settings INTERFACE ${SCARF_SANITIZE_FLAGS})

# A room is a folder of sources and the set of what it may include: its own headers, and those of the rooms and public
# headers that it names. Nothing else is on its include path, so what is not named does not compile. Headers are found
# through a folder of links, one per room: "<room>/<header>".
set(SCARF_INCLUDE_SETS "${PROJECT_BINARY_DIR}/include_sets")

# scarf_include_set(TARGET PATH...): lets those who link the target include "<path>/...", paths being relative to `from`.
function(scarf_include_set target from)
  set(set "${SCARF_INCLUDE_SETS}/${target}")
  file(REMOVE_RECURSE "${set}")
  foreach(path IN LISTS ARGN)
    get_filename_component(folder "${set}/${path}" DIRECTORY)
    file(MAKE_DIRECTORY "${folder}")
    file(CREATE_LINK "${from}/${path}" "${set}/${path}" SYMBOLIC)
  endforeach()
  target_include_directories(${target} INTERFACE "${set}")
endfunction()

# scarf_public_headers(NAME [FILES file...] [USES name...]): include/scarf/NAME/, and single files of include/scarf/, for
# the rooms that name `api/NAME`.
function(scarf_public_headers name)
  cmake_parse_arguments(ARG "" "" "FILES;USES" ${ARGN})
  add_library(api_${name} INTERFACE)
  list(TRANSFORM ARG_FILES PREPEND scarf/)
  scarf_include_set(api_${name} "${PROJECT_SOURCE_DIR}/include" scarf/${name} ${ARG_FILES})
  list(TRANSFORM ARG_USES PREPEND api_)
  target_link_libraries(api_${name} INTERFACE ${ARG_USES})
  list(TRANSFORM ARG_USES REPLACE "^api_" "api/")
  scarf_note_room(api/${name} ${ARG_USES})
endfunction()

# What tests/rooms_test.py reads.
function(scarf_note_room path)
  list(JOIN ARGN " " uses)
  set_property(GLOBAL APPEND_STRING PROPERTY SCARF_ROOM_LIST "${path}: ${uses}\n")
endfunction()

# scarf_room(PATH [FROM folder] [SOURCES file...] [USES room...] [LIBRARIES library...] [OPTIONS option...])
# PATH is relative to FROM (default: src/). SOURCES: default all *.cpp of the folder; none makes a room of headers. Rooms
# are named by their paths, public headers as api/NAME. LIBRARIES of others are for the room itself alone.
function(scarf_room path)
  cmake_parse_arguments(ARG "" "FROM" "SOURCES;USES;LIBRARIES;OPTIONS" ${ARGN})
  if(NOT ARG_FROM)
    set(ARG_FROM "${PROJECT_SOURCE_DIR}/src")
  endif()
  string(REPLACE "/" "_" room "room_${path}")
  if(NOT ARG_SOURCES)
    file(GLOB ARG_SOURCES CONFIGURE_DEPENDS "${ARG_FROM}/${path}/*.cpp")
  endif()
  set(used)
  foreach(use IN LISTS ARG_USES)
    string(REPLACE "/" "_" target "${use}")
    if(NOT target MATCHES "^api_")
      string(PREPEND target "room_")
    endif()
    if(NOT TARGET ${target})
      message(FATAL_ERROR "the room ${path} uses ${use}, which does not come before it")
    endif()
    list(APPEND used ${target})
  endforeach()
  if(ARG_SOURCES)
    add_library(${room} OBJECT ${ARG_SOURCES})
    target_link_libraries(${room} PUBLIC ${used} PRIVATE ${ARG_LIBRARIES} scarf_settings)
    target_include_directories(${room} PRIVATE "${SCARF_INCLUDE_SETS}/${room}")
    target_compile_options(${room} PRIVATE ${ARG_OPTIONS})
    set_target_properties(${room} PROPERTIES POSITION_INDEPENDENT_CODE ON SCARF_LIBRARIES "${ARG_LIBRARIES}")
  else()
    add_library(${room} INTERFACE)
    target_link_libraries(${room} INTERFACE ${used})
  endif()
  scarf_include_set(${room} "${ARG_FROM}" ${path})
  scarf_note_room(${path} ${ARG_USES})
  set_property(GLOBAL APPEND PROPERTY SCARF_ROOMS ${room})
endfunction()

# scarf_room_sources(PATH RESULT): all sources of a room under src/, for rooms that leave some out.
function(scarf_room_sources path result)
  file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${path}/*.cpp")
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# scarf_either(CONDITION IF ELSE LIST): takes one of two files out of the list.
function(scarf_either condition yes no list)
  set(out "${no}")
  if(NOT condition)
    set(out "${yes}")
  endif()
  list(FILTER ${list} EXCLUDE REGEX "/${out}$")
  set(${list} ${${list}} PARENT_SCOPE)
endfunction()

# scarf_component(NAME ROOMS room... [PUBLIC library...]): the library libscarf-NAME of these rooms, scarf::NAME.
function(scarf_component name)
  cmake_parse_arguments(ARG "" "" "ROOMS;PUBLIC" ${ARGN})
  set(target scarf_${name})
  add_library(${target} STATIC)
  add_library(scarf::${name} ALIAS ${target})
  foreach(path IN LISTS ARG_ROOMS)
    string(REPLACE "/" "_" room "room_${path}")
    get_target_property(type ${room} TYPE)
    if(type STREQUAL "OBJECT_LIBRARY")
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${room}>)
      get_target_property(libraries ${room} SCARF_LIBRARIES)
      if(libraries)
        target_link_libraries(${target} PRIVATE ${libraries})
      endif()
    endif()
  endforeach()
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME scarf-${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC})
endfunction()

# scarf_test_program(NAME [FAST] [SLOW pattern] FOLDERS folder... LIBRARIES library...): a GoogleTest program of all sources
# in these folders of tests/, each of its tests known to ctest. Tests may include the headers of every room. FAST: its tests
# have the label `fast`, which ./dev runs, but for those of SLOW (as --gtest_filter): all of that label in under a minute.
function(scarf_test_program name)
  cmake_parse_arguments(ARG "FAST" "SLOW" "FOLDERS;LIBRARIES" ${ARGN})
  set(sources)
  foreach(folder IN LISTS ARG_FOLDERS)
    file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/${folder}/*.cpp")
    list(APPEND sources ${found})
  endforeach()
  add_executable(${name} ${sources})
  scarf_sees_every_room(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} scarf_settings GTest::gtest GTest::gmock GTest::gtest_main)
  set(labels)
  set(filter)
  if(ARG_FAST)
    set(labels LABELS fast)
    set_property(GLOBAL APPEND PROPERTY SCARF_FAST_PROGRAMS ${name})
    if(ARG_SLOW)
      set(filter TEST_FILTER "*-${ARG_SLOW}")
      gtest_discover_tests(${name} TEST_FILTER "${ARG_SLOW}" TEST_LIST ${name}_slow DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
    endif()
  endif()
  gtest_discover_tests(${name} ${filter} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 ${labels})
endfunction()

# Lets a target include the headers of every room, and from the project's folder.
function(scarf_sees_every_room target)
  get_property(rooms GLOBAL PROPERTY SCARF_ROOMS)
  foreach(room IN LISTS rooms)
    target_include_directories(${target} PRIVATE "${SCARF_INCLUDE_SETS}/${room}")
  endforeach()
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
endfunction()
