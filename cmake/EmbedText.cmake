# SPDX-License-Identifier: Apache-2.0
# Texts in C++ sources, for the scripts that make pages.

# Sets `result` to an expression with the text. A string literal may be limited to 64 KiB, so it is written in pieces.
function(text_as_literals text result)
  set(literals "")
  string(LENGTH "${text}" length)
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} 16000 piece)
    string(APPEND literals "R\"=-=(${piece})=-=\"\n")
    math(EXPR begin "${begin} + 16000")
  endwhile()
  set(${result} "${literals}" PARENT_SCOPE)
endfunction()

# Joins scripts in this order: without the comments that are lines of their own, and without indentation.
function(join_scripts result)
  set(code "")
  foreach(script IN LISTS ARGN)
    file(READ ${script} text)
    string(REGEX REPLACE "\n *//[^\n]*" "" text "\n${text}")
    string(REGEX REPLACE "\n +" "\n" text "${text}")
    string(APPEND code "// ${script}\n${text}\n")
  endforeach()
  set(${result} "${code}" PARENT_SCOPE)
endfunction()
