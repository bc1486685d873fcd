# SPDX-License-Identifier: Apache-2.0
# The small functions of ament_cmake_core and its parts that packages call.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# list_append_unique(<list> <value>...): appends the values that the list does not hold.
macro(list_append_unique variable)
  foreach(_ament_value ${ARGN})
    list(FIND ${variable} "${_ament_value}" _ament_index)
    if(_ament_index EQUAL -1)
      list(APPEND ${variable} "${_ament_value}")
    endif()
  endforeach()
endmacro()

# get_executable_path(<variable> <executable> [CONFIGURE|BUILD]): the file of a program target, or of a program by its
# path. While CMake configures, only the second kind has a file.
function(get_executable_path variable executable)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "CONFIGURE;BUILD" "" "")
  set(path "${executable}")
  if(TARGET ${executable})
    get_target_property(path ${executable} IMPORTED_LOCATION)
    if(NOT path)
      if(ARG_CONFIGURE)
        message(FATAL_ERROR "get_executable_path(${executable}): the program is built later, so it has no path yet")
      endif()
      set(path "$<TARGET_FILE:${executable}>")
    endif()
  endif()
  set(${variable} "${path}" PARENT_SCOPE)
endfunction()

# normalize_path(<variable> <path>): without '.', '..' and doubled slashes.
function(normalize_path variable path)
  cmake_path(SET normal NORMALIZE "${path}")
  set(${variable} "${normal}" PARENT_SCOPE)
endfunction()

# string_starts_with(<string> <start> <variable>), string_ends_with(<string> <end> <variable>)
function(string_starts_with string start variable)
  string(FIND "${string}" "${start}" position)
  set(result FALSE)
  if(position EQUAL 0)
    set(result TRUE)
  endif()
  set(${variable} ${result} PARENT_SCOPE)
endfunction()
function(string_ends_with string end variable)
  string(LENGTH "${string}" length)
  string(LENGTH "${end}" end_length)
  set(result FALSE)
  if(NOT end_length GREATER length)
    math(EXPR begin "${length} - ${end_length}")
    string(SUBSTRING "${string}" ${begin} -1 last)
    if(last STREQUAL end)
      set(result TRUE)
    endif()
  endif()
  set(${variable} ${result} PARENT_SCOPE)
endfunction()

# stamp(<file>): configures anew when the file changes.
function(stamp file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
endfunction()

# assert_file_exists(<file> <message>)
function(assert_file_exists file error)
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "${error}")
  endif()
endfunction()

# ament_add_default_options([EXCLUDE_BUILD_SHARED_LIBS]): libraries are shared unless their package says otherwise.
macro(ament_add_default_options)
  if(NOT "${ARGN}" MATCHES "EXCLUDE_BUILD_SHARED_LIBS")
    option(BUILD_SHARED_LIBS "Build libraries as shared ones" ON)
  endif()
endmacro()

# ament_register_extension(<point> <pkg> <file>), ament_execute_extensions(<point> [EXCLUDE <pkg>...])
#
# A package names a CMake file for a point, and the file runs when the point comes. The points are those that packages
# execute themselves, and ament_package.
function(ament_register_extension point pkg file)
  if(NOT IS_ABSOLUTE "${file}")
    set(file "${${pkg}_DIR}/${file}")
  endif()
  set_property(GLOBAL APPEND PROPERTY AMENT_EXTENSIONS_${point} "${pkg}:${file}")
endfunction()
macro(ament_execute_extensions point)
  cmake_parse_arguments(_ament_execute "" "" "EXCLUDE" ${ARGN})
  get_property(_ament_extensions GLOBAL PROPERTY AMENT_EXTENSIONS_${point})
  foreach(_ament_extension IN LISTS _ament_extensions)
    string(REGEX MATCH "^([^:]+):(.*)$" _ament_match "${_ament_extension}")
    set(_ament_file "${CMAKE_MATCH_2}")
    if(NOT "${CMAKE_MATCH_1}" IN_LIST _ament_execute_EXCLUDE)
      include("${_ament_file}")
    endif()
  endforeach()
endmacro()

# ament_get_recursive_properties(<include variable> <library variable> <target>...)
#
# The folders and libraries that targets bring to those that link them.
function(ament_get_recursive_properties includes_variable libraries_variable)
  set(includes "")
  set(libraries "")
  foreach(target IN LISTS ARGN)
    if(TARGET ${target})
      get_target_property(of_target ${target} INTERFACE_INCLUDE_DIRECTORIES)
      if(of_target)
        list(APPEND includes ${of_target})
      endif()
      get_target_property(linked ${target} INTERFACE_LINK_LIBRARIES)
      if(linked)
        ament_get_recursive_properties(of_linked libraries_of_linked ${linked})
        list(APPEND includes ${of_linked})
        list(APPEND libraries ${linked} ${libraries_of_linked})
      endif()
    endif()
  endforeach()
  list(REMOVE_DUPLICATES includes)
  list(REMOVE_DUPLICATES libraries)
  set(${includes_variable} "${includes}" PARENT_SCOPE)
  set(${libraries_variable} "${libraries}" PARENT_SCOPE)
endfunction()

# ament_generate_environment(), ament_generate_package_environment(), ament_index_register_package()
#
# Steps that ament_package() does here.
function(ament_generate_environment)
endfunction()
function(ament_generate_package_environment)
endfunction()
function(ament_index_register_package)
endfunction()

# ament_cmake_uninstall_target_append_uninstall_code(<code>), ament_cmake_symlink_install_…: there is no target
# `uninstall`, and files are always copied.
function(ament_cmake_uninstall_target_append_uninstall_code)
endfunction()

# ament_vendor(<name> [SATISFIED] …)
#
# In ROS 2 it downloads and builds a library unless the system has it. Here the system must have it.
function(ament_vendor name)
  if(NOT ("${ARGN}" MATCHES "(^|;)SATISFIED(;|$)"))
    message(FATAL_ERROR "ament_vendor(${name}): nothing is downloaded here; install the library of the system")
  endif()
endfunction()
