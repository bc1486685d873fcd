# SPDX-License-Identifier: Apache-2.0
# Tests that ctest runs: what all kinds of them have in common.
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# Gives a test its time, folder and environment, from the options TIMEOUT, WORKING_DIRECTORY, ENV, APPEND_ENV and
# APPEND_LIBRARY_DIRS among the arguments; other arguments have no effect.
function(_ament_test_properties name label)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "TIMEOUT;WORKING_DIRECTORY;SKIP_RETURN_CODE"
    "ENV;APPEND_ENV;APPEND_LIBRARY_DIRS;_")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 60)
  endif()
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS ${label})
  if(NOT "${ARG_SKIP_RETURN_CODE}" STREQUAL "")
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE ${ARG_SKIP_RETURN_CODE})
  endif()
  # Packages write NAME="${value}", where CMake keeps the quotes.
  list(TRANSFORM ARG_ENV REPLACE "^([^=]+)=\"(.*)\"$" "\\1=\\2")
  list(TRANSFORM ARG_APPEND_ENV REPLACE "^([^=]+)=\"(.*)\"$" "\\1=\\2")
  foreach(variable IN LISTS ARG_ENV)
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT ${variable})
  endforeach()
  foreach(variable IN LISTS ARG_APPEND_ENV)
    string(REPLACE "=" "=path_list_append:" variable "${variable}")
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION ${variable})
  endforeach()
  foreach(dir IN LISTS ARG_APPEND_LIBRARY_DIRS)
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION LD_LIBRARY_PATH=path_list_append:${dir})
  endforeach()
endfunction()

# ament_add_test(<name> COMMAND <command>... [TIMEOUT <seconds>] [WORKING_DIRECTORY <dir>] [SKIP_TEST]
#                [SKIP_RETURN_CODE <code>] [ENV <name=value>...] [APPEND_ENV <name=value>...]
#                [APPEND_LIBRARY_DIRS <dir>...])
#
# A test that runs a command. Its exit code is the result; OUTPUT_FILE, RESULT_FILE and RUNNER have no effect, except that
# the tests of ament_cmake_ros have a ROS domain of their own.
function(ament_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_TEST;GENERATE_RESULT_FOR_RETURN_CODE_ZERO"
    "TIMEOUT;WORKING_DIRECTORY;OUTPUT_FILE;RESULT_FILE;RUNNER;PYTHON_EXECUTABLE;SKIP_RETURN_CODE"
    "COMMAND;ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  if(NOT ARG_WORKING_DIRECTORY)
    set(ARG_WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  add_test(NAME ${name} COMMAND ${_ament_test_runner} ${ARG_COMMAND} WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY})
  _ament_test_properties(${name} ament_test TIMEOUT ${ARG_TIMEOUT} SKIP_RETURN_CODE ${ARG_SKIP_RETURN_CODE}
    ENV ${ARG_ENV} APPEND_ENV ${ARG_APPEND_ENV} APPEND_LIBRARY_DIRS ${ARG_APPEND_LIBRARY_DIRS})
  if(ARG_SKIP_TEST)
    set_tests_properties(${name} PROPERTIES DISABLED TRUE)
  endif()
endfunction()

# ament_add_test_label(<test> <label>...)
function(ament_add_test_label name)
  set_property(TEST ${name} APPEND PROPERTY LABELS ${ARGN})
endfunction()

# Says once in a CMake run why a kind of tests is left out.
function(_ament_left_out kind why)
  get_property(said GLOBAL PROPERTY AMENT_LEFT_OUT_${kind})
  if(NOT said)
    set_property(GLOBAL PROPERTY AMENT_LEFT_OUT_${kind} TRUE)
    message(STATUS "${PROJECT_NAME}: ${why}")
  endif()
endfunction()
