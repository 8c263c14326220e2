// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/xml_text.h"

#include <gtest/gtest.h>

namespace geomend {
namespace {

TEST(XmlText, EscapesMarkupAndHasNoOtherControlCharacters) {
    EXPECT_EQ(xml_text("a<b>&\"c\"'d'"), "a&lt;b&gt;&amp;&quot;c&quot;'d'");
    EXPECT_EQ(xml_text(std::string_view("x\0y\x1bz", 5)), "x y z");
    EXPECT_EQ(xml_text("\xc3\xa9"), "\xc3\xa9");
}

TEST(XmlText, KeepsLineEndsAndTabsThroughAParser) {
    // A parser turns line ends and tabs of an attribute into blanks, and a bare carriage return into a line end.
    EXPECT_EQ(xml_text("a\n\tb\r"), "a\n\tb&#13;");
    EXPECT_EQ(xml_attribute("a\n\tb\r"), "a&#10;&#9;b&#13;");
}

}  // namespace
}  // namespace geomend
