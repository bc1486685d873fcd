# SPDX-License-Identifier: Apache-2.0
# ament_cmake: the functions that the CMakeLists.txt of a ROS 2 package calls. Each is in the file of its name or
# family.
foreach(_ament_module IN ITEMS core_functions package_xml target_dependencies export environment_hooks index test linters python
                          version_header package)
  include(${CMAKE_CURRENT_LIST_DIR}/ament_${_ament_module}.cmake)
endforeach()
unset(_ament_module)

option(BUILD_TESTING "Build the tests of the package" ON)
if(BUILD_TESTING)
  enable_testing()
endif()

# Programs find the libraries of their own prefix by relative paths, and others where they were linked, whatever
# LD_LIBRARY_PATH says (StackPackage.cmake). No script has to be sourced for it.
#
# In the build tree, the libraries of the package and of those that it was built after come before the stack's: a package may have
# libraries of the same names.
set(_ament_siblings "")
set(_ament_installed_siblings "")
foreach(_ament_sibling IN LISTS AMENT_SIBLING_PREFIXES)  # by `launch build`: prefixes that are moved together with this one
  list(APPEND _ament_siblings $ORIGIN/../../${_ament_sibling}/lib $ORIGIN/../../../${_ament_sibling}/lib)
  list(APPEND _ament_installed_siblings ${CMAKE_INSTALL_PREFIX}/../${_ament_sibling}/lib)
endforeach()
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/..;$ORIGIN/../lib;${_ament_siblings};${STACK_PREFIX_LIBRARIES};${STACK_SYSTEM_LIBRARIES}")
set(CMAKE_BUILD_RPATH
  "$ORIGIN;$ORIGIN/..;${PROJECT_BINARY_DIR};${_ament_installed_siblings};${STACK_PREFIX_LIBRARIES};${STACK_SYSTEM_LIBRARIES}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
foreach(_ament_kind IN ITEMS EXE SHARED MODULE)
  if(NOT CMAKE_${_ament_kind}_LINKER_FLAGS MATCHES "--disable-new-dtags")
    string(APPEND CMAKE_${_ament_kind}_LINKER_FLAGS " -Wl,--disable-new-dtags")
  endif()
endforeach()
unset(_ament_kind)
unset(_ament_sibling)
unset(_ament_siblings)
unset(_ament_installed_siblings)
