# SPDX-License-Identifier: Apache-2.0
# Modules of Python in packages of the stack. They are where setup.bash of the prefix has Python look for them.
include_guard(GLOBAL)
set(STACK_PYTHON_DIRECTORY lib/python${python_version}/site-packages CACHE INTERNAL "of modules, below the prefix")

# stack_python_package(<pkg>)
#
# The folder <pkg> of the current folder: a package of Python with the name of the ROS package.
function(stack_python_package pkg)
  file(GLOB modules RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${pkg}/*.py)
  foreach(module IN LISTS modules)
    configure_file(${module} ${PROJECT_BINARY_DIR}/prefix/${STACK_PYTHON_DIRECTORY}/${module} COPYONLY)
    install(FILES ${module} DESTINATION ${STACK_PYTHON_DIRECTORY}/${pkg})
  endforeach()
endfunction()

# stack_python_extension(<pkg> <module> SOURCES <file>... LINK <target>...)
#
# The extension module <pkg>.<module>, for the Python that WITH_PYTHON has found. The CMake target is <pkg>_<module>.
function(stack_python_extension pkg module)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "SOURCES;LINK")
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sysconfig; print(sysconfig.get_config_var('EXT_SUFFIX'))"
    OUTPUT_VARIABLE suffix OUTPUT_STRIP_TRAILING_WHITESPACE)
  pkg_check_modules(PYTHON_EXTENSION REQUIRED python-${python_version})
  set(target ${pkg}_${module})
  add_library(${target} MODULE ${ARG_SOURCES})
  _stack_place(${target} ${STACK_PYTHON_DIRECTORY}/${pkg} "$ORIGIN/../../..")
  target_include_directories(${target} SYSTEM PRIVATE ${PYTHON_EXTENSION_INCLUDE_DIRS})
  target_link_libraries(${target} PRIVATE project_options ${ARG_LINK})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${module} SUFFIX ${suffix} CXX_VISIBILITY_PRESET hidden)
  install(TARGETS ${target} LIBRARY DESTINATION ${STACK_PYTHON_DIRECTORY}/${pkg})
endfunction()
