# SPDX-License-Identifier: Apache-2.0
# ament_cmake_python: Python modules in a package built with CMake.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(PYTHON_INSTALL_DIR lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages)

# ament_python_install_package(<module> [PACKAGE_DIR <dir>] [DESTINATION <dir>])
#
# Installs the folder of a module, by default ./<module>.
function(ament_python_install_package module)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_COMPILE" "PACKAGE_DIR;DESTINATION;VERSION;SETUP_CFG;SCRIPTS_DESTINATION" "")
  if(NOT ARG_PACKAGE_DIR)
    set(ARG_PACKAGE_DIR ${module})
  endif()
  if(NOT ARG_DESTINATION)
    set(ARG_DESTINATION ${PYTHON_INSTALL_DIR})
  endif()
  install(DIRECTORY ${ARG_PACKAGE_DIR}/ DESTINATION ${ARG_DESTINATION}/${module}
    PATTERN __pycache__ EXCLUDE PATTERN "*.pyc" EXCLUDE)
endfunction()

# ament_python_install_module(<file.py> [DESTINATION_SUFFIX <dir>])
function(ament_python_install_module file)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_COMPILE" "DESTINATION_SUFFIX" "")
  install(FILES ${file} DESTINATION ${PYTHON_INSTALL_DIR}/${ARG_DESTINATION_SUFFIX})
endfunction()
