# SPDX-License-Identifier: Apache-2.0
# python_cmake_module: the Python that the packages of ROS 2 use.
include(CMakeFindDependencyMacro)
find_dependency(Python3)
set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
