# SPDX-License-Identifier: Apache-2.0
# performance_test_fixture: benchmarks that count allocations, too. The fixture is no part of this stack, so its benchmarks
# have targets, which packages link libraries to, but are not part of the build. A workspace that has the package
# performance_test_fixture builds and runs them with AMENT_RUN_PERFORMANCE_TESTS: that one is found before this file.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
if(NOT TARGET performance_test_fixture::performance_test_fixture)
  add_library(performance_test_fixture::performance_test_fixture INTERFACE IMPORTED)
endif()
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# add_performance_test(<target> <source>... [options of ament_add_gtest])
function(add_performance_test target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_LINKING_MAIN_LIBRARIES;SKIP_TEST;RUN_PARALLEL"
    "TIMEOUT;WORKING_DIRECTORY;RUNNER" "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  _ament_left_out(performance_test_fixture "benchmarks are left out without performance_test_fixture in the workspace")
  add_executable(${target} EXCLUDE_FROM_ALL ${ARG_UNPARSED_ARGUMENTS})
endfunction()
