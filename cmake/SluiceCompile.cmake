# What the build costs: precompiled headers, optimisation where no loop runs, tests several to an
# object, a quick linker.
#
#   sluice_compile_room(ROOM COLD)     the objects of a library; COLD: whether none is a kernel
#   sluice_compile_test(TEST)          the objects of a test
option(SLUICE_PCH "Precompile the headers of the standard library and fmt" ON)
set(SLUICE_TESTS_AN_OBJECT 8 CACHE STRING "Test files that are compiled as one; 1: each apart")
set(SLUICE_FILES_AN_OBJECT 7 CACHE STRING
    "Files without kernels that are compiled as one; 1: each apart")

# Comes with binutils and links an executable in a third of the time.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold SLUICE_HAS_GOLD)
if(SLUICE_HAS_GOLD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_link_options(sluice_options INTERFACE -fuse-ld=gold)
endif()

# Only headers that are not ours: to change one of ours must not compile all objects anew. No JSON:
# its templates would be made in every object, used or not, which costs more than to read it.
set(standard_headers
  <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits>
  <map> <memory> <optional> <set> <span> <sstream> <string> <string_view> <unordered_map>
  <utility> <variant> <vector> <fmt/format.h>)

# -fpch-preprocess: by it ccache sees which precompiled header an object is made with.
# -Wno-array-bounds: GCC 12, false in std::string once it is precompiled.
set(of_precompiled $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                   $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>)

# A precompiled header serves all rooms that are compiled with the same options.
function(sluice_precompiled_header name)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${name}.cpp CONTENT "int ${name}_object;\n")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
  target_link_libraries(${name} PRIVATE sluice_options fmt::fmt sluice_mpi)
  target_compile_options(${name} PRIVATE ${ARGN} ${of_precompiled})
  target_precompile_headers(${name} PRIVATE ${standard_headers})
endfunction()

# Debuggers and sanitizers keep the optimisation of their preset.
set(without_kernels $<$<CONFIG:Release>:-O1>)
if(SLUICE_PCH)
  sluice_precompiled_header(sluice_headers)
  sluice_precompiled_header(sluice_headers_cold ${without_kernels})
endif()

function(sluice_compile_room room cold)
  set(headers sluice_headers)
  if(cold)
    set(headers sluice_headers_cold)
    target_compile_options(${room} PRIVATE ${without_kernels})
    if(SLUICE_FILES_AN_OBJECT GREATER 1)
      set_target_properties(${room} PROPERTIES UNITY_BUILD ON
                            UNITY_BUILD_BATCH_SIZE ${SLUICE_FILES_AN_OBJECT})
    endif()
  endif()
  if(SLUICE_PCH)
    target_precompile_headers(${room} REUSE_FROM ${headers})
    target_compile_options(${room} PRIVATE ${of_precompiled})
  endif()
endfunction()

# Files of a library with kernels that are none themselves: objects of their own, as other options
# need another precompiled header.
function(sluice_cold_files room files uses)
  if(NOT files)
    return()
  endif()
  add_library(${room}_cold OBJECT ${files})
  target_link_libraries(${room}_cold PRIVATE sluice_options ${uses})
  sluice_compile_room(${room}_cold TRUE)
  target_sources(${room} PRIVATE $<TARGET_OBJECTS:${room}_cold>)
endfunction()

# Where the sources are, for tests that read decks: only for those that ask. Objects of the others
# are the same in every checkout.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/sluice_source_dir.hpp CONTENT
  "#pragma once\n#define SLUICE_SOURCE_DIR \"${CMAKE_SOURCE_DIR}\"\n")

# Tests spend their time in parsing gtest and the room's headers: once for several files. Those that
# ask for the sources' folder come last, that few objects depend on it.
function(sluice_compile_test test)
  target_include_directories(${test} PRIVATE ${CMAKE_BINARY_DIR}/generated)
  sluice_compile_room(${test} TRUE)
  if(SLUICE_TESTS_AN_OBJECT GREATER 1)
    set_target_properties(${test} PROPERTIES UNITY_BUILD ON
                          UNITY_BUILD_BATCH_SIZE ${SLUICE_TESTS_AN_OBJECT})
  endif()
  get_target_property(sources ${test} SOURCES)
  foreach(source ${sources})
    file(STRINGS ${source} asks REGEX "sluice_source_dir.hpp")
    if(asks)
      list(REMOVE_ITEM sources ${source})
      list(APPEND sources ${source})
    endif()
  endforeach()
  set_property(TARGET ${test} PROPERTY SOURCES ${sources})
endfunction()
