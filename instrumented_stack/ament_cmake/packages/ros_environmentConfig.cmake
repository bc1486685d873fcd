# SPDX-License-Identifier: Apache-2.0
# ros_environment: in ROS 2 it sets ROS_DISTRO and its kin in shells; here the set-up files and `launch build` do. A CMake
# that runs without either has them from here, because packages read $ENV{ROS_DISTRO}.
foreach(_ros_environment IN ITEMS "ROS_DISTRO=jazzy" "ROS_VERSION=2" "ROS_PYTHON_VERSION=3")
  string(REGEX MATCH "^([^=]+)=(.*)$" _ros_environment "${_ros_environment}")
  if("$ENV{${CMAKE_MATCH_1}}" STREQUAL "")
    set(ENV{${CMAKE_MATCH_1}} "${CMAKE_MATCH_2}")
  endif()
endforeach()
unset(_ros_environment)
