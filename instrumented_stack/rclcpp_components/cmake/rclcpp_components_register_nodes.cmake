# SPDX-License-Identifier: Apache-2.0
# Registers the components of a library for containers, and creates programs of components.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # when installed, StackPackage is in this folder
include(StackPackage)

set_property(GLOBAL PROPERTY RCLCPP_COMPONENTS_NODE_MAIN ${CMAKE_CURRENT_LIST_DIR}/node_main.cpp.in)

# ROS 2 has several libraries with these names; here it is one library.
if(TARGET rclcpp_components::rclcpp_components)
  foreach(part IN ITEMS component component_manager)
    add_library(rclcpp_components::${part} INTERFACE IMPORTED)
    target_link_libraries(rclcpp_components::${part} INTERFACE rclcpp_components::rclcpp_components)
  endforeach()
endif()

# rclcpp_components_register_nodes(<target> <class>... [RESOURCE_INDEX <index>] [PACKAGE <pkg>])
#
# Adds components of the shared library <target> to the ament index. Install the library yourself, with LIBRARY
# DESTINATION lib. By default the package is the current project.
function(rclcpp_components_register_nodes target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "RESOURCE_INDEX;PACKAGE" "")
  _rclcpp_components_register("${ARG_RESOURCE_INDEX}" "${ARG_PACKAGE}" ${target} ${ARG_UNPARSED_ARGUMENTS})
endfunction()

# rclcpp_components_register_node(<target> PLUGIN <class> EXECUTABLE <executable> [EXECUTOR <executor>]
#                                 [RESOURCE_INDEX <index>] [PACKAGE <pkg>])
#
# The same for one component, with a program in lib/<pkg> that runs it. The program's CMake target is <executable>; with
# PACKAGE it is <pkg>_<executable>. The executor is a class of rclcpp::executors, by default SingleThreadedExecutor. ROS
# 2's option NO_UNDEFINED_SYMBOLS makes the linker refuse undefined symbols in the library.
function(rclcpp_components_register_node target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "NO_UNDEFINED_SYMBOLS" "PLUGIN;EXECUTABLE;EXECUTOR;RESOURCE_INDEX;PACKAGE" "")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rclcpp_components_register_node(${target}): unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  foreach(required IN ITEMS PLUGIN EXECUTABLE)
    if(NOT ARG_${required})
      message(FATAL_ERROR "rclcpp_components_register_node(${target}): ${required} is missing")
    endif()
  endforeach()
  _rclcpp_components_register("${ARG_RESOURCE_INDEX}" "${ARG_PACKAGE}" ${target} ${ARG_PLUGIN})
  if(ARG_NO_UNDEFINED_SYMBOLS)
    target_link_options(${target} PRIVATE LINKER:--no-undefined)
  endif()

  set(component ${ARG_PLUGIN})
  set(header single_threaded_node_main)
  set(function single_threaded_node_main)
  if(ARG_EXECUTOR)
    set(header node_main)
    set(function "node_main<rclcpp::executors::${ARG_EXECUTOR}>")
  endif()
  set(program ${ARG_EXECUTABLE})
  set(pkg ${PROJECT_NAME})
  if(ARG_PACKAGE)
    set(pkg ${ARG_PACKAGE})
    set(program ${pkg}_${ARG_EXECUTABLE})
  endif()
  get_property(template GLOBAL PROPERTY RCLCPP_COMPONENTS_NODE_MAIN)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/rclcpp_components/${program}.cpp)
  configure_file(${template} ${source} @ONLY)
  add_executable(${program} ${source})
  set_target_properties(${program} PROPERTIES OUTPUT_NAME ${ARG_EXECUTABLE})
  _stack_place(${program} lib/${pkg} "$ORIGIN/..")
  _rclcpp_components_needed(needed ${target})
  target_link_libraries(${program} PRIVATE rclcpp_components::rclcpp_components ${needed})
  install(TARGETS ${program} RUNTIME DESTINATION lib/${pkg})
endfunction()

# _rclcpp_components_needed(<result> <target>): what a program links that calls no function of the library, and wants its
# registrations.
function(_rclcpp_components_needed result target)
  if(CMAKE_VERSION VERSION_LESS 3.24)
    set(${result} -Wl,--push-state,--no-as-needed ${target} -Wl,--pop-state PARENT_SCOPE)
  else()
    set(${result} "$<LINK_LIBRARY:NEEDED_COMPONENT,${target}>" PARENT_SCOPE)
  endif()
endfunction()

set(CMAKE_LINK_LIBRARY_USING_NEEDED_COMPONENT
  LINKER:--push-state,--no-as-needed <LINK_ITEM> LINKER:--pop-state CACHE INTERNAL "")
set(CMAKE_LINK_LIBRARY_USING_NEEDED_COMPONENT_SUPPORTED TRUE CACHE INTERNAL "")

# The entries of a package are collected first, and written when its folder is complete.
function(_rclcpp_components_register index pkg target)
  if(NOT TARGET ${target})
    message(FATAL_ERROR "rclcpp_components: '${target}' is no target")
  endif()
  if(NOT index)
    set(index rclcpp_components)
  endif()
  if(NOT pkg)
    set(pkg ${PROJECT_NAME})
  endif()
  # An installed component finds the libraries that it was linked with: those of its package in its own folder, others
  # where they are.
  set_target_properties(${target} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
  get_target_property(rpath ${target} INSTALL_RPATH)
  if(NOT rpath)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
  set(entries RCLCPP_COMPONENTS_${index}_${pkg})
  get_property(known GLOBAL PROPERTY ${entries} SET)
  foreach(class IN LISTS ARGN)
    set_property(GLOBAL APPEND_STRING PROPERTY ${entries} "${class};lib/$<TARGET_FILE_NAME:${target}>\n")
  endforeach()
  if(NOT known)
    stack_package(${pkg})
    # EVAL, because the arguments of a deferred call are evaluated when it runs, and these variables do not exist then.
    cmake_language(EVAL CODE
      "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL _rclcpp_components_write [[${index}]] [[${pkg}]])")
  endif()
endfunction()

function(_rclcpp_components_write index pkg)
  get_property(entries GLOBAL PROPERTY RCLCPP_COMPONENTS_${index}_${pkg})
  set(file share/ament_index/resource_index/${index}/${pkg})
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/prefix/${file} CONTENT "${entries}")
  install(FILES ${PROJECT_BINARY_DIR}/prefix/${file} DESTINATION share/ament_index/resource_index/${index})
endfunction()
