# SPDX-License-Identifier: Apache-2.0
# Joins markup, style and scripts of the page, and writes the result as a C++ source.
#   cmake -DOUTPUT=FILE -DUPLOT=DIRECTORY -DSCRIPTS=LIST -P embed_page.cmake
set(code "")
foreach(script IN LISTS SCRIPTS)
  file(READ ${script} text)
  # Every page has the scripts: without the comments that are lines of their own, and without indentation.
  string(REGEX REPLACE "\n *//[^\n]*" "" text "\n${text}")
  string(REGEX REPLACE "\n +" "\n" text "${text}")
  string(APPEND code "// ${script}\n${text}\n")
endforeach()
foreach(part IN ITEMS LICENSE uPlot.min.css uPlot.iife.min.js)
  file(READ ${UPLOT}/${part} uplot_${part})
endforeach()
file(READ page.css style)
file(READ page.html page)
string(REPLACE "/*style*/" "/*\n${uplot_LICENSE}*/\n${uplot_uPlot.min.css}\n${style}" page "${page}")
string(REPLACE "/*uplot*/" "/*\n${uplot_LICENSE}*/\n${uplot_uPlot.iife.min.js}" page "${page}")
string(REPLACE "/*scripts*/" "'use strict';\n${code}" page "${page}")

# A string literal may be limited to 64 KiB, so it is written in pieces.
set(literals "")
string(LENGTH "${page}" length)
set(begin 0)
while(begin LESS length)
  string(SUBSTRING "${page}" ${begin} 16000 piece)
  string(APPEND literals "R\"=-=(${piece})=-=\"\n")
  math(EXPR begin "${begin} + 16000")
endwhile()
file(WRITE ${OUTPUT}
  "// Generated from the files of tracing/show/page.\n#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n#include \"tracing/show/page/page.hpp\"\n\n"
  "const std::string_view tracing::kPageTemplate =\n${literals};\n")
