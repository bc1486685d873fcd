# SPDX-License-Identifier: Apache-2.0
# Compile options of every target of this project, as one interface target.
set(SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread")

# On in the presets: the sources give no warnings with their compilers and options. Other compilers and other levels of
# optimisation warn of other things, which must not stop the build of a release.
option(WARNINGS_AS_ERRORS "Stop at warnings" OFF)
option(SMALL_PROGRAMS "Compile for size what waits for processes, files and people, and what shows them results" OFF)

# For the folder that calls it, and those below. Whatever reads and analyses traces or runs in nodes stays compiled for speed.
macro(compile_for_size)
  if(SMALL_PROGRAMS)
    add_compile_options(-Os)
  endif()
endmacro()

add_library(project_options INTERFACE)
target_compile_options(project_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${WARNINGS_AS_ERRORS}>:-Werror>
  # A designated initialiser names the members that it sets; the others have their defaults.
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual -Wno-missing-field-initializers>)

if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC collects its garbage when it uses more than this memory (KiB). With its default of 128 MiB, joined sources spend up to a
  # seventh of their time on that. The largest one takes 1.4 GiB with 512 MiB, and 1.2 GiB with the default.
  add_compile_options("SHELL:--param ggc-min-heapsize=524288")
  # ccache asks for it where sources use precompiled headers, as the tests do.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
  # GCC 11 takes a call of std::array::size() for a use of the elements.
  add_compile_options(-Wno-maybe-uninitialized)
endif()

if(SANITIZE)
  # Sanitized code must be whole: third-party calls into it otherwise give false reports.
  # GCC's analysis of uninitialised variables and of bounds is wrong in sanitized code of the standard library. GCC 12 warns
  # of each `std::string(…) + "…"`.
  set(false_warnings -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow)
  add_compile_options(-fsanitize=${SANITIZE} -fno-omit-frame-pointer
    "$<$<OR:$<C_COMPILER_ID:GNU>,$<CXX_COMPILER_ID:GNU>>:${false_warnings}>")
  add_link_options(-fsanitize=${SANITIZE})
  if(SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # These look at every pointer, which doubles the time to compile. AddressSanitizer sees most of it.
    set(POINTER_CHECKS null,vptr,alignment,object-size)
    add_compile_options(-fno-sanitize=${POINTER_CHECKS})
  endif()
  if(SANITIZE STREQUAL "thread")
    add_library(thread_sanitizer_clock_waits OBJECT ${PROJECT_SOURCE_DIR}/tests/support/sanitizers/clock_waits.c)
    target_compile_options(thread_sanitizer_clock_waits PRIVATE -fno-sanitize=all)
    link_libraries($<TARGET_OBJECTS:thread_sanitizer_clock_waits>)
  endif()
endif()
