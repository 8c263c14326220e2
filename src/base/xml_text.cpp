// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/xml_text.h"

namespace geomend {

namespace {

std::string escaped(std::string_view text, bool attribute) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        const bool space = c == '\n' || c == '\t' || c == '\r';
        if (c == '&') out += "&amp;";
        else if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '"') out += "&quot;";
        else if (space && (attribute || c == '\r')) out += "&#" + std::to_string(static_cast<int>(c)) + ';';
        else out += static_cast<unsigned char>(c) < 0x20 && !space ? ' ' : c;
    }
    return out;
}

}  // namespace

std::string xml_text(std::string_view text) { return escaped(text, false); }
std::string xml_attribute(std::string_view text) { return escaped(text, true); }

}  // namespace geomend
