# SPDX-License-Identifier: Apache-2.0
# rclpy is no part of this stack, but it builds in a workspace, and that one is found before this file. Without it,
# packages that have C++ and Python build and their C++ runs.
get_property(_rclpy_said GLOBAL PROPERTY AMENT_LEFT_OUT_rclpy)
if(NOT _rclpy_said)
  set_property(GLOBAL PROPERTY AMENT_LEFT_OUT_rclpy TRUE)
  message(STATUS "${PROJECT_NAME}: rclpy is not in this workspace, so the package's nodes in Python cannot run; "
    "add the packages rclpy and rpyutils to it")
endif()
