# SPDX-License-Identifier: MIT
# Writes OUTPUT, a C++ source with the files of the page: cmake -DOUTPUT=... -DFOLDER=... -DSCRIPTS=a;b -P
# Raw strings hold them as they are. No compiler must take a string of more than 64 KiB, also if it is written in
# pieces, so that they are put together when the program runs.
function(add_text name)
  set(statements)
  foreach(file ${ARGN})
    file(READ ${FOLDER}/${file} text)
    string(LENGTH "${text}" length)
    set(at 0)
    while(at LESS length)
      string(SUBSTRING "${text}" ${at} 12000 piece)
      string(APPEND statements "  text += R\"page~(${piece})page~\";\n")
      math(EXPR at "${at} + 12000")
    endwhile()
  endforeach()
  set(source "${source}std::string ${name}() {\n  std::string text;\n${statements}  return text;\n}\n" PARENT_SCOPE)
endfunction()
set(source "// SPDX-License-Identifier: MIT\n#include \"renderer/inspect/page_files.h\"\n\nnamespace minkray::page_files {\n\n")
add_text(html page.html)
add_text(style style.css)
add_text(script ${SCRIPTS})
file(WRITE ${OUTPUT} "${source}\n}  // namespace minkray::page_files\n")
