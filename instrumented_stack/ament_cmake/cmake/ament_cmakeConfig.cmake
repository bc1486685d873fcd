# SPDX-License-Identifier: Apache-2.0
# ament_cmake: the functions that the CMakeLists.txt of a ROS 2 package calls. Each is in the file of its name or
# family.
foreach(_ament_module IN ITEMS package_xml target_dependencies export environment_hooks index version_header package)
  include(${CMAKE_CURRENT_LIST_DIR}/ament_${_ament_module}.cmake)
endforeach()
unset(_ament_module)

option(BUILD_TESTING "Build the tests of the package" ON)
if(BUILD_TESTING)
  enable_testing()
endif()

# Programs find the libraries of their own prefix by relative paths, and others where they were linked. No script has to
# be sourced to set LD_LIBRARY_PATH.
set(CMAKE_INSTALL_RPATH "$ORIGIN:$ORIGIN/..:$ORIGIN/../lib")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
