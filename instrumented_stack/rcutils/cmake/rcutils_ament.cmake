# SPDX-License-Identifier: Apache-2.0
# As in ROS 2, packages that find rcutils, or one above it, have the functions of ament_cmake. Some packages call these
# without finding ament_cmake themselves.
find_dependency(ament_cmake)
