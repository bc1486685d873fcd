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
# ament_find_gmock(): sets GMOCK_FOUND, GMOCK_INCLUDE_DIRS, GMOCK_LIBRARIES, GMOCK_MAIN_LIBRARIES (which have main()) and
# GMOCK_BOTH_LIBRARIES. The name with an underscore is not public in ROS 2, but packages call it.
macro(ament_find_gmock)
  ament_find_gtest()
  set(GMOCK_FOUND TRUE)
  get_target_property(GMOCK_INCLUDE_DIRS GTest::gmock INTERFACE_INCLUDE_DIRECTORIES)
  set(GMOCK_LIBRARIES GTest::gmock GTest::gtest Threads::Threads)
  set(GMOCK_MAIN_LIBRARIES GTest::gmock_main GTest::gtest)
  set(GMOCK_BOTH_LIBRARIES ${GMOCK_LIBRARIES} ${GMOCK_MAIN_LIBRARIES})
endmacro()
macro(_ament_cmake_gmock_find_gmock)
  ament_find_gmock()
endmacro()
