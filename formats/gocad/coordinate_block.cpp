// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/coordinate_block.h"

#include "formats/gocad/property_lists.h"

namespace geomend::gocad {

namespace {

/// Three words behind a keyword. Fewer, more or a second such line are reported.
void take_three(std::string_view keyword, std::array<std::string, 3>& names, TextCursor& line, ObjectLog& log) {
    const std::string word(keyword);
    if (!names[0].empty()) {
        log.add(
            "F166", line.line(), 1, [&] { return "a second " + word + " in this coordinate system: it takes the place of the first"; },
            word + " again");
        names = {};
    }
    std::size_t given = 0;
    for (std::string& name : names) {
        bool quoted = false;
        name = line.quoted_token(&quoted);
        given += quoted || !name.empty() ? 1 : 0;
    }
    if (!line.at_line_end()) given = 4;
    if (given != names.size())
        log.add(
            "F166", line.line(), 1,
            [&] { return "expected three words after " + word + ", found " + (given > 3 ? "more" : std::to_string(given)); }, word);
}

std::string unquoted(std::string_view text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
    return std::string(text);
}

bool take_z_positive(std::string_view word, CoordinateSystem& crs) {
    if (same_word(word, "Depth")) crs.z_positive = ZPositive::depth;
    else if (same_word(word, "Elevation") || same_word(word, "Upward")) crs.z_positive = ZPositive::elevation;
    else return false;
    crs.z_positive_stated = true;
    return true;
}

}  // namespace

void read_coordinate_block(TextCursor& line, CoordinateSystem& crs, ObjectLog& log) {
    crs = {};
    crs.stated = true;
    for (;;) {
        const char* here = line.next_line_begin();
        const std::uint64_t number = line.line() + 1;
        if (!line.next_line()) {
            log.add("F118", line.line(), 0, "the coordinate system block has no END_ORIGINAL_COORDINATE_SYSTEM");
            return;
        }
        const std::string_view keyword = line.token();
        const auto is = [&](std::string_view word) { return same_word(keyword, word); };
        if (keyword.empty() || keyword.front() == '#') continue;
        if (is("END_ORIGINAL_COORDINATE_SYSTEM")) return;
        if (is("NAME")) crs.name = unquoted(line.rest());
        else if (is("PROJECTION")) crs.projection = unquoted(line.rest());
        else if (is("DATUM")) crs.datum = unquoted(line.rest());
        else if (is("AXIS_NAME")) take_three(keyword, crs.axis_names, line, log);
        else if (is("AXIS_UNIT")) take_three(keyword, crs.axis_units, line, log);
        else if (is("ZPOSITIVE")) {
            const std::uint32_t column = line.column();
            const std::string_view word = line.quoted_token();
            if (!take_z_positive(word, crs)) {
                log.add("F012", line.line(), column,
                        [&] { return "ZPOSITIVE: expected Elevation or Depth, found '" + std::string(word) + "'"; });
            }
        } else if (ends_coordinate_block(keyword)) {
            log.add("F118", line.line(), 1, "the coordinate system block has no END_ORIGINAL_COORDINATE_SYSTEM");
            line.jump(here, number);
            return;
        } else {
            crs.annotations.emplace_back(std::string(keyword), std::string(line.rest()));
        }
    }
}

// Some files lack the terminator: what cannot stand inside the block ends it.
bool ends_coordinate_block(std::string_view keyword) {
    for (const std::string_view word : {"VRTX",
                                        "PVRTX",
                                        "TFACE",
                                        "ILINE",
                                        "SUBVSET",
                                        "TVOLUME",
                                        "PROPERTIES",
                                        "PROPERTY",
                                        "PROPERTY_CLASS_HEADER",
                                        "PROPERTY_CLASSES",
                                        "HEADER",
                                        "GEOLOGICAL_FEATURE",
                                        "GEOLOGICAL_TYPE",
                                        "STRATIGRAPHIC_POSITION",
                                        "TSURF",
                                        "REGION",
                                        "AXIS_O",
                                        "AXIS_U",
                                        "AXIS_V",
                                        "AXIS_W",
                                        "AXIS_N",
                                        "AXIS_MIN",
                                        "AXIS_MAX",
                                        "WREF",
                                        "BEGIN_MEMBERS",
                                        "TYPE",
                                        "ORIGIN",
                                        "PROP_ALIGNMENT",
                                        "POINTS_FILE"}) {
        if (same_word(keyword, word)) return true;
    }
    return false;
}

void write_coordinate_block(OutputFile& out, const CoordinateSystem& crs) {
    const auto three = [&](std::string_view keyword, const std::array<std::string, 3>& names, std::string_view x, std::string_view y,
                           std::string_view z) {
        const std::array<std::string_view, 3> usual{x, y, z};
        out << keyword;
        for (std::size_t i = 0; i != 3; ++i) out << ' ' << name_token(names[i].empty() ? usual[i] : std::string_view(names[i]));
        out << '\n';
    };
    const auto text = [&](std::string_view keyword, const std::string& value) {
        if (!value.empty()) out << keyword << ' ' << name_token(value) << '\n';
    };
    out << "GOCAD_ORIGINAL_COORDINATE_SYSTEM\n";
    out << "NAME " << name_token(crs.name.empty() ? std::string_view("Default") : std::string_view(crs.name)) << '\n';
    text("PROJECTION", crs.projection);
    text("DATUM", crs.datum);
    three("AXIS_NAME", crs.axis_names, "X", "Y", "Z");
    // Units that nobody stated are not invented.
    if (!crs.axis_units[0].empty() || !crs.axis_units[1].empty() || !crs.axis_units[2].empty()) {
        three("AXIS_UNIT", crs.axis_units, "none", "none", "none");
    }
    out << "ZPOSITIVE " << (crs.z_positive == ZPositive::depth ? "Depth" : "Elevation") << '\n';
    for (const auto& [keyword, value] : crs.annotations) out << keyword << ' ' << value << '\n';
    out << "END_ORIGINAL_COORDINATE_SYSTEM\n";
}

}  // namespace geomend::gocad
