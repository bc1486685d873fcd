# SPDX-License-Identifier: Apache-2.0
# ament_cmake_google_benchmark: benchmarks with Debian's Google Benchmark. They are built only with
# AMENT_RUN_PERFORMANCE_TESTS, as in ROS 2, and left out where the library is not installed.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
option(AMENT_RUN_PERFORMANCE_TESTS "Build and run the benchmarks" OFF)

# ament_add_google_benchmark(<target> <source>... [options of ament_add_gtest])
function(ament_add_google_benchmark target)
  find_package(benchmark QUIET)
  if(NOT benchmark_FOUND OR NOT AMENT_RUN_PERFORMANCE_TESTS)
    _ament_left_out(benchmarks "benchmarks are left out without AMENT_RUN_PERFORMANCE_TESTS")
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_LINKING_MAIN_LIBRARIES;SKIP_TEST" "TIMEOUT;WORKING_DIRECTORY;RUNNER"
    "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  add_executable(${target} ${ARG_UNPARSED_ARGUMENTS})
  set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES benchmark::benchmark)
  if(NOT ARG_SKIP_LINKING_MAIN_LIBRARIES)
    set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES benchmark::benchmark_main)
  endif()
  if(NOT ARG_SKIP_TEST)
    ament_add_test(${target} COMMAND ${target} TIMEOUT ${ARG_TIMEOUT} WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY}
      ENV ${ARG_ENV} APPEND_ENV ${ARG_APPEND_ENV} APPEND_LIBRARY_DIRS ${ARG_APPEND_LIBRARY_DIRS})
  endif()
endfunction()
