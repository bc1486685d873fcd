# SPDX-License-Identifier: Apache-2.0
# rosidl_generate_interfaces(<target> <file>... [DEPENDENCIES <pkg>...] [LIBRARY_NAME <name>])
#
# Makes the messages, services and actions of a package: the shared library <target> and the headers
# <pkg>/msg/<name>.hpp, <pkg>/srv/<name>.hpp and <pkg>/action/<name>.hpp. <pkg> is the project if it has a package.xml,
# and <target> otherwise. Others link <pkg>::<target>. For programs in C there are the library
# <target>__rosidl_generator_c and the headers <pkg>/msg/<name>.h. For programs in Python there are the modules <pkg>.msg,
# <pkg>.srv and <pkg>.action below PYTHON_INSTALL_DIR, which load that library when a type is sent first.
#
# Files are "msg/<Name>.msg", "srv/<Name>.srv", "action/<Name>.action" or the same with ".idl". They are relative to the
# current folder, or to another one, as in "<folder>:msg/<Name>.msg", or absolute. The folder of a file is the namespace
# of its types, unless it has another name than msg, srv and action; then its extension is.
#
# DEPENDENCIES are the packages whose messages they use; outside the stack find_package them first. Dependencies of
# services and actions in general are added automatically. With a LIBRARY_NAME, or if <target> is not <pkg>, the library
# leaves the file lib<pkg>.so to the package. SKIP_INSTALL makes a library only for this build. ROS 2's options for
# linters and groups have no effect here. INCLUDE are folders with further headers, for packages of the stack.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # when installed, StackPackage is in this folder
include(StackPackage)

set_property(GLOBAL PROPERTY ROSIDL_GENERATOR ${CMAKE_CURRENT_LIST_DIR}/../rosidl_generator)

# Sets the lists `files` (absolute), `types` (pkg/msg/Name) and `names` (msg/name_in_snake_case) of the caller.
macro(_rosidl_files)
  set(files "")
  set(types "")
  set(names "")
  foreach(file IN LISTS ARG_UNPARSED_ARGUMENTS)
    string(REGEX REPLACE ":([^:]*)$" "/\\1" path "${file}")
    get_filename_component(path "${path}" ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    if(NOT path MATCHES "([^/]+)/([A-Za-z0-9_]+)\\.(msg|srv|action|idl)$")
      message(FATAL_ERROR "rosidl_generate_interfaces(${target}): "
        "'${file}' is none of msg/<Name>.msg, srv/<Name>.srv, action/<Name>.action and msg/<Name>.idl")
    endif()
    set(namespace ${CMAKE_MATCH_1})
    set(type ${CMAKE_MATCH_2})
    if(NOT namespace MATCHES "^(msg|srv|action)$")
      set(namespace ${CMAKE_MATCH_3})
    endif()
    if(namespace STREQUAL idl)
      message(FATAL_ERROR "rosidl_generate_interfaces(${target}): "
        "'${file}' must be in a folder 'msg', 'srv' or 'action', which says what it defines")
    endif()
    if(NOT EXISTS "${path}")
      message(FATAL_ERROR "rosidl_generate_interfaces(${target}): there is no file '${path}'")
    endif()
    list(APPEND files ${path})
    list(APPEND types ${pkg}/${namespace}/${type})
    string(REGEX REPLACE "(.)([A-Z][a-z]+)" "\\1_\\2" name ${type})
    string(REGEX REPLACE "([a-z0-9])([A-Z])" "\\1_\\2" name ${name})
    string(TOLOWER ${name} name)
    list(APPEND names ${namespace}/${name})
    if(NOT ARG_SKIP_INSTALL)
      get_filename_component(name ${path} NAME)
      configure_file(${path} ${PROJECT_BINARY_DIR}/prefix/share/${pkg}/${namespace}/${name} COPYONLY)
      install(FILES ${path} DESTINATION share/${pkg}/${namespace})
    endif()
  endforeach()
endmacro()

# The library for C. Programs in C++ that link all of a package (<pkg>_TARGETS) shall not load it, so it is linked only if
# something in it is used, which is the default of linkers on Ubuntu.
macro(_rosidl_library_of_c)
  set(library ${target}__rosidl_generator_c)
  add_library(${library} SHARED ${source_of_c})
  add_library(${pkg}::${library} ALIAS ${library})
  if(ARG_LIBRARY_NAME)
    set_target_properties(${library} PROPERTIES OUTPUT_NAME ${ARG_LIBRARY_NAME}__rosidl_generator_c)
  endif()
  if(TARGET project_options)
    target_link_libraries(${library} PRIVATE project_options)
  endif()
  target_link_libraries(${library} PUBLIC ${target} rosidl_typesupport_c::rosidl_typesupport_c ${libraries_of_c})
  target_link_options(${library} INTERFACE LINKER:--as-needed)
  set_target_properties(${library} PROPERTIES STACK_PACKAGE ${pkg})
  if(ARG_SKIP_INSTALL)
    set_target_properties(${library} PROPERTIES EXCLUDE_FROM_ALL ON)
  else()
    _stack_place(${library} lib "$ORIGIN")
    install(TARGETS ${library} EXPORT stack_${pkg} LIBRARY DESTINATION lib)
  endif()
endmacro()

# Sets `python` to the arguments of the generator for the modules in Python, and `modules` to their files.
macro(_rosidl_modules_of_python)
  set(python "")
  set(modules "")
  if(NOT ARG_SKIP_INSTALL)
    if(NOT PYTHON_INSTALL_DIR)
      set(PYTHON_INSTALL_DIR lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages)
    endif()
    set(folder ${PROJECT_BINARY_DIR}/prefix/${PYTHON_INSTALL_DIR})
    file(RELATIVE_PATH libraries_of_modules /prefix/${PYTHON_INSTALL_DIR}/${pkg}/msg /prefix/lib/lib)
    set(library ${target})
    if(ARG_LIBRARY_NAME)
      set(library ${ARG_LIBRARY_NAME})
    endif()
    set(python --python-output ${folder}
      --python-library ${libraries_of_modules}${library}__rosidl_generator_c${CMAKE_SHARED_LIBRARY_SUFFIX})
    foreach(name IN LISTS names)
      string(REPLACE "/" "/_" name ${name})
      list(APPEND modules ${folder}/${pkg}/${name}.py)
    endforeach()
    install(DIRECTORY ${folder}/${pkg} DESTINATION ${PYTHON_INSTALL_DIR} FILES_MATCHING PATTERN "*.py"
      PATTERN __pycache__ EXCLUDE)
  endif()
endmacro()

function(rosidl_generate_interfaces target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "ADD_LINTER_TESTS;SKIP_INSTALL;SKIP_GROUP_MEMBERSHIP_CHECK" "LIBRARY_NAME"
    "DEPENDENCIES;INCLUDE")
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  find_package(fastcdr REQUIRED)
  set(pkg ${target})
  if(EXISTS ${PROJECT_SOURCE_DIR}/package.xml)
    set(pkg ${PROJECT_NAME})
  endif()
  _rosidl_files()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/rosidl)
  if(NOT target STREQUAL pkg)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/rosidl_${target})
  endif()
  set(source ${output}/${pkg}__interfaces.cpp)
  set(source_of_c ${output}/${pkg}__c.cpp)
  set(headers ${output}/include/${pkg}/detail/cdr_codecs.hpp)
  foreach(name IN LISTS names)
    get_filename_component(folder ${name} DIRECTORY)
    get_filename_component(name ${name} NAME)
    list(APPEND headers ${output}/include/${pkg}/${folder}/${name}.hpp)
    foreach(part IN ITEMS struct builder traits type_support)
      list(APPEND headers ${output}/include/${pkg}/${folder}/detail/${name}__${part}.hpp)
    endforeach()
    list(APPEND headers ${output}/include/${pkg}/${folder}/${name}.h)
    foreach(part IN ITEMS struct functions type_support)
      list(APPEND headers ${output}/include/${pkg}/${folder}/detail/${name}__${part}.h)
    endforeach()
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
  set(libraries_of_c "")
  foreach(dependency IN LISTS ARG_DEPENDENCIES)
    set(of_package ${${dependency}_ROSIDL_TARGET})
    if(NOT of_package)
      set(of_package ${dependency}::${dependency})
    endif()
    if(NOT TARGET ${of_package})
      message(FATAL_ERROR "rosidl_generate_interfaces(${target}): package '${dependency}' is not known; "
        "write find_package(${dependency} REQUIRED) before")
    endif()
    get_target_property(of_dependency ${of_package} ROSIDL_INTERFACES)
    if(of_dependency)
      list(APPEND known ${of_dependency})
      get_target_property(folder ${of_package} ROSIDL_OUTPUT)
      if(NOT folder)  # the package was found by find_package
        set(folder ${${dependency}_DIR}/..)
      endif()
      list(APPEND descriptions ${folder}/type_descriptions.json)
      list(APPEND libraries_of_c ${of_package}__rosidl_generator_c)
    endif()
    list(APPEND libraries ${of_package})
  endforeach()

  get_property(generator GLOBAL PROPERTY ROSIDL_GENERATOR)
  file(GLOB generator_sources ${generator}/*.py)
  _rosidl_modules_of_python()
  add_custom_command(
    OUTPUT ${source} ${source_of_c} ${headers} ${output}/type_descriptions.json ${modules}
    COMMAND ${Python3_EXECUTABLE} -B ${generator} --package ${pkg} --output ${output} --known ${known}
      --descriptions ${descriptions} ${python} -- ${files}
    DEPENDS ${files} ${descriptions} ${generator_sources}
    COMMENT "Generating the C++, C and Python of ${pkg}"
    VERBATIM)

  set(skip_install "")
  if(ARG_SKIP_INSTALL)
    set(skip_install SKIP_INSTALL)
  endif()
  stack_library(${target} ${skip_install} PACKAGE ${pkg}
    ALSO ${target}__rosidl_generator_c FINDS rosidl_typesupport_c::rosidl_typesupport_c
    SOURCES ${source} ${headers}
    PUBLIC rosidl_runtime_cpp::rosidl_runtime_cpp rosidl_typesupport_cpp::rosidl_typesupport_cpp
           rosidl_typesupport_fastrtps_cpp::rosidl_typesupport_fastrtps_cpp
           rosidl_default_runtime::rosidl_default_runtime ${libraries}
    PRIVATE fastcdr
    INCLUDE ${output}/include ${ARG_INCLUDE})
  if(ARG_LIBRARY_NAME)
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${ARG_LIBRARY_NAME}__rosidl_typesupport_cpp)
  elseif(NOT target STREQUAL pkg)
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${target}__rosidl_typesupport_cpp)
  endif()
  _rosidl_library_of_c()
  if(TARGET interface_sources)
    add_custom_target(${target}__sources DEPENDS ${source} ${source_of_c} ${headers})
    add_dependencies(${target} ${target}__sources)
    add_dependencies(${target}__rosidl_generator_c ${target}__sources)
    add_dependencies(interface_sources ${target}__sources)
  endif()
  # In ROS 2 a package has a library for each language and type support. Here all these names mean the library of the
  # language. They are targets and not aliases, because a package may make aliases of them.
  foreach(part IN ITEMS rosidl_generator_cpp rosidl_typesupport_cpp rosidl_typesupport_fastrtps_cpp
                        rosidl_typesupport_c rosidl_typesupport_fastrtps_c)
    add_library(${target}__${part} INTERFACE)
    if(part MATCHES "_c$")
      target_link_libraries(${target}__${part} INTERFACE ${target}__rosidl_generator_c)
    else()
      target_link_libraries(${target}__${part} INTERFACE ${target})
    endif()
    if(NOT ARG_SKIP_INSTALL)
      install(TARGETS ${target}__${part} EXPORT stack_${pkg})
    endif()
  endforeach()
  if(NOT ARG_SKIP_INSTALL)
    install(FILES ${output}/type_descriptions.json DESTINATION share/${pkg})
  endif()
  set_target_properties(${target} PROPERTIES ROSIDL_INTERFACES "${types}" ROSIDL_OUTPUT ${output})
  set_property(TARGET ${target} APPEND PROPERTY EXPORT_PROPERTIES ROSIDL_INTERFACES)
endfunction()

# rosidl_target_interfaces(<target> <interfaces> <typesupport>)
#
# The older way for a target to use the messages of its own package. <interfaces> is the target of
# rosidl_generate_interfaces().
function(rosidl_target_interfaces target interfaces typesupport)
  rosidl_get_typesupport_target(library ${interfaces} ${typesupport})
  set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES ${library})
  set_property(TARGET ${target} APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${library})
endfunction()

# rosidl_get_typesupport_target(<variable> <interfaces> <typesupport>)
#
# The target that executables of the same package link to use its messages. <typesupport> tells the language:
# rosidl_typesupport_cpp or rosidl_typesupport_c.
function(rosidl_get_typesupport_target variable interfaces typesupport)
  set(library ${interfaces}::${interfaces})
  if(TARGET ${interfaces})
    set(library ${interfaces})
  elseif(${interfaces}_ROSIDL_TARGET)
    set(library ${${interfaces}_ROSIDL_TARGET})
  endif()
  if(typesupport MATCHES "_c$")
    string(APPEND library __rosidl_generator_c)
  endif()
  set(${variable} ${library} PARENT_SCOPE)
endfunction()
