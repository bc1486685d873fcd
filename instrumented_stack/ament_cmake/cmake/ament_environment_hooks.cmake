# SPDX-License-Identifier: Apache-2.0
# ament_environment_hooks(<file>...)
#
# Installs scripts that set up an environment, in share/<pkg>/environment; one that ends in .in is configured first.
# Nothing here runs them. ROS 2's scripts for library and program paths are not needed, because programs know where
# their libraries are.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

function(ament_environment_hooks)
  foreach(file IN LISTS ARGN)
    get_filename_component(name "${file}" NAME)
    if(name MATCHES "\\.in$")
      string(REGEX REPLACE "\\.in$" "" name ${name})
      configure_file(${file} ${CMAKE_CURRENT_BINARY_DIR}/ament_cmake/environment/${name} @ONLY)
      set(file ${CMAKE_CURRENT_BINARY_DIR}/ament_cmake/environment/${name})
    endif()
    if(file)
      install(FILES ${file} DESTINATION share/${PROJECT_NAME}/environment)
    endif()
  endforeach()
endfunction()
