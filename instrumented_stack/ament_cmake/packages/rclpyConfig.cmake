# SPDX-License-Identifier: Apache-2.0
# rclpy is no part of this stack. Packages that have C++ and Python ask for it; their C++ builds and runs.
get_property(_rclpy_said GLOBAL PROPERTY AMENT_LEFT_OUT_rclpy)
if(NOT _rclpy_said)
  set_property(GLOBAL PROPERTY AMENT_LEFT_OUT_rclpy TRUE)
  message(STATUS "${PROJECT_NAME}: rclpy is not part of this stack, so the package's nodes in Python cannot run")
endif()
