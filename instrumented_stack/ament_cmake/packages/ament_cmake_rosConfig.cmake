# SPDX-License-Identifier: Apache-2.0
# ament_cmake_ros: shared libraries by default, all kinds of tests, and tests that have a ROS domain of their own.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake_ros_core)
find_dependency(ament_cmake_gmock)
find_dependency(ament_cmake_gtest)
find_dependency(ament_cmake_pytest)
if(NOT TARGET ament_cmake_ros::ament_ros_defaults)
  add_library(ament_cmake_ros::ament_ros_defaults INTERFACE IMPORTED)
  target_link_libraries(ament_cmake_ros::ament_ros_defaults INTERFACE ament_cmake_ros_core::ament_ros_defaults)
endif()
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set_property(GLOBAL PROPERTY AMENT_RUN_IN_OWN_DOMAIN ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/run_in_own_domain.py)

# ament_add_ros_isolated_gtest(<arguments of ament_add_gtest>), and so on for each kind of test
#
# The test runs in a ROS domain that nobody else uses, also where tests of several packages run at the same time.
foreach(_ament_kind IN ITEMS gmock gmock_test gtest gtest_test pytest_test test)
  cmake_language(EVAL CODE "
    function(ament_add_ros_isolated_${_ament_kind})
      get_property(_ament_test_runner GLOBAL PROPERTY AMENT_RUN_IN_OWN_DOMAIN)
      ament_add_${_ament_kind}(\${ARGN})
    endfunction()")
endforeach()
unset(_ament_kind)
