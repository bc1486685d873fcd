# SPDX-License-Identifier: Apache-2.0
# ament_cmake_gmock: tests with GoogleMock, run by ctest. The arguments are those of ament_cmake_gtest.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake_gtest)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

function(ament_add_gmock target)
  _ament_test(${target} "GTest::gmock;GTest::gtest;GTest::gmock_main" TRUE ${ARGN})
endfunction()
function(ament_add_gmock_executable target)
  _ament_test(${target} "GTest::gmock;GTest::gtest;GTest::gmock_main" FALSE ${ARGN})
endfunction()
function(ament_add_gmock_test target)
  _ament_test_run(${target} ${ARGN})
endfunction()
macro(ament_find_gmock)
  find_package(GTest REQUIRED)
endmacro()
