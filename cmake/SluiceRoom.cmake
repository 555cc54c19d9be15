# sluice_room(NAME [COLD] [COLD_FILES files...] [SUBROOMS folders...] [USES rooms...]
#             [LIBRARIES libs...])
#   One folder is one static library: every .cpp beside the CMakeLists and in its SUBROOMS, tests
#   (*_test.cpp) apart. The order of SUBROOMS is held by tools/lint/check_layers.py.
#   COLD: no file of it is a kernel (SluiceCompile.cmake); COLD_FILES: these are none.
#   The tests of a room are one executable NAME_test: one test of ctest, labelled "cases".
function(sluice_room name)
  cmake_parse_arguments(ROOM "COLD" "" "COLD_FILES;SUBROOMS;USES;LIBRARIES" ${ARGN})
  set(patterns ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(folder ${ROOM_SUBROOMS})
    list(APPEND patterns ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_(test|fuzz)\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM ROOM_COLD_FILES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(ROOM_COLD_FILES)
    list(REMOVE_ITEM sources ${ROOM_COLD_FILES})
  endif()
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC sluice_options ${ROOM_USES} ${ROOM_LIBRARIES})
    sluice_compile_room(${name} ${ROOM_COLD})
    sluice_cold_files(${name} "${ROOM_COLD_FILES}" "${ROOM_USES};${ROOM_LIBRARIES}")
  else()  # headers only
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE sluice_options ${ROOM_USES} ${ROOM_LIBRARIES})
  endif()
  if(SLUICE_TESTS AND tests)
    sluice_test(${name}_test SOURCES ${tests} USES ${name})
  endif()
endfunction()

# sluice_test(NAME SOURCES files... USES rooms... [LABELS l...] [TIMEOUT s])
#   ctest runs the executable as one process, without the full products (suites or cases whose
#   names begin with Full); tools/test/run_tests.py selects among its cases, TIMEOUT is then that
#   of a case.
function(sluice_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT" "SOURCES;USES;LABELS" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_USES} GTest::gtest GTest::gmock GTest::gtest_main)
  sluice_compile_test(${name})
  add_test(NAME ${name} COMMAND ${name} "--gtest_filter=-Full*:*.Full*"
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${TEST_TIMEOUT} LABELS "cases;${TEST_LABELS}")
endfunction()
