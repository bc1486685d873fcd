# SPDX-License-Identifier: Apache-2.0
# Entries of the ament index besides the package itself.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# ament_index_register_resource(<type> [CONTENT <text>] [CONTENT_FILE <file>] [PACKAGE_NAME <pkg>])
#
# Registers the package as a resource of a type. Text and file may contain generator expressions.
function(ament_index_register_resource type)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_INSTALL" "CONTENT;CONTENT_FILE;PACKAGE_NAME" "")
  if(NOT ARG_PACKAGE_NAME)
    set(ARG_PACKAGE_NAME ${PROJECT_NAME})
  endif()
  set(entry share/ament_index/resource_index/${type}/${ARG_PACKAGE_NAME})
  if(ARG_CONTENT_FILE)
    get_filename_component(ARG_CONTENT_FILE ${ARG_CONTENT_FILE} ABSOLUTE)
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/prefix/${entry} INPUT ${ARG_CONTENT_FILE})
  else()
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/prefix/${entry} CONTENT "${ARG_CONTENT}")
  endif()
  if(NOT ARG_SKIP_INSTALL)
    install(FILES ${PROJECT_BINARY_DIR}/prefix/${entry} DESTINATION share/ament_index/resource_index/${type})
  endif()
endfunction()

# ament_index_get_prefix_path(<variable>): the prefixes of AMENT_PREFIX_PATH, this one's first.
function(ament_index_get_prefix_path variable)
  string(REPLACE ":" ";" prefixes "$ENV{AMENT_PREFIX_PATH}")
  set(${variable} ${CMAKE_INSTALL_PREFIX} ${prefixes} PARENT_SCOPE)
endfunction()

# ament_index_has_resource(<variable> <type> <name>): the prefix that has it, or FALSE.
function(ament_index_has_resource variable type name)
  ament_index_get_prefix_path(prefixes)
  set(${variable} FALSE PARENT_SCOPE)
  foreach(prefix IN LISTS prefixes)
    if(EXISTS ${prefix}/share/ament_index/resource_index/${type}/${name})
      set(${variable} ${prefix} PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# ament_index_get_resource(<variable> <type> <name>): its content.
function(ament_index_get_resource variable type name)
  ament_index_has_resource(prefix ${type} ${name})
  if(NOT prefix)
    message(FATAL_ERROR "ament_index_get_resource: there is no resource '${name}' of type '${type}'")
  endif()
  file(READ ${prefix}/share/ament_index/resource_index/${type}/${name} content)
  set(${variable} "${content}" PARENT_SCOPE)
endfunction()
