// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/grid_page.h"

#include <cstdint>

#include "base/xml_text.h"

namespace geomend {

namespace {

std::string picture(const std::string& heading, const std::string& png) {
    return "<h2>" + heading + "</h2>\n<p><img alt=\"" + heading + "\" src=\"data:image/png;base64," + base64_of_bytes(png) + "\"></p>\n";
}

}  // namespace

std::string base64_of_bytes(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t b = 0; b < 3; ++b) three = three << 8 | (i + b < bytes.size() ? static_cast<unsigned char>(bytes[i + b]) : 0u);
        for (std::size_t l = 0; l < 4; ++l) text += i + l <= bytes.size() ? letters[three >> (18 - 6 * l) & 63] : '=';
    }
    return text;
}

std::string grid_page(const GridPage& page) {
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
           "'unsafe-inline'\">\n<title>" +
           xml_text(page.title) +
           "</title>\n<style>body{font:15px/1.45 sans-serif;margin:2em auto;max-width:1500px;padding:0 1em;color:#222}"
           "pre{white-space:pre-wrap;background:#f4f4f4;padding:1em}img{max-width:100%;border:1px solid "
           "#ccc}</style></head>\n<body>\n<h1>" +
           xml_text(page.title) + "</h1>\n<pre>" + xml_text(page.summary) + "</pre>\n" + picture("Map of the grid", page.map) +
           picture("Section of the grid", page.section) + "</body></html>\n";
}

}  // namespace geomend
