// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace geomend {

/// Text as it stands between the tags of an XML file: markup and quotes are escaped; control characters, which XML 1.0
/// has not even escaped, become blanks, but for tabs and line ends. Linear.
std::string xml_text(std::string_view text);
/// The same between the quotes of an attribute, where tabs and line ends have to be escaped, too.
std::string xml_attribute(std::string_view text);

}  // namespace geomend
