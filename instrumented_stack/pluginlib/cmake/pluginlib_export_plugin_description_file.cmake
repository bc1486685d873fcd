# SPDX-License-Identifier: Apache-2.0
# pluginlib_export_plugin_description_file(<package of the base class> <file relative to the current source folder>)
#
# Installs the description under share/<this package>/ and adds it to the ament index. Loaders of the base class's
# package find it there.
function(pluginlib_export_plugin_description_file category file)
  if(IS_ABSOLUTE ${file})
    message(FATAL_ERROR "pluginlib_export_plugin_description_file: '${file}' must be relative to the source folder")
  endif()
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    message(FATAL_ERROR "pluginlib_export_plugin_description_file: there is no file '${file}'")
  endif()
  set(index share/ament_index/resource_index/${category}__pluginlib__plugin)
  set(entry ${PROJECT_BINARY_DIR}/prefix/${index}/${PROJECT_NAME})
  get_filename_component(folder ${file} DIRECTORY)
  configure_file(${file} ${PROJECT_BINARY_DIR}/prefix/share/${PROJECT_NAME}/${file} COPYONLY)
  install(FILES ${file} DESTINATION share/${PROJECT_NAME}/${folder})
  # Further files of the package become further lines of the same entry.
  set_property(GLOBAL APPEND PROPERTY PLUGINLIB_${category}__${PROJECT_NAME} "share/${PROJECT_NAME}/${file}\n")
  get_property(lines GLOBAL PROPERTY PLUGINLIB_${category}__${PROJECT_NAME})
  list(JOIN lines "" content)
  file(WRITE ${entry} "${content}")
  install(FILES ${entry} DESTINATION ${index})
endfunction()
