# SPDX-License-Identifier: Apache-2.0
# Joins markup, style and scripts of the pages, and writes the result as a C++ source.
#   cmake -DOUTPUT=FILE -DSCRIPTS=LIST -P embed_page.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../../../cmake/EmbedText.cmake)
join_scripts(code ${SCRIPTS})
file(READ page.css style)
file(READ page.html page)
file(READ login.html login)
string(REPLACE "/*style*/" "${style}" page "${page}")
string(REPLACE "/*scripts*/" "'use strict';\n${code}" page "${page}")
string(REPLACE "/*style*/" "${style}" login "${login}")
string(REPLACE "<!--wrong-->" "<p class=\"wrong\" role=\"alert\">This is not the token.</p>" wrong "${login}")

set(source "// Generated from the files of programs/serve/page.\n#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n#include \"programs/serve/page/page.hpp\"\n\n")
foreach(name IN ITEMS kPage:page kLoginPage:login kWrongTokenPage:wrong)
  string(REPLACE ":" ";" name "${name}")
  list(POP_FRONT name constant)
  text_as_literals("${${name}}" literals)
  string(APPEND source "const std::string_view launch::serve::${constant} =\n${literals};\n")
endforeach()
file(WRITE ${OUTPUT} "${source}")
