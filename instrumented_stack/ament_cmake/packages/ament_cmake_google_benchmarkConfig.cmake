# SPDX-License-Identifier: Apache-2.0
# ament_cmake_google_benchmark: benchmarks with Debian's Google Benchmark. They are built and run only with
# AMENT_RUN_PERFORMANCE_TESTS. Otherwise their targets are there, because packages link libraries to them, but are not part
# of the build. They are not part of it either where the library is not installed.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
option(AMENT_RUN_PERFORMANCE_TESTS "Build and run the benchmarks" OFF)

# ament_add_google_benchmark(<target> <source>... [options of ament_add_gtest])
function(ament_add_google_benchmark target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_LINKING_MAIN_LIBRARIES;SKIP_TEST;RUN_PARALLEL"
    "TIMEOUT;WORKING_DIRECTORY;RUNNER" "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  set(options "")
  if(ARG_SKIP_LINKING_MAIN_LIBRARIES)
    set(options SKIP_LINKING_MAIN_LIBRARIES)
  endif()
  ament_add_google_benchmark_executable(${target} ${ARG_UNPARSED_ARGUMENTS} ${options})
  if(NOT ARG_SKIP_TEST)
    ament_add_google_benchmark_test(${target} TIMEOUT ${ARG_TIMEOUT} WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY}
      ENV ${ARG_ENV} APPEND_ENV ${ARG_APPEND_ENV} APPEND_LIBRARY_DIRS ${ARG_APPEND_LIBRARY_DIRS})
  endif()
endfunction()

# Do the same in two steps.
function(ament_add_google_benchmark_executable target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_LINKING_MAIN_LIBRARIES" "" "")
  find_package(benchmark QUIET)
  add_executable(${target} ${ARG_UNPARSED_ARGUMENTS})
  if(NOT benchmark_FOUND OR NOT AMENT_RUN_PERFORMANCE_TESTS)
    _ament_left_out(benchmarks "benchmarks are left out without AMENT_RUN_PERFORMANCE_TESTS")
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  if(benchmark_FOUND)
    set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES benchmark::benchmark)
    if(NOT ARG_SKIP_LINKING_MAIN_LIBRARIES)
      set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES benchmark::benchmark_main)
    endif()
  endif()
endfunction()
function(ament_add_google_benchmark_test target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_TEST;RUN_PARALLEL" "TIMEOUT;WORKING_DIRECTORY;RUNNER"
    "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  get_target_property(left_out ${target} EXCLUDE_FROM_ALL)
  if(NOT left_out)
    ament_add_test(${target} COMMAND ${target} TIMEOUT ${ARG_TIMEOUT} WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY}
      ENV ${ARG_ENV} APPEND_ENV ${ARG_APPEND_ENV} APPEND_LIBRARY_DIRS ${ARG_APPEND_LIBRARY_DIRS})
    if(ARG_SKIP_TEST)
      set_tests_properties(${target} PROPERTIES DISABLED TRUE)
    endif()
  endif()
endfunction()
