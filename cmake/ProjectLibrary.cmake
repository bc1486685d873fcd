# SPDX-License-Identifier: Apache-2.0
# project_library(<target> SOURCES <file>... [PUBLIC <target>...] [PRIVATE <target>...])
#
# One library for the current folder. Its headers are included by their path from the top of the repository
# ("base/diagnostics/source.hpp"), but only a target that links the library can see them: the include directory
# is a view in the build tree that holds a link to this folder alone. An include against the dependency arrows of
# docs/architecture.md therefore fails to compile.
function(project_library target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;PUBLIC;PRIVATE")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "project_library(${target}): unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  add_library(${target} STATIC ${ARG_SOURCES})
  project_header_view(${target} PUBLIC)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE project_options ${ARG_PRIVATE})
endfunction()

# Lets `target` (and, if PUBLIC, its dependants) include the headers of the current folder.
function(project_header_view target scope)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(view ${PROJECT_BINARY_DIR}/header_view/${target})
  # In an older build tree the link may stand for a folder above this one.
  file(REMOVE_RECURSE ${view})
  get_filename_component(parent ${view}/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${view}/${folder} SYMBOLIC)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${view}>)
endfunction()
