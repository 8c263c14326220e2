// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

// The pieces of the HTML report, as html/embed.cmake puts them into the library. ASCII text without "</script".

namespace geomend::page {

std::string_view style();
std::string_view body();
std::string_view script();
/// vtk.js and the view made of it; empty where it could not be fetched when this was built.
std::string_view vtk_view();

}  // namespace geomend::page
