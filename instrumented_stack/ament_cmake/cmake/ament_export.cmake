# SPDX-License-Identifier: Apache-2.0
# What find_package() of this package provides to others. Collected here, written by ament_package().
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

function(_ament_collect what)
  if(ARGN)
    set_property(GLOBAL APPEND PROPERTY AMENT_EXPORT_${what}_${PROJECT_NAME} ${ARGN})
  endif()
endfunction()

# ament_export_dependencies(<pkg>...)
#
# Packages that are found together with this one. Their libraries and headers count as its own.
function(ament_export_dependencies)
  _ament_collect(DEPENDENCIES ${ARGN})
endfunction()

# ament_export_targets(<export>... [HAS_LIBRARY_TARGET] [NAMESPACE <namespace>])
#
# The targets of install(TARGETS … EXPORT <export>), as <pkg>::<target>.
function(ament_export_targets)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "HAS_LIBRARY_TARGET" "NAMESPACE" "")
  if(NOT ARG_NAMESPACE)
    set(ARG_NAMESPACE ${PROJECT_NAME}::)
  endif()
  foreach(export IN LISTS ARG_UNPARSED_ARGUMENTS)
    install(EXPORT ${export} DESTINATION share/${PROJECT_NAME}/cmake NAMESPACE ${ARG_NAMESPACE}
      FILE ${export}Export.cmake)
    _ament_collect(TARGETS ${export}Export.cmake)
  endforeach()
endfunction()
function(ament_export_interfaces)
  ament_export_targets(${ARGN})
endfunction()

# ament_export_include_directories(<dir>...): relative to the prefix.
function(ament_export_include_directories)
  _ament_collect(INCLUDE_DIRS ${ARGN})
endfunction()

# ament_export_libraries(<library>...): targets of the project, names in the prefix's lib folder, or absolute files.
function(ament_export_libraries)
  foreach(library IN LISTS ARGN)
    if(TARGET ${library})
      get_target_property(type ${library} TYPE)
      if(type STREQUAL INTERFACE_LIBRARY)
        continue()
      endif()
      get_target_property(name ${library} OUTPUT_NAME)
      if(name)
        set(library ${name})
      endif()
    endif()
    _ament_collect(LIBRARIES ${library})
  endforeach()
endfunction()
function(ament_export_library_names)
  ament_export_libraries(${ARGN})
endfunction()

# ament_export_definitions(<definition>...), ament_export_link_flags(<flag>...)
function(ament_export_definitions)
  _ament_collect(DEFINITIONS ${ARGN})
endfunction()
function(ament_export_link_flags)
  _ament_collect(LINK_FLAGS ${ARGN})
endfunction()
