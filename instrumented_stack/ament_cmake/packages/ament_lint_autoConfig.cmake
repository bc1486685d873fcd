# SPDX-License-Identifier: Apache-2.0
# ament_lint_auto: the linters that package.xml names as test dependencies.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)

# ament_lint_auto_find_test_dependencies()
#
# Finds the packages that package.xml names as test dependencies, and calls the functions of the linters among them.
# AMENT_LINT_AUTO_EXCLUDE is a list of linters that are not called, AMENT_LINT_AUTO_FILE_EXCLUDE one of files.
macro(ament_lint_auto_find_test_dependencies)
  ament_package_xml()
  foreach(_ament_dependency IN LISTS ${PROJECT_NAME}_TEST_DEPENDS)
    if(NOT ${_ament_dependency}_FOUND)
      find_package(${_ament_dependency} QUIET)
    endif()
  endforeach()
  get_property(_ament_linters GLOBAL PROPERTY AMENT_LINTERS_FOUND)
  list(REMOVE_DUPLICATES _ament_linters)
  set(_ament_lint_auto TRUE)
  foreach(_ament_found IN LISTS _ament_linters)
    if(NOT ament_cmake_${_ament_found} IN_LIST AMENT_LINT_AUTO_EXCLUDE)
      if(AMENT_LINT_AUTO_FILE_EXCLUDE)
        cmake_language(CALL ament_${_ament_found} EXCLUDE ${AMENT_LINT_AUTO_FILE_EXCLUDE})
      else()
        cmake_language(CALL ament_${_ament_found})
      endif()
    endif()
  endforeach()
  unset(_ament_lint_auto)
endmacro()
