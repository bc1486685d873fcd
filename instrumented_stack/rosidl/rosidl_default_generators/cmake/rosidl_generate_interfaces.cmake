# SPDX-License-Identifier: Apache-2.0
# rosidl_generate_interfaces(<pkg> <file>... [DEPENDENCIES <pkg>...])
#
# Makes a package of messages, services and actions: the shared library <pkg> (linked as <pkg>::<pkg>) and the headers
# <pkg>/msg/<name>.hpp, <pkg>/srv/<name>.hpp and <pkg>/action/<name>.hpp. Files are given as "msg/<Name>.msg",
# "srv/<Name>.srv" or "action/<Name>.action", relative to the current folder. DEPENDENCIES are the packages whose
# messages they use; outside the stack find_package them first. Dependencies of services and actions in general are
# added automatically. SKIP_INSTALL makes a library only for this build. ROS 2's options for linters and groups have no
# effect here.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # when installed, StackPackage is in this folder
include(StackPackage)

set_property(GLOBAL PROPERTY ROSIDL_GENERATOR ${CMAKE_CURRENT_LIST_DIR}/../rosidl_generator)
set_property(GLOBAL PROPERTY ROSIDL_TARGET_NAMES ${CMAKE_CURRENT_LIST_DIR}/rosidl_target_names.cmake)

function(rosidl_generate_interfaces pkg)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "ADD_LINTER_TESTS;SKIP_INSTALL;SKIP_GROUP_MEMBERSHIP_CHECK" "" "DEPENDENCIES")
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  find_package(fastcdr REQUIRED)
  set(files ${ARG_UNPARSED_ARGUMENTS})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/rosidl)
  set(source ${output}/${pkg}__interfaces.cpp)
  set(headers ${output}/include/${pkg}/detail/cdr_codecs.hpp)
  set(types "")
  foreach(file IN LISTS files)
    if(NOT file MATCHES "^(msg|srv|action)/([A-Za-z0-9_]+)\\.(msg|srv|action)$")
      message(FATAL_ERROR "rosidl_generate_interfaces(${pkg}): "
        "'${file}' is none of msg/<Name>.msg, srv/<Name>.srv and action/<Name>.action")
    endif()
    set(namespace ${CMAKE_MATCH_1})
    list(APPEND types ${pkg}/${namespace}/${CMAKE_MATCH_2})
    string(REGEX REPLACE "(.)([A-Z][a-z]+)" "\\1_\\2" name ${CMAKE_MATCH_2})
    string(REGEX REPLACE "([a-z0-9])([A-Z])" "\\1_\\2" name ${name})
    string(TOLOWER ${name} name)
    list(APPEND headers ${output}/include/${pkg}/${namespace}/${name}.hpp)
    foreach(part IN ITEMS struct builder traits type_support)
      list(APPEND headers ${output}/include/${pkg}/${namespace}/detail/${name}__${part}.hpp)
    endforeach()
    get_filename_component(folder share/${pkg}/${file} DIRECTORY)
    if(NOT ARG_SKIP_INSTALL)
      install(FILES ${file} DESTINATION ${folder})
    endif()
  endforeach()

  set(implied "")
  if(types MATCHES "/(srv|action)/")
    list(APPEND implied service_msgs builtin_interfaces)
  endif()
  if(types MATCHES "/action/")
    list(APPEND implied action_msgs unique_identifier_msgs)
  endif()
  foreach(dependency IN LISTS implied)
    if(NOT TARGET ${dependency}::${dependency})
      find_package(${dependency} REQUIRED)
    endif()
    list(APPEND ARG_DEPENDENCIES ${dependency})
  endforeach()
  list(REMOVE_DUPLICATES ARG_DEPENDENCIES)
  set(known "")
  set(descriptions "")
  set(libraries "")
  foreach(dependency IN LISTS ARG_DEPENDENCIES)
    if(NOT TARGET ${dependency}::${dependency})
      message(FATAL_ERROR "rosidl_generate_interfaces(${pkg}): package '${dependency}' is not known; "
        "write find_package(${dependency} REQUIRED) before")
    endif()
    get_target_property(of_dependency ${dependency}::${dependency} ROSIDL_INTERFACES)
    if(of_dependency)
      list(APPEND known ${of_dependency})
      get_target_property(folder ${dependency}::${dependency} ROSIDL_OUTPUT)
      if(NOT folder)  # the package was found by find_package
        set(folder ${${dependency}_DIR}/..)
      endif()
      list(APPEND descriptions ${folder}/type_descriptions.json)
    endif()
    list(APPEND libraries ${dependency}::${dependency})
  endforeach()

  get_property(generator GLOBAL PROPERTY ROSIDL_GENERATOR)
  file(GLOB generator_sources ${generator}/*.py)
  set(paths ${files})
  list(TRANSFORM paths PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  add_custom_command(
    OUTPUT ${source} ${headers} ${output}/type_descriptions.json
    COMMAND ${Python3_EXECUTABLE} -B ${generator} --package ${pkg} --output ${output} --known ${known}
      --descriptions ${descriptions} -- ${paths}
    DEPENDS ${paths} ${descriptions} ${generator_sources}
    COMMENT "Generating the C++ of ${pkg}"
    VERBATIM)

  if(ARG_SKIP_INSTALL)
    set(skip_install SKIP_INSTALL)
  endif()
  get_property(target_names GLOBAL PROPERTY ROSIDL_TARGET_NAMES)
  stack_library(${pkg} ${skip_install}
    SOURCES ${source} ${headers}
    PUBLIC rosidl_runtime_cpp::rosidl_runtime_cpp rosidl_typesupport_cpp::rosidl_typesupport_cpp
           rosidl_typesupport_fastrtps_cpp::rosidl_typesupport_fastrtps_cpp ${libraries}
    PRIVATE fastcdr
    INCLUDE ${output}/include
    CONFIG_EXTRAS ${target_names})
  if(TARGET interface_sources)
    add_custom_target(${pkg}__sources DEPENDS ${source} ${headers})
    add_dependencies(${pkg} ${pkg}__sources)
    add_dependencies(interface_sources ${pkg}__sources)
  endif()
  foreach(part IN ITEMS rosidl_generator_cpp rosidl_typesupport_cpp rosidl_typesupport_fastrtps_cpp)
    add_library(${pkg}__${part} ALIAS ${pkg})
  endforeach()
  if(NOT ARG_SKIP_INSTALL)
    install(FILES ${output}/type_descriptions.json DESTINATION share/${pkg})
  endif()
  set_target_properties(${pkg} PROPERTIES ROSIDL_INTERFACES "${types}" ROSIDL_OUTPUT ${output})
  set_property(TARGET ${pkg} APPEND PROPERTY EXPORT_PROPERTIES ROSIDL_INTERFACES)
endfunction()

# rosidl_target_interfaces(<target> <pkg> <typesupport>)
#
# The older way for a target to use the messages of its own package.
function(rosidl_target_interfaces target pkg typesupport)
  set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES ${pkg}::${pkg})
  set_property(TARGET ${target} APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${pkg}::${pkg})
endfunction()

# rosidl_get_typesupport_target(<variable> <pkg> <name>)
#
# The target that executables of the same package link to use its messages.
function(rosidl_get_typesupport_target variable pkg)
  set(${variable} ${pkg}::${pkg} PARENT_SCOPE)
endfunction()
