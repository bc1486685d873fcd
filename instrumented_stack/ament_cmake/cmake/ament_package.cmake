# SPDX-License-Identifier: Apache-2.0
# ament_package([CONFIG_EXTRAS <file>...] [CONFIG_EXTRAS_POST <file>...])
#
# Call it last in the CMakeLists.txt of a package. It adds the package to the ament index, installs its package.xml, and
# writes the files that find_package() reads, and setup.bash and others. The extras are CMake files that find_package() runs before and after the
# exported targets; one that ends in .in is configured first. The project must have the name of the package.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # when installed, StackPackage is in this folder
include(StackPackage)

set_property(GLOBAL PROPERTY AMENT_CMAKE_DIR ${CMAKE_CURRENT_LIST_DIR})

function(ament_package)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "" "CONFIG_EXTRAS;CONFIG_EXTRAS_POST")
  ament_package_xml()
  set(pkg ${${PROJECT_NAME}_NAME})
  if(NOT pkg STREQUAL PROJECT_NAME)
    message(FATAL_ERROR "ament_package: the package is '${pkg}' in package.xml and '${PROJECT_NAME}' in project()")
  endif()
  stack_package(${pkg})

  foreach(extras IN ITEMS CONFIG_EXTRAS CONFIG_EXTRAS_POST)
    set(${extras} "")
    foreach(file IN LISTS ARG_${extras})
      get_filename_component(name ${file} NAME)
      if(name MATCHES "\\.in$")
        string(REGEX REPLACE "\\.in$" "" name ${name})
        configure_file(${file} ${CMAKE_CURRENT_BINARY_DIR}/ament_cmake/${name} @ONLY)
        set(file ${CMAKE_CURRENT_BINARY_DIR}/ament_cmake/${name})
      endif()
      install(FILES ${file} DESTINATION share/${pkg}/cmake)
      list(APPEND ${extras} ${name})
    endforeach()
  endforeach()
  foreach(what IN ITEMS DEPENDENCIES TARGETS INCLUDE_DIRS LIBRARIES DEFINITIONS LINK_FLAGS)
    get_property(${what} GLOBAL PROPERTY AMENT_EXPORT_${what}_${pkg})
  endforeach()
  list(REMOVE_DUPLICATES DEPENDENCIES)
  list(REMOVE_ITEM DEPENDENCIES ${pkg})

  get_property(modules GLOBAL PROPERTY AMENT_CMAKE_DIR)
  set(exports ${CMAKE_CURRENT_BINARY_DIR}/ament_cmake/${pkg}Exports.cmake)
  configure_file(${modules}/package_exports.cmake.in ${exports} @ONLY)
  install(FILES ${exports} DESTINATION share/${pkg}/cmake)
  file(GLOB setup_files ${modules}/../setup/*)
  install(FILES ${setup_files} DESTINATION .)
  # A package with messages already has a configuration, which reads the exports.
  get_property(has_config GLOBAL PROPERTY STACK_CONFIG_${pkg})
  if(NOT has_config)
    _stack_config(${pkg} "")
  endif()
endfunction()
