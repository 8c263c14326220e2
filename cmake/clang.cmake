# SPDX-License-Identifier: AGPL-3.0-or-later
# Toolchain of the preset fuzz: the newest clang that is here. Before version 16 clang does not understand all of
# the ranges in g++ 12's standard library.
find_program(GEOMEND_CLANG NAMES clang-19 clang-16 clang clang-15 clang-14 REQUIRED)
find_program(GEOMEND_CLANGXX NAMES clang++-19 clang++-16 clang++ clang++-15 clang++-14 REQUIRED)
set(CMAKE_C_COMPILER ${GEOMEND_CLANG})
set(CMAKE_CXX_COMPILER ${GEOMEND_CLANGXX})
