# SPDX-License-Identifier: Apache-2.0
# Tests of launch files in CTest.
#
#   find_package(launch_test REQUIRED)
#   enable_testing()
#   add_launch_test(test/system.launch.xml TIMEOUT 120 ARGS rate:=20 LABELS system)
#
# add_launch_test(<file> [TARGET <name>] [TIMEOUT <seconds>] [ARGS <name:=value>...] [LABELS <label>...]
#                 [OPTIONS <option>...] [ENV <VARIABLE=value>...] [APPEND_ENV <VARIABLE=path>...]
#                 [APPEND_LIBRARY_DIRS <directory>...] [RESULT_FILE <file>] [WORKING_DIRECTORY <directory>]
#                 [PYTHON_EXECUTABLE <file>] [SKIP_TEST])
#
# Runs `launch test` on a launch file in XML or YAML, or `launch_test` on a file of launch_testing (.py). The file may have
# generator expressions, such as $<CONFIG>; it need not exist yet then, and its name must show its kind. Writes JUnit XML to
# RESULT_FILE; by default it is test_results/<project>/<name>.xunit.xml in the build tree, as in ROS 2. TIMEOUT is 60 by
# default. OPTIONS go to `launch test`, such as -j 4. APPEND_ENV appends to a list of paths, APPEND_LIBRARY_DIRS to
# LD_LIBRARY_PATH. With SKIP_TEST the test is disabled. PYTHON_EXECUTABLE, the Python of launch_test, has no effect: that is the
# one that the launcher has been built with.
get_filename_component(LAUNCH_TEST_PREFIX "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

function(add_launch_test file)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "SKIP_TEST" "TARGET;TIMEOUT;RESULT_FILE;WORKING_DIRECTORY;PYTHON_EXECUTABLE"
    "ARGS;LABELS;OPTIONS;ENV;APPEND_ENV;APPEND_LIBRARY_DIRS")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "add_launch_test(${file}): unexpected ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  get_filename_component(path "${file}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  string(GENEX_STRIP "${path}" plain_path)
  if(plain_path STREQUAL path AND NOT EXISTS "${path}")
    message(FATAL_ERROR "add_launch_test: there is no file '${path}'")
  endif()
  if(NOT ARG_TARGET)
    file(RELATIVE_PATH ARG_TARGET "${CMAKE_CURRENT_SOURCE_DIR}" "${path}")
    string(GENEX_STRIP "${ARG_TARGET}" ARG_TARGET)
    string(REPLACE "/" "_" ARG_TARGET "${ARG_TARGET}")
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 60)
  endif()
  if(NOT ARG_RESULT_FILE)
    set(ARG_RESULT_FILE "${CMAKE_BINARY_DIR}/test_results/${PROJECT_NAME}/${ARG_TARGET}.xunit.xml")
  endif()
  if(NOT ARG_WORKING_DIRECTORY)
    set(ARG_WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  get_filename_component(result_directory "${ARG_RESULT_FILE}" DIRECTORY)
  file(MAKE_DIRECTORY "${result_directory}")
  if(plain_path MATCHES "\\.py$")
    set(command "${LAUNCH_TEST_PREFIX}/bin/launch_test" "${path}" ${ARG_ARGS} --junit-xml "${ARG_RESULT_FILE}")
  else()
    set(command "${LAUNCH_TEST_PREFIX}/bin/launch" test "${path}" ${ARG_ARGS} ${ARG_OPTIONS} --junit "${ARG_RESULT_FILE}")
  endif()
  add_test(NAME "${ARG_TARGET}" COMMAND ${command} WORKING_DIRECTORY "${ARG_WORKING_DIRECTORY}")
  set_tests_properties("${ARG_TARGET}" PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "launch_test;${ARG_LABELS}")
  # Packages write VARIABLE="${value}", where CMake keeps the quotes.
  foreach(list IN ITEMS ARG_ENV ARG_APPEND_ENV)
    list(TRANSFORM ${list} REPLACE "^([^=]+)=\"(.*)\"$" "\\1=\\2")
  endforeach()
  if(ARG_ENV)
    set_tests_properties("${ARG_TARGET}" PROPERTIES ENVIRONMENT "${ARG_ENV}")
  endif()
  foreach(directory IN LISTS ARG_APPEND_LIBRARY_DIRS)
    list(APPEND ARG_APPEND_ENV "LD_LIBRARY_PATH=${directory}")
  endforeach()
  if(ARG_APPEND_ENV)
    list(TRANSFORM ARG_APPEND_ENV REPLACE "^([^=]+)=" "\\1=path_list_append:")
    set_tests_properties("${ARG_TARGET}" PROPERTIES ENVIRONMENT_MODIFICATION "${ARG_APPEND_ENV}")
  endif()
  if(ARG_SKIP_TEST)
    set_tests_properties("${ARG_TARGET}" PROPERTIES DISABLED TRUE)
  endif()
endfunction()
