# SPDX-License-Identifier: AGPL-3.0-or-later
# Fetches vtk.js by npm and bundles the view: cmake -DHTML=FOLDER -DWORK=FOLDER -DOUT=FILE [-DNPM=... -DNODE=...] -P bundle.cmake
# Without npm, without network or where anything goes wrong OUT is empty, one line says so, and the page has its plain view.

file(MAKE_DIRECTORY "${WORK}")
set(why "")
if(NOT NPM OR NOT NODE)
  set(why "npm or node is not there")
else()
  file(COPY "${HTML}/package.json" "${HTML}/package-lock.json" DESTINATION "${WORK}")
  execute_process(
    COMMAND "${NPM}" ci --prefer-offline --ignore-scripts --no-audit --no-fund --loglevel=error
            --fetch-retries=1 --fetch-retry-mintimeout=500 --fetch-retry-maxtimeout=3000 --fetch-timeout=20000
    WORKING_DIRECTORY "${WORK}" TIMEOUT 120 RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    string(REGEX MATCH "npm (error|ERR!)[^\n]*" first "${text}")
    set(why "npm ci failed (${status}): ${first}")
  endif()
endif()
if(why STREQUAL "")
  file(COPY "${HTML}/bundle.mjs" DESTINATION "${WORK}")
  execute_process(COMMAND "${NODE}" bundle.mjs "${HTML}/vtk_view.js" "${OUT}"
    WORKING_DIRECTORY "${WORK}" TIMEOUT 120 RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    string(SUBSTRING "${text}" 0 300 first)
    set(why "esbuild failed (${status}): ${first}")
  endif()
endif()
if(NOT why STREQUAL "")
  message("HTML report without vtk.js, with its plain view: ${why}. Remove ${OUT} to try again.")
  file(WRITE "${OUT}" "")
endif()
