# SPDX-License-Identifier: Apache-2.0
# Joins markup, style and scripts of the page, and writes the result as a C++ source.
#   cmake -DOUTPUT=FILE -DUPLOT=DIRECTORY -DSCRIPTS=LIST -P embed_page.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../../../cmake/EmbedText.cmake)
join_scripts(code ${SCRIPTS})  # every page has them
foreach(part IN ITEMS LICENSE uPlot.min.css uPlot.iife.min.js)
  file(READ ${UPLOT}/${part} uplot_${part})
endforeach()
file(READ page.css style)
file(READ page.html page)
string(REPLACE "/*style*/" "/*\n${uplot_LICENSE}*/\n${uplot_uPlot.min.css}\n${style}" page "${page}")
string(REPLACE "/*uplot*/" "/*\n${uplot_LICENSE}*/\n${uplot_uPlot.iife.min.js}" page "${page}")
string(REPLACE "/*scripts*/" "'use strict';\n${code}" page "${page}")

text_as_literals("${page}" literals)
file(WRITE ${OUTPUT}
  "// Generated from the files of tracing/show/page.\n#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n#include \"tracing/show/page/page.hpp\"\n\n"
  "const std::string_view tracing::kPageTemplate =\n${literals};\n")
