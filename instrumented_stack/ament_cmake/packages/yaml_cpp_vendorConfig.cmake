# SPDX-License-Identifier: Apache-2.0
# yaml_cpp_vendor: in ROS 2 it brings yaml-cpp where the system has none. Here it is that of the system (Debian:
# libyaml-cpp-dev), of any version.
include(CMakeFindDependencyMacro)
find_dependency(yaml-cpp)
