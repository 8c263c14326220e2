# SPDX-License-Identifier: AGPL-3.0-or-later
# Makes the C++ source that holds the pieces of the page: cmake -DOUT=FILE -DHTML=FOLDER -DBUNDLE=FILE -P embed.cmake
# The pieces are plain text, so that raw string literals do.

set(code "// Made by embed.cmake.\n#include \"report/page_pieces.h\"\n\nnamespace geomend::page {\n")
function(add_piece name)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" piece)
    string(FIND "${piece}" "</script" closing)
    string(FIND "${piece}" ")geomend_piece\"" delimiter)
    if(NOT closing EQUAL -1 OR NOT delimiter EQUAL -1)
      message(FATAL_ERROR "${file} holds text that would end the script or the string that it stands in")
    endif()
    string(APPEND text "${piece}")
  endforeach()
  set(code "${code}\nstd::string_view ${name}() { return R\"geomend_piece(${text})geomend_piece\"; }\n" PARENT_SCOPE)
endfunction()

add_piece(style "${HTML}/page.css")
add_piece(body "${HTML}/page.html")
add_piece(script "${HTML}/decode.js" "${HTML}/marks.js" "${HTML}/plain_view.js" "${HTML}/model_view.js" "${HTML}/page.js")
add_piece(vtk_view "${BUNDLE}")
file(WRITE "${OUT}" "${code}\n}  // namespace geomend::page\n")
