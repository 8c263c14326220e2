# SPDX-License-Identifier: AGPL-3.0-or-later
# A room of the house: one static library. geomend_room(base USES TBB::tbb SOURCES a.cpp b.cpp)
# The target is geomend_<name>; headers are included as "<name>/file.h" from src, or "formats/..." from the root.

add_library(geomend_settings INTERFACE)
target_compile_features(geomend_settings INTERFACE cxx_std_20)
target_compile_options(geomend_settings INTERFACE
  -ffp-contract=off  # the same digits with and without fused multiply-add
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wno-float-conversion
  -Wcast-qual -Wformat=2 -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference
  $<$<NOT:$<BOOL:${GEOMEND_UNITY}>>:-Wshadow>  # sources in one unit shadow each other's helpers
  $<$<BOOL:${GEOMEND_WERROR}>:-Werror>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference>
  # GCC 12 sees overlapping copies in plain string concatenation (its bug 105651), and wrong frees in plain vectors, when it
  # optimises.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-Wno-restrict;-Wno-free-nonheap-object>)
if(GEOMEND_SANITIZE)
  target_compile_options(geomend_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(geomend_settings INTERFACE -fsanitize=address,undefined)
endif()
if(GEOMEND_FUZZ)
  target_compile_options(geomend_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Compiles the sources of a target eight at a time, where GEOMEND_UNITY asks for it: a third of the time of a build from
# nothing. Files whose own helpers have the names of others' are listed after ALONE.
function(geomend_unity target)
  if(NOT GEOMEND_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(geomend_room name)
  cmake_parse_arguments(ROOM "" "" "USES;PRIVATE_USES;SOURCES;ALONE" ${ARGN})
  add_library(geomend_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(geomend_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>           # "geomend/pipeline/load.h", for users
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/geomend>)  # "pipeline/load.h", as headers include each other
  target_link_libraries(geomend_${name} PUBLIC ${ROOM_USES} PRIVATE ${ROOM_PRIVATE_USES} $<BUILD_INTERFACE:geomend_settings>)
  target_compile_features(geomend_${name} PUBLIC cxx_std_20)
  set_target_properties(geomend_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  geomend_unity(geomend_${name} ${ROOM_ALONE})
  add_library(geomend::${name} ALIAS geomend_${name})
  set_property(GLOBAL APPEND PROPERTY GEOMEND_ROOMS geomend_${name})
endfunction()
