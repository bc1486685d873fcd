# SPDX-License-Identifier: Apache-2.0
# Makes a folder a ROS package: its library, its executables, and its place in a prefix.
#
# The build tree contains a prefix with the layout of the installed one, ${PROJECT_BINARY_DIR}/prefix. So programs that
# find packages by AMENT_PREFIX_PATH work before installing:
#   lib/lib<pkg>.so   lib/<pkg>/<executable>   share/<pkg>/package.xml   share/ament_index/resource_index/packages/<pkg>
# Run paths are relative ($ORIGIN), so either prefix can be moved. Users of an installed prefix write find_package(<pkg>
# REQUIRED) and link <pkg>::<pkg>. This file is also installed, because rosidl_generate_interfaces needs it in users'
# projects.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)  # users' projects may ask for older behaviour for themselves
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Programs and libraries keep the libraries that they were built with, also in a shell where another ROS 2 is sourced:
# its LD_LIBRARY_PATH comes before run paths (DT_RUNPATH), but not before DT_RPATH. That includes libraries of the
# system, because other installations of ROS 2 bring a libfastcdr.so.1 of their own.
set(STACK_KEEPS_LIBRARIES LINKER:--disable-new-dtags)
set(STACK_SYSTEM_LIBRARIES "")
if(CMAKE_LIBRARY_ARCHITECTURE AND IS_DIRECTORY /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE})
  set(STACK_SYSTEM_LIBRARIES /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE})
endif()
set(STACK_PREFIX_LIBRARIES "")  # of the stack, for packages of users; they come before those of the system
if(CMAKE_CURRENT_LIST_DIR MATCHES "^(.*)/share/[^/]+/cmake$")
  set(STACK_PREFIX_LIBRARIES ${CMAKE_MATCH_1}/lib)
endif()

# stack_library(<pkg> [SOURCES <file>...] [PUBLIC <target>...] [PRIVATE <target>...] [INCLUDE <dir>...]
#               [CONFIG_EXTRAS <file>...] [PACKAGE <name>] [ALSO <target>...] [FINDS <target>...]
#               [SKIP_INSTALL])
#
# A shared library (without SOURCES: headers only) with the alias <pkg>::<pkg>. Its headers are those under each <dir>,
# by default include/. The package has the name of the library unless PACKAGE says otherwise. CONFIG_EXTRAS are CMake files
# that find_package(<pkg>) runs. ALSO are further targets of the package, FINDS are targets of the packages that they
# need. With SKIP_INSTALL it is only a library of the build tree, not a package.
function(stack_library pkg)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_INSTALL" "PACKAGE" "SOURCES;PUBLIC;PRIVATE;INCLUDE;CONFIG_EXTRAS;ALSO;FINDS")
  if(NOT ARG_PACKAGE)
    set(ARG_PACKAGE ${pkg})
  endif()
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "stack_library(${pkg}): unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT ARG_INCLUDE AND EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    set(ARG_INCLUDE ${CMAKE_CURRENT_SOURCE_DIR}/include)
  endif()

  if(ARG_SOURCES)
    set(scope PUBLIC)
    add_library(${pkg} SHARED ${ARG_SOURCES})
    if(TARGET project_options)
      target_link_libraries(${pkg} PRIVATE project_options)
    endif()
    target_link_libraries(${pkg} PRIVATE ${ARG_PRIVATE})
    # When a message comes, the code on its way is no longer in the caches, so every cache line counts. Calls go
    # directly to their target, without stubs, and calls within a library do not even use a table. The dynamic linker
    # resolves all symbols at the start, which takes less than a millisecond.
    target_compile_options(${pkg} PRIVATE -fno-plt $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
    target_link_options(${pkg} PRIVATE -Wl,-Bsymbolic-functions)
  else()
    set(scope INTERFACE)
    add_library(${pkg} INTERFACE)
  endif()
  add_library(${pkg}::${pkg} ALIAS ${pkg})
  if(ARG_INCLUDE)
    target_include_directories(${pkg} ${scope}
      "$<BUILD_INTERFACE:${ARG_INCLUDE}>" $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/${ARG_PACKAGE}>)
  endif()
  target_link_libraries(${pkg} ${scope} ${ARG_PUBLIC})
  target_compile_features(${pkg} ${scope} cxx_std_17)
  target_link_options(${pkg} ${scope} ${STACK_KEEPS_LIBRARIES})
  if(ARG_SKIP_INSTALL)
    return()
  endif()

  if(ARG_SOURCES)
    _stack_place(${pkg} lib "$ORIGIN")
  endif()
  if(ARG_INCLUDE)
    list(TRANSFORM ARG_INCLUDE APPEND "/")
    install(DIRECTORY ${ARG_INCLUDE} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${ARG_PACKAGE})
  endif()
  install(TARGETS ${pkg} EXPORT stack_${ARG_PACKAGE} LIBRARY DESTINATION lib)
  stack_package(${ARG_PACKAGE})
  _stack_export(${pkg} ${ARG_PACKAGE} DEPENDENCIES ${ARG_PUBLIC} ${ARG_PRIVATE} ${ARG_FINDS}
    EXTRAS ${ARG_CONFIG_EXTRAS} ALSO ${ARG_ALSO})
endfunction()

# stack_node(<pkg> <executable> SOURCES <file>... LINK <target>...)
#
# An executable for `<node pkg="<pkg>" exec="<executable>"/>`. Several packages may have executables with the same name;
# the CMake target is <pkg>_<executable>.
function(stack_node pkg executable)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "SOURCES;LINK")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "stack_node(${pkg} ${executable}): unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(target ${pkg}_${executable})
  add_executable(${target} ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${executable})
  _stack_place(${target} lib/${pkg} "$ORIGIN/..")
  if(TARGET project_options)
    target_link_libraries(${target} PRIVATE project_options)
  endif()
  target_link_libraries(${target} PRIVATE ${ARG_LINK})
  install(TARGETS ${target} RUNTIME DESTINATION lib/${pkg})
  stack_package(${pkg})
endfunction()

# stack_plugin(<pkg> <library> SOURCES <file>... LINK <target>...)
#
# A shared library that is loaded by name at run time, such as one with components. No target links it. The CMake target
# is <library>.
function(stack_plugin pkg library)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "SOURCES;LINK")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "stack_plugin(${pkg} ${library}): unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  add_library(${library} SHARED ${ARG_SOURCES})
  _stack_place(${library} lib "$ORIGIN")
  if(TARGET project_options)
    target_link_libraries(${library} PRIVATE project_options)
  endif()
  target_link_libraries(${library} PRIVATE ${ARG_LINK})
  install(TARGETS ${library} LIBRARY DESTINATION lib)
  stack_package(${pkg})
endfunction()

# stack_package(<pkg>)
#
# Adds the package to the ament index and copies its package.xml, in both prefixes. stack_library and stack_node call
# it; call it yourself for a package that has neither.
function(stack_package pkg)
  get_property(known GLOBAL PROPERTY STACK_PACKAGE_${pkg})
  if(known)
    return()
  endif()
  set_property(GLOBAL PROPERTY STACK_PACKAGE_${pkg} TRUE)
  set(marker share/ament_index/resource_index/packages)
  file(WRITE ${PROJECT_BINARY_DIR}/prefix/${marker}/${pkg} "")
  install(FILES ${PROJECT_BINARY_DIR}/prefix/${marker}/${pkg} DESTINATION ${marker})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/package.xml)
    configure_file(package.xml ${PROJECT_BINARY_DIR}/prefix/share/${pkg}/package.xml COPYONLY)
    install(FILES package.xml DESTINATION share/${pkg})
  endif()
endfunction()

# stack_package_version(<variable>)
#
# The version in the current folder's package.xml, or the project's version if there is none.
function(stack_package_version variable)
  set(version ${PROJECT_VERSION})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/package.xml)
    file(STRINGS package.xml line REGEX "<version>.*</version>" LIMIT_COUNT 1)
    string(REGEX REPLACE ".*<version>(.*)</version>.*" "\\1" version "${line}")
    string(STRIP "${version}" version)
  endif()
  if(NOT version)
    set(version 0.0.0)
  endif()
  set(${variable} ${version} PARENT_SCOPE)
endfunction()

# Puts a binary at `place` in the build tree's prefix. The binary finds the libraries of its own prefix by relative
# paths. Others are found where they were linked, because the packages of users are in other prefixes than the stack.
function(_stack_place target place rpath)
  set_target_properties(${target} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/prefix/${place}
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/prefix/${place}
    BUILD_RPATH "${rpath};${STACK_PREFIX_LIBRARIES};${STACK_SYSTEM_LIBRARIES}"
    INSTALL_RPATH "${rpath};${STACK_PREFIX_LIBRARIES};${STACK_SYSTEM_LIBRARIES}"
    INSTALL_RPATH_USE_LINK_PATH ON)
  target_link_options(${target} PRIVATE ${STACK_KEEPS_LIBRARIES})
endfunction()

# Writes share/<pkg>/cmake/<pkg>Config.cmake. It finds the packages among DEPENDENCIES, then defines the target and the
# variables <pkg>_TARGETS, _LIBRARIES and _INCLUDE_DIRS, and runs EXTRAS last.
function(_stack_export target pkg)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "DEPENDENCIES;EXTRAS;ALSO")
  list(TRANSFORM ARG_ALSO PREPEND ${pkg}::)
  set_target_properties(${target} PROPERTIES STACK_PACKAGE ${pkg})
  set_property(TARGET ${target} APPEND PROPERTY EXPORT_PROPERTIES STACK_PACKAGE)
  set(config "include(CMakeFindDependencyMacro)\n")
  foreach(dependency IN LISTS ARG_DEPENDENCIES)
    if(TARGET ${dependency})
      get_target_property(package ${dependency} STACK_PACKAGE)
      if(package)
        string(APPEND config "find_dependency(${package})\n")
      endif()
    endif()
  endforeach()
  string(APPEND config "include(\${CMAKE_CURRENT_LIST_DIR}/${pkg}Targets.cmake)\n"
    "set(${pkg}_TARGETS ${pkg}::${target} ${ARG_ALSO})\n"
    "set(${pkg}_LIBRARIES ${pkg}::${target} ${ARG_ALSO})\n"
    "get_target_property(${pkg}_INCLUDE_DIRS ${pkg}::${target} INTERFACE_INCLUDE_DIRECTORIES)\n"
    "if(NOT ${pkg}_INCLUDE_DIRS)\n  set(${pkg}_INCLUDE_DIRS \"\")\nendif()\n")
  if(NOT target STREQUAL pkg)
    string(APPEND config "set(${pkg}_ROSIDL_TARGET ${pkg}::${target})\n")
  endif()
  foreach(extra IN LISTS ARG_EXTRAS)
    get_filename_component(name ${extra} NAME)
    string(APPEND config "include(\${CMAKE_CURRENT_LIST_DIR}/${name})\n")
    install(FILES ${extra} DESTINATION share/${pkg}/cmake)
  endforeach()

  install(EXPORT stack_${pkg} NAMESPACE ${pkg}:: FILE ${pkg}Targets.cmake DESTINATION share/${pkg}/cmake)
  _stack_config(${pkg} "${config}")
endfunction()

# Writes the package's configuration and its version. The configuration also reads the exports of ament_package().
#
# The configuration is read once in a scope. Otherwise CMake would read it once for each chain of dependencies that leads
# to it. A package of the size of a Navigation 2 server has 18,000 of these.
function(_stack_config pkg config)
  set_property(GLOBAL PROPERTY STACK_CONFIG_${pkg} TRUE)
  string(PREPEND config "if(_${pkg}_CONFIG_READ)\n  return()\nendif()\n")
  string(APPEND config "include(\${CMAKE_CURRENT_LIST_DIR}/${pkg}Exports.cmake OPTIONAL)\n"
    "if(NOT DEFINED ${pkg}_FOUND OR ${pkg}_FOUND)\n  set(_${pkg}_CONFIG_READ TRUE)\nendif()\n")
  set(config_file ${CMAKE_CURRENT_BINARY_DIR}/${pkg}Config.cmake)
  set(version_file ${CMAKE_CURRENT_BINARY_DIR}/${pkg}ConfigVersion.cmake)
  file(CONFIGURE OUTPUT ${config_file} CONTENT "${config}" @ONLY)
  stack_package_version(version)
  write_basic_package_version_file(${version_file} VERSION ${version} COMPATIBILITY AnyNewerVersion)
  install(FILES ${config_file} ${version_file} DESTINATION share/${pkg}/cmake)
endfunction()
