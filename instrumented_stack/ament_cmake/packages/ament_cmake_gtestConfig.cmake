# SPDX-License-Identifier: Apache-2.0
# ament_cmake_gtest: tests with GoogleTest, run by ctest.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# ament_add_gtest(<target> <source>... [SKIP_LINKING_MAIN_LIBRARIES] [SKIP_TEST] [TIMEOUT <seconds>]
#                 [WORKING_DIRECTORY <dir>] [RUNNER <file>] [ENV <name=value>...] [APPEND_ENV <name=value>...]
#                 [APPEND_LIBRARY_DIRS <dir>...])
#
# Creates a program with GoogleTest's main() and a test with its name. RUNNER has no effect.
function(ament_add_gtest target)
  _ament_test(${target} "GTest::gtest;GTest::gtest_main" TRUE ${ARGN})
endfunction()

# Do the same in two steps.
function(ament_add_gtest_executable target)
  _ament_test(${target} "GTest::gtest;GTest::gtest_main" FALSE ${ARGN})
endfunction()
function(ament_add_gtest_test target)
  _ament_test_run(${target} ${ARGN})
endfunction()

# ament_find_gtest(): sets GTEST_FOUND, GTEST_INCLUDE_DIRS, GTEST_LIBRARIES, GTEST_MAIN_LIBRARIES (which have main()) and
# GTEST_BOTH_LIBRARIES. The name with an underscore is not public in ROS 2, but packages call it.
macro(ament_find_gtest)
  find_package(GTest REQUIRED)
  find_package(Threads REQUIRED)
  get_target_property(GTEST_INCLUDE_DIRS GTest::gtest INTERFACE_INCLUDE_DIRECTORIES)
  set(GTEST_FOUND TRUE)
  set(GTEST_LIBRARIES GTest::gtest Threads::Threads)
  set(GTEST_MAIN_LIBRARIES GTest::gtest_main)
  set(GTEST_BOTH_LIBRARIES ${GTEST_LIBRARIES} ${GTEST_MAIN_LIBRARIES})
endmacro()
macro(_ament_cmake_gtest_find_gtest)
  ament_find_gtest()
endmacro()

function(_ament_test target libraries run)
  find_package(GTest REQUIRED)
  find_package(Threads REQUIRED)
  cmake_parse_arguments(PARSE_ARGV 3 ARG "SKIP_LINKING_MAIN_LIBRARIES;SKIP_TEST" "TIMEOUT;WORKING_DIRECTORY;RUNNER"
    "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  add_executable(${target} ${ARG_UNPARSED_ARGUMENTS})
  if(ARG_SKIP_LINKING_MAIN_LIBRARIES)
    list(FILTER libraries EXCLUDE REGEX "_main$")
  endif()
  set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES ${libraries} Threads::Threads)
  if(run AND NOT ARG_SKIP_TEST)
    _ament_test_run(${ARGV0} ${ARGN})
  endif()
endfunction()

function(_ament_test_run target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_LINKING_MAIN_LIBRARIES;SKIP_TEST"
    "TIMEOUT;WORKING_DIRECTORY;RUNNER;TEST_NAME" "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  if(NOT ARG_WORKING_DIRECTORY)
    set(ARG_WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  if(NOT ARG_TEST_NAME)
    set(ARG_TEST_NAME ${target})
  endif()
  add_test(NAME ${ARG_TEST_NAME} COMMAND ${_ament_test_runner} $<TARGET_FILE:${target}> WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY})
  _ament_test_properties(${ARG_TEST_NAME} gtest TIMEOUT ${ARG_TIMEOUT}
    ENV ${ARG_ENV} APPEND_ENV ${ARG_APPEND_ENV} APPEND_LIBRARY_DIRS ${ARG_APPEND_LIBRARY_DIRS})
endfunction()
