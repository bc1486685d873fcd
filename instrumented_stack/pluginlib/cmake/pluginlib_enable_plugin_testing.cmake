# SPDX-License-Identifier: Apache-2.0
# pluginlib_enable_plugin_testing(CMAKE_TARGET_VAR <variable> AMENT_PREFIX_PATH_VAR <variable> PLUGIN_CATEGORY <category>
#   PLUGIN_DESCRIPTIONS <file>... PLUGIN_LIBRARIES <target>... [PACKAGE_NAME <name>] [PACKAGE_XML <file>])
#
# Makes a prefix in the build tree in which loaders find the plugins of a package before it is installed. The prefix has a
# package, by default this one, its descriptions for the category, and links to the libraries. The first variable is set to a
# target that tests depend on, the second to the prefix: ament_add_gtest(… APPEND_ENV AMENT_PREFIX_PATH=${prefix}).
function(pluginlib_enable_plugin_testing)
  cmake_parse_arguments(PARSE_ARGV 0 ARG ""
    "CMAKE_TARGET_VAR;AMENT_PREFIX_PATH_VAR;PLUGIN_CATEGORY;PACKAGE_NAME;PACKAGE_XML"
    "PLUGIN_DESCRIPTIONS;PLUGIN_LIBRARIES")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "pluginlib_enable_plugin_testing: unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  foreach(needed IN ITEMS CMAKE_TARGET_VAR AMENT_PREFIX_PATH_VAR PLUGIN_CATEGORY PLUGIN_DESCRIPTIONS PLUGIN_LIBRARIES)
    if(NOT ARG_${needed})
      message(FATAL_ERROR "pluginlib_enable_plugin_testing: ${needed} is missing")
    endif()
  endforeach()
  if(NOT ARG_PACKAGE_NAME)
    set(ARG_PACKAGE_NAME ${PROJECT_NAME})
  endif()
  if(NOT ARG_PACKAGE_XML)
    set(ARG_PACKAGE_XML ${PROJECT_SOURCE_DIR}/package.xml)
  endif()
  set(target pluginlib_testing__${ARG_PLUGIN_CATEGORY}__${ARG_PACKAGE_NAME})
  if(TARGET ${target})
    message(FATAL_ERROR
      "pluginlib_enable_plugin_testing: '${ARG_PACKAGE_NAME}' already has plugins for '${ARG_PLUGIN_CATEGORY}'")
  endif()

  set(prefix ${CMAKE_CURRENT_BINARY_DIR}/pluginlib_testing/${ARG_PACKAGE_NAME}__${ARG_PLUGIN_CATEGORY})
  set(share share/${ARG_PACKAGE_NAME})
  set(index ${prefix}/share/ament_index/resource_index)
  configure_file(${ARG_PACKAGE_XML} ${prefix}/${share}/package.xml COPYONLY)
  file(WRITE ${index}/packages/${ARG_PACKAGE_NAME} "")
  set(lines "")
  foreach(file IN LISTS ARG_PLUGIN_DESCRIPTIONS)
    configure_file(${file} ${prefix}/${share}/${file} COPYONLY)
    string(APPEND lines "${share}/${file}\n")
  endforeach()
  file(WRITE ${index}/${ARG_PLUGIN_CATEGORY}__pluginlib__plugin/${ARG_PACKAGE_NAME} "${lines}")

  set(link "")
  foreach(library IN LISTS ARG_PLUGIN_LIBRARIES)
    list(APPEND link COMMAND ${CMAKE_COMMAND} -E create_symlink $<TARGET_FILE:${library}>
      ${prefix}/lib/$<TARGET_FILE_NAME:${library}>)
  endforeach()
  file(MAKE_DIRECTORY ${prefix}/lib)
  add_custom_target(${target} ALL ${link} VERBATIM)
  add_dependencies(${target} ${ARG_PLUGIN_LIBRARIES})
  set(${ARG_CMAKE_TARGET_VAR} ${target} PARENT_SCOPE)
  set(${ARG_AMENT_PREFIX_PATH_VAR} ${prefix} PARENT_SCOPE)
endfunction()
