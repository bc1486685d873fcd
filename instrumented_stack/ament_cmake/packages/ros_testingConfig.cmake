# SPDX-License-Identifier: Apache-2.0
# ros_testing: tests of launch files, each in a ROS domain of its own; `launch test` sees to the domain.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
find_dependency(launch_testing_ament_cmake)

# add_ros_test(<file> [arguments of add_launch_test])
function(add_ros_test file)
  add_launch_test(${file} ${ARGN})
endfunction()
