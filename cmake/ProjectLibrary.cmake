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

# project_exports(<library> NAMESPACE <namespace> [TEMPLATES <pattern>...] [COMPILED_BY <target>...]): others see of this shared
# library the names of the C++ namespace alone, and templates for which the library has code, whose names begin with what they
# return. Everything else that it holds is its own: what another library of the process has under the same name can't take its
# place. COMPILED_BY: the targets that compile its interface, if not the library itself. They say the types to ./dev abi.
function(project_exports library)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "NAMESPACE" "TEMPLATES;COMPILED_BY")
  set(patterns ${ARG_TEMPLATES})
  foreach(kind IN ITEMS "" "typeinfo?for?" "typeinfo?name?for?" "vtable?for?")
    list(APPEND patterns "${kind}${ARG_NAMESPACE}::*")
  endforeach()
  list(JOIN patterns "; " patterns)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${library}.map)
  file(CONFIGURE OUTPUT ${script} CONTENT "{ global: extern \"C++\" { @patterns@; }; local: *; };\n" @ONLY)
  target_link_options(${library} PRIVATE -Wl,--version-script=${script} -Wl,-Bsymbolic-functions)
  set_property(TARGET ${library} APPEND PROPERTY LINK_DEPENDS ${script})
  foreach(target IN LISTS library ARG_COMPILED_BY)
    set_target_properties(${target} PROPERTIES VISIBILITY_INLINES_HIDDEN ON)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-g>)
  endforeach()
endfunction()
