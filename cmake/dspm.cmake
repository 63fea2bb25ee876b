# The project's libraries, tests and the compiler's settings, one line each where they are used.

# The oldest with all of C++20 that is used.
set(oldest_GNU 12)
set(oldest_Clang 14)
if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS "${oldest_${CMAKE_CXX_COMPILER_ID}}")
  message(FATAL_ERROR "${CMAKE_CXX_COMPILER} is version ${CMAKE_CXX_COMPILER_VERSION}; dspm needs g++ 12 or clang++ 14 at "
    "least. If there is another one: CXX=g++-12 ./dev demo, after removing ${CMAKE_BINARY_DIR}")
endif()

find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(GTest REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)

# gold links a test in 0.4 of the time that ld takes.
include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold has_gold)

add_library(dspm_settings INTERFACE)
target_include_directories(dspm_settings INTERFACE ${CMAKE_BINARY_DIR}/include ${CMAKE_BINARY_DIR}/made
  ${CMAKE_SOURCE_DIR})  # the last for bench, python and tests
# No contraction and no fast-math: equal paths must take equal decisions in every run, see docs/design.md.
set(dspm_code_options -ffp-contract=off -fno-math-errno)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
  list(APPEND dspm_code_options -msse4.2 -mpopcnt)
else()
  find_path(SIMDE simde/x86/sse4.1.h REQUIRED)  # SSE's functions on other processors, see base/math/simd.h
endif()
target_compile_options(dspm_settings INTERFACE ${dspm_code_options}
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
  target_compile_options(dspm_settings INTERFACE -Wno-psabi)  # it remarks what g++ 10 has changed
endif()
if(DSPM_WERROR)
  target_compile_options(dspm_settings INTERFACE -Werror)
endif()
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # The warning is for headers with anonymous namespaces, and takes the sources of a room that are compiled together for
  # such.
  target_compile_options(dspm_settings INTERFACE -Wno-subobject-linkage)
endif()
target_link_libraries(dspm_settings INTERFACE fmt::fmt Threads::Threads)

# dspm_library(materials SOURCES a.cpp b.cpp NEEDS core textures)
function(dspm_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;NEEDS;USES" ${ARGN})
  add_library(dspm_${name} STATIC ${ARG_SOURCES})
  list(TRANSFORM ARG_NEEDS PREPEND dspm_)
  target_link_libraries(dspm_${name} PUBLIC dspm_settings ${ARG_NEEDS} PRIVATE ${ARG_USES})
  # A third of the build was these headers. The preset "clang" does without, so that no include is forgotten.
  get_property(first GLOBAL PROPERTY dspm_first_library)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    if(first)
      target_precompile_headers(dspm_${name} REUSE_FROM ${first})
    else()
      set_property(GLOBAL PROPERTY dspm_first_library dspm_${name})
      target_precompile_headers(dspm_${name} PRIVATE <fmt/format.h> <algorithm> <array> <cmath> <filesystem> <functional>
        <map> <memory> <optional> <span> <string> <vector>)
    endif()
  endif()
  # What libdspm is made of; CGAL's files are objects among the sources.
  list(FILTER ARG_SOURCES INCLUDE REGEX "TARGET_OBJECTS")
  set_property(GLOBAL APPEND PROPERTY dspm_objects $<TARGET_OBJECTS:dspm_${name}> ${ARG_SOURCES})
  set_property(GLOBAL APPEND PROPERTY dspm_uses ${ARG_USES})
endfunction()

# For code that is never hot: a third less time to build it. With -O1 g++ 13 and later turn two options off that precompiled
# headers ask for; they change nothing on their own.
check_cxx_compiler_flag(-munroll-only-small-loops has_small_loops)
function(dspm_seldom_run target)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${target} PRIVATE -O1)
    if(has_small_loops)
      target_compile_options(${target} PRIVATE -munroll-only-small-loops -mvzeroupper)
    endif()
  endif()
endfunction()

function(dspm_test_program target)
  add_executable(${target})
  target_compile_definitions(${target} PRIVATE DSPM_TEST_DATA="${DSPM_TEST_DATA}"
    DSPM_SOURCE_DIR="${CMAKE_SOURCE_DIR}" DSPM_BINARY="$<TARGET_FILE_DIR:dspm>/dspm")
  # Half of the build is tests. The first one's precompiled headers serve them all (the preset "clang" does without, so
  # that none is forgotten, and without -O1: inline functions of the library may come from a test). The warnings are
  # wrong ones of g++ 12 there.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    target_compile_options(${target} PRIVATE -O1 -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
      -Wno-stringop-overread)
    if(has_gold)
      target_link_options(${target} PRIVATE -fuse-ld=gold)
    endif()
  endif()
  get_property(first GLOBAL PROPERTY dspm_first_test)
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY dspm_first_test ${target})
    target_precompile_headers(${target} PRIVATE <gtest/gtest.h> <fmt/format.h> <algorithm> <filesystem> <fstream>
      <functional> <map> <memory> <optional> <random> <string> <thread> <vector>)
  endif()
endfunction()

# dspm_test(materials/chi2 LABEL statistical RUNS dspm NEEDS materials): tests/materials/chi2_test.cpp becomes one ctest.
# RUNS: targets that have to be there when it runs. DATA: it tests nothing but DSPM_TEST_DATA, and counts as skipped where
# that is absent. With CMAKE_UNITY_BUILD a room's tests are one program, which is told the file whose tests to run.
function(dspm_test name)
  cmake_parse_arguments(ARG "DATA" "LABEL;TIMEOUT" "NEEDS;USES;RUNS" ${ARGN})
  get_filename_component(room ${name} DIRECTORY)
  get_filename_component(file ${name} NAME)
  if(CMAKE_UNITY_BUILD)
    set(target ${room}_tests)
    set(main dspm_test_main)
    set(command ${target} ${file}_test.cpp)
  else()
    string(REPLACE "/" "_" target ${name}_test)
    set(main GTest::gtest_main)
    set(command ${target})
  endif()
  if(NOT TARGET ${target})
    dspm_test_program(${target})
  endif()
  target_sources(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests/${name}_test.cpp)
  list(TRANSFORM ARG_NEEDS PREPEND dspm_)
  target_link_libraries(${target} PRIVATE ${ARG_NEEDS} ${ARG_USES} ${main})
  if(ARG_RUNS)
    add_dependencies(${target} ${ARG_RUNS})
  endif()
  add_test(NAME ${name} COMMAND ${command})
  if(NOT ARG_LABEL)
    set(ARG_LABEL quick)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 1200)  # seconds: enough under ThreadSanitizer
  endif()
  # Long ones begin first, so that the last to end are short.
  set(cost_statistical 3)
  set(cost_render 2)
  set(cost_quick 1)
  set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} COST ${cost_${ARG_LABEL}})
  if(ARG_DATA)  # ctest lets a skipped test hide a failed one, so this is only for binaries that need the data throughout
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED")
  endif()
endfunction()
