// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace geomend {

/// What a page about a grid shows.
struct GridPage {
    std::string title;
    std::string summary;       ///< lines for people
    std::string map, section;  ///< PNG files
};

/// One page that needs no network and runs no script: the summary and both pictures. Text never becomes markup.
std::string grid_page(const GridPage& page);

/// Base64 (RFC 4648) of bytes.
std::string base64_of_bytes(std::string_view bytes);

}  // namespace geomend
