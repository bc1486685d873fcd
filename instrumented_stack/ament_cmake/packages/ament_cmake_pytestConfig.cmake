# SPDX-License-Identifier: Apache-2.0
# ament_cmake_pytest: tests of pytest, run by ctest. Where pytest is not installed, they are left out.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# ament_has_pytest(<variable>): whether Python can import pytest.
function(ament_has_pytest variable)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "QUIET" "PYTHON_EXECUTABLE" "")
  if(NOT ARG_PYTHON_EXECUTABLE)
    set(ARG_PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
  endif()
  execute_process(COMMAND ${ARG_PYTHON_EXECUTABLE} -c "import pytest" RESULT_VARIABLE result ERROR_QUIET)
  set(found FALSE)
  if(result STREQUAL "0")
    set(found TRUE)
  endif()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

# ament_get_pytest_cov_version(<variable>): empty, because coverage of Python is not measured here.
function(ament_get_pytest_cov_version variable)
  set(${variable} "" PARENT_SCOPE)
endfunction()

# ament_add_pytest_test(<name> <file or folder> [SKIP_TEST] [PYTHON_EXECUTABLE <file>] [TIMEOUT <seconds>]
#                       [WORKING_DIRECTORY <dir>] [ENV <name=value>...] [APPEND_ENV <name=value>...]
#                       [APPEND_LIBRARY_DIRS <dir>...] [WERROR ON])
#
# With WERROR, warnings of Python fail the test.
function(ament_add_pytest_test name path)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "SKIP_TEST" "PYTHON_EXECUTABLE;RUNNER;TIMEOUT;WORKING_DIRECTORY;WERROR"
    "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  if(NOT ARG_PYTHON_EXECUTABLE)
    set(ARG_PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
  endif()
  ament_has_pytest(has_pytest PYTHON_EXECUTABLE ${ARG_PYTHON_EXECUTABLE})
  if(NOT has_pytest)
    _ament_left_out(pytest "tests of pytest are left out, because pytest is not installed (Debian: python3-pytest)")
    return()
  endif()
  get_filename_component(path "${path}" ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT EXISTS "${path}")
    message(FATAL_ERROR "ament_add_pytest_test(${name}): there is no '${path}'")
  endif()
  set(skip "")
  if(ARG_SKIP_TEST)
    set(skip SKIP_TEST)
  endif()
  set(warnings "")
  if(ARG_WERROR)
    set(warnings -W error)
  endif()
  set(results ${CMAKE_BINARY_DIR}/test_results/${PROJECT_NAME})
  file(MAKE_DIRECTORY ${results})
  # 5 is pytest's code for a file without tests.
  ament_add_test(${name} ${skip}
    COMMAND ${ARG_PYTHON_EXECUTABLE} -u -m pytest "${path}" ${warnings} -o cache_dir=${CMAKE_CURRENT_BINARY_DIR}/pytest_cache
      --junit-xml=${results}/${name}.xunit.xml --junit-prefix=${PROJECT_NAME}
    TIMEOUT ${ARG_TIMEOUT} WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY} SKIP_RETURN_CODE 5
    ENV ${ARG_ENV} APPEND_ENV ${ARG_APPEND_ENV} APPEND_LIBRARY_DIRS ${ARG_APPEND_LIBRARY_DIRS})
  ament_add_test_label(${name} pytest)
endfunction()
