# SPDX-License-Identifier: Apache-2.0
# ament_cmake_python: Python modules in a package built with CMake. Its functions come with ament_cmake.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
ament_get_python_install_dir(PYTHON_INSTALL_DIR)
