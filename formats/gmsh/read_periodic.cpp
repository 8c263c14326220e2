// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/text_cursor.h"
#include "formats/gmsh/reading.h"

namespace geomend::gmsh {

namespace {

// MSH 4.1 counts the values of the transformation; the others write it, where it is there, on a line "Affine ...".
void take_affine(Scanner& s, bool counted, std::string& text) {
    std::vector<double> values;
    if (counted) {
        const std::uint64_t n = s.count("number of values of the transformation", 8, 1);
        for (std::uint64_t i = 0; i < n && !s.failed(); ++i) values.push_back(s.real("a value of the transformation"));
    } else if (s.encoding().binary) {
        const std::int64_t n = s.size("the number of values of the transformation");
        if (n > 0 && s.fits(n, "number of values of the transformation", 8, 1)) {
            for (std::int64_t i = 0; i < n && !s.failed(); ++i) values.push_back(s.real("a value of the transformation"));
        }
    } else if (!s.at_end() && *s.position() == 'A') {
        TextCursor words(s.line());
        words.next_line();
        words.token();
        double value = 0;
        while (!words.at_line_end()) {
            if (words.real(value) != NumberStatus::ok) {
                s.fail("F005", "a value of the transformation is not a number");
                return;
            }
            values.push_back(value);
        }
    }
    append_number(text, static_cast<std::uint64_t>(values.size()));
    for (const double v : values) {
        text += ' ';
        append_number(text, v);
    }
    text += '\n';
}

void take_node(Reading& r, Scanner& s, bool wide, std::string& text) {
    const std::int64_t tag = wide ? s.size("a node tag") : s.integer("a node tag");
    if (!s.failed() && r.nodes.find(tag) == no_index) s.fail("F007", "node " + std::to_string(tag) + " is not defined", s.last_number());
    append_number(text, tag);
}

}  // namespace

Result<void> read_periodic(Reading& r, const Section& section) {
    const bool v41 = r.layout.version == MshVersion::v41;
    const bool v4 = v41 || r.layout.version == MshVersion::v40;
    // MSH 2 writes this section as text in binary files, too.
    Scanner s(r.input, section.content, section.name, v4 ? r.layout.encoding : Encoding{});
    const std::int64_t links = v41 ? s.size("the number of periodic links") : s.integer("the number of periodic links");
    s.fits(links, "number of periodic links", 4 * 3 + 8, 4);
    for (std::int64_t i = 0; i < links && !s.failed(); ++i) {
        std::string text;
        for (int k = 0; k < 3; ++k) {
            append_number(text, s.integer("an entity's dimension or tag"));
            text += k < 2 ? ' ' : '\n';
        }
        take_affine(s, v41, text);
        const std::int64_t nodes = v4 ? s.size("the number of node pairs") : s.integer("the number of node pairs");
        if (!s.fits(nodes, "number of node pairs", 8, 2)) break;
        append_number(text, nodes);
        text += '\n';
        for (std::int64_t k = 0; k < nodes && !s.failed(); ++k) {
            take_node(r, s, v41, text);
            text += ' ';
            take_node(r, s, v41, text);
            text += '\n';
        }
        r.mesh.info.annotations.push_back({"gmsh.periodic", std::move(text)});
    }
    s.expect_end();
    if (s.failed()) return s.take_failure();
    return {};
}

}  // namespace geomend::gmsh
