# Language level, warnings and the floating-point rules that make results independent of loops.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

set(SLUICE_ARCH "native" CACHE STRING "Value of -march (native, x86-64-v3, ...)")
option(SLUICE_TESTS "Build the tests" ON)
option(SLUICE_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
option(SLUICE_FUZZ "Build the libFuzzer targets (clang)" OFF)
option(SLUICE_VECTOR_REPORT "Write the compiler's vectorisation report" OFF)

add_library(sluice_options INTERFACE)
target_compile_options(sluice_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual -Werror
  # GCC 12: false at -O3
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-pragmas>  # GCC ivdep
  # Names of files that are compiled together are no shadows of one another's parameters.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-ignored-attributes>  # of lambdas, GCC takes them so
  # No result may depend on whether a cell falls into the vector body or the remainder.
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<BOOL:${SLUICE_ARCH}>:-march=${SLUICE_ARCH}>
  $<$<BOOL:${SLUICE_VECTOR_REPORT}>:-fopt-info-vec-missed=vector.report>)
target_include_directories(sluice_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
if(SLUICE_SANITIZE)
  target_compile_options(sluice_options INTERFACE -fsanitize=address,undefined
    -fno-sanitize-recover=all -fno-omit-frame-pointer
    # GCC 12 takes AVX-512 registers that are undefined on purpose for a fault (its bug 105593).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized>)
  target_link_options(sluice_options INTERFACE -fsanitize=address,undefined)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Else it finds no object again that was compiled with precompiled headers.
  set(ccache_sloppiness pch_defines,time_macros,include_file_mtime,include_file_ctime)
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=${ccache_sloppiness} ${CCACHE_PROGRAM})
endif()
