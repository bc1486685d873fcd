# SPDX-License-Identifier: Apache-2.0
# Python modules in a package built with CMake.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# ament_get_python_install_dir(<variable>): the folder for modules, relative to the prefix.
macro(ament_get_python_install_dir variable)
  if(NOT PYTHON_INSTALL_DIR)
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    set(PYTHON_INSTALL_DIR lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages)
  endif()
  set(${variable} ${PYTHON_INSTALL_DIR})
endmacro()

# ament_python_install_package(<module> [PACKAGE_DIR <dir>] [DESTINATION <dir>] [SETUP_CFG <file>]
#                              [SCRIPTS_DESTINATION <dir>] [VERSION <version>] [SKIP_COMPILE])
#
# Installs the folder of a module, by default ./<module>. With SCRIPTS_DESTINATION, each `name = module:function` below
# [options.entry_points] console_scripts in SETUP_CFG (by default setup.cfg) becomes a program there. In the build tree the
# programs are in ament_cmake_python/<module>/scripts, where packages install them from a second time.
function(ament_python_install_package module)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_COMPILE" "PACKAGE_DIR;DESTINATION;VERSION;SETUP_CFG;SCRIPTS_DESTINATION" "")
  if(NOT ARG_PACKAGE_DIR)
    set(ARG_PACKAGE_DIR ${module})
  endif()
  get_filename_component(ARG_PACKAGE_DIR ${ARG_PACKAGE_DIR} ABSOLUTE)
  if(NOT EXISTS ${ARG_PACKAGE_DIR}/__init__.py)
    message(FATAL_ERROR "ament_python_install_package(${module}): there is no '${ARG_PACKAGE_DIR}/__init__.py'")
  endif()
  if(NOT ARG_DESTINATION)
    ament_get_python_install_dir(ARG_DESTINATION)
  endif()
  install(DIRECTORY ${ARG_PACKAGE_DIR}/ DESTINATION ${ARG_DESTINATION}/${module}
    PATTERN __pycache__ EXCLUDE PATTERN "*.pyc" EXCLUDE)
  if(NOT ARG_SETUP_CFG)
    set(ARG_SETUP_CFG ${CMAKE_CURRENT_SOURCE_DIR}/setup.cfg)
  endif()
  if(ARG_SCRIPTS_DESTINATION AND EXISTS ${ARG_SETUP_CFG})
    file(STRINGS ${ARG_SETUP_CFG} entries REGEX "^[ \t]+[^ =]+[ \t]*=[ \t]*[A-Za-z0-9_.]+:[A-Za-z0-9_]+")
    foreach(entry IN LISTS entries)
      string(REGEX MATCH "([^ \t=]+)[ \t]*=[ \t]*([A-Za-z0-9_.]+):([A-Za-z0-9_]+)" entry "${entry}")
      set(script ${CMAKE_CURRENT_BINARY_DIR}/ament_cmake_python/${module}/scripts/${CMAKE_MATCH_1})
      file(WRITE ${script} "#!/usr/bin/env python3\nimport sys\nfrom ${CMAKE_MATCH_2} import ${CMAKE_MATCH_3}\n"
        "sys.exit(${CMAKE_MATCH_3}())\n")
      file(CHMOD ${script} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
      install(PROGRAMS ${script} DESTINATION ${ARG_SCRIPTS_DESTINATION})
    endforeach()
  endif()
endfunction()

# ament_python_install_module(<file.py> [DESTINATION_SUFFIX <dir>])
function(ament_python_install_module file)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_COMPILE" "DESTINATION_SUFFIX" "")
  ament_get_python_install_dir(directory)
  install(FILES ${file} DESTINATION ${directory}/${ARG_DESTINATION_SUFFIX})
endfunction()
