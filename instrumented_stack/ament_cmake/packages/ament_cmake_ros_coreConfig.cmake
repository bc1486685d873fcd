# SPDX-License-Identifier: Apache-2.0
# ament_cmake_ros_core: libraries are shared unless their package says otherwise.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
option(BUILD_SHARED_LIBS "Build libraries as shared ones" ON)
if(NOT TARGET ament_cmake_ros_core::ament_ros_defaults)
  add_library(ament_cmake_ros_core::ament_ros_defaults INTERFACE IMPORTED)
  target_compile_features(ament_cmake_ros_core::ament_ros_defaults INTERFACE cxx_std_17 c_std_11)
endif()
