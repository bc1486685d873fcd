# SPDX-License-Identifier: Apache-2.0
# ament_lint_common: the linters that packages of ROS 2 usually have.
include(CMakeFindDependencyMacro)
foreach(_ament_common IN ITEMS copyright cppcheck cpplint flake8 lint_cmake pep257 uncrustify xmllint)
  find_dependency(ament_cmake_${_ament_common})
endforeach()
unset(_ament_common)
