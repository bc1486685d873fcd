# SPDX-License-Identifier: Apache-2.0
# Tells containers which components a library has, and makes programs of components.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # StackPackage stands beside it when installed
include(StackPackage)

set_property(GLOBAL PROPERTY RCLCPP_COMPONENTS_NODE_MAIN ${CMAKE_CURRENT_LIST_DIR}/node_main.cpp.in)

# ROS 2's names of the parts of the package; here it is one library.
if(TARGET rclcpp_components::rclcpp_components)
  foreach(part IN ITEMS component component_manager)
    add_library(rclcpp_components::${part} INTERFACE IMPORTED)
    target_link_libraries(rclcpp_components::${part} INTERFACE rclcpp_components::rclcpp_components)
  endforeach()
endif()

# rclcpp_components_register_nodes(<target> <class>... [RESOURCE_INDEX <index>] [PACKAGE <pkg>])
#
# Enters components of the shared library <target> into the ament index. Install the library yourself, with LIBRARY
# DESTINATION lib. The package is the current project unless told otherwise.
function(rclcpp_components_register_nodes target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "RESOURCE_INDEX;PACKAGE" "")
  _rclcpp_components_register("${ARG_RESOURCE_INDEX}" "${ARG_PACKAGE}" ${target} ${ARG_UNPARSED_ARGUMENTS})
endfunction()

# rclcpp_components_register_node(<target> PLUGIN <class> EXECUTABLE <executable> [EXECUTOR <executor>]
#                                 [RESOURCE_INDEX <index>] [PACKAGE <pkg>])
#
# The same for one component, and a program in lib/<pkg> that runs it: its CMake target is <executable>, with PACKAGE
# <pkg>_<executable>. The executor is a class of rclcpp::executors, SingleThreadedExecutor unless told otherwise. ROS 2's
# option NO_UNDEFINED_SYMBOLS lets the linker refuse undefined symbols in the library.
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
  # The program calls nothing of the library: it is there for what it registers.
  target_link_libraries(${program} PRIVATE
    rclcpp_components::rclcpp_components "$<LINK_LIBRARY:NEEDED_COMPONENT,${target}>")
  install(TARGETS ${program} RUNTIME DESTINATION lib/${pkg})
endfunction()

set(CMAKE_LINK_LIBRARY_USING_NEEDED_COMPONENT
  LINKER:--push-state,--no-as-needed <LINK_ITEM> LINKER:--pop-state CACHE INTERNAL "")
set(CMAKE_LINK_LIBRARY_USING_NEEDED_COMPONENT_SUPPORTED TRUE CACHE INTERNAL "")

# The entries of a package are collected, and written when its folder is complete.
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
  # An installed component finds the libraries that it was linked with: its own package's beside it, others wherever
  # they are.
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
    # EVAL, for the arguments of a deferred call are evaluated when it is made: there these variables do not exist.
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
