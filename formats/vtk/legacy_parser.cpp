// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/file_filling.h"
#include "base/number_text.h"
#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/vtk/legacy_file.h"

// The records of the format stand in VTK's user's guide ("Simple Legacy Formats"); the layout with OFFSETS and
// CONNECTIVITY came with version 5. Records are taken in any order.

namespace geomend::vtk {

namespace {

constexpr std::uint64_t most_components = 1u << 20;

class Parser {
public:
    Parser(LegacyScanner& scanner, LegacyFile& file) : s_(scanner), file_(file) {}

    bool run() {
        if (!header()) return false;
        while (!s_.at_end()) {
            if (s_.stopped() || !record()) return false;
        }
        if (file_.kind == LegacyKind::none && file_.fields.empty())
            return s_.fail("F017", s_.offset(), "a DATASET or FIELD record is expected, the file ends without one");
        if (file_.kind == LegacyKind::none) file_.kind = LegacyKind::field;
        return whole();
    }

private:
    bool whole();
    bool header();
    bool record();
    bool dataset();
    bool geometry(std::string_view keyword, std::uint64_t at, bool& known);
    bool attribute(std::string_view keyword, std::uint64_t at, bool& known);
    bool unknown(std::string_view keyword, std::uint64_t at);
    bool trailing(std::uint64_t at);
    void note(const char* code, std::string message, std::uint64_t at);

    bool dimensions(std::uint64_t at);
    bool three_reals(std::optional<Vec3>& out, const char* what);
    bool coordinates(std::size_t axis, std::uint64_t at);
    bool points(std::uint64_t at);
    bool cells(LegacyCells& out, std::uint64_t at, const char* what);
    bool counted_cells(LegacyCells& out, std::uint64_t count, std::uint64_t size, const char* what);
    bool offset_cells(LegacyCells& out, std::uint64_t count, std::uint64_t size, const char* what);
    bool cell_types(std::uint64_t at);
    bool blanking(std::uint64_t at);

    bool section(std::uint64_t at, bool of_cells);
    bool named_array(LegacyArray array, bool counted, std::uint32_t components);
    bool component_count(LegacyArray& array);
    bool scalars(LegacyArray array);
    bool color_scalars(LegacyArray array);
    bool lookup_table();
    bool field();
    bool array_values(LegacyArray& array, std::string_view record);
    bool metadata(LegacyArray* array);
    void information(LegacyArray* array, std::string_view first_line);
    bool type(LegacyType& out, std::string_view what);
    bool keep(LegacyArray array);

    LegacyScanner& s_;
    LegacyFile& file_;
};

// Where a file ends between records, what is still missing tells that it was cut.
bool Parser::whole() {
    using enum LegacyKind;
    const std::uint64_t end = s_.bytes().size();
    const auto need = [&](bool there, const char* record) {
        return there || s_.fail("F004", end, std::string("the file ends without ") + record);
    };
    const bool with_points = file_.kind == structured_grid || file_.kind == unstructured_grid || file_.kind == polydata;
    if (with_points && !need(file_.points_stated, "POINTS")) return false;
    if (file_.kind == unstructured_grid && (!need(file_.cells.stated, "CELLS") || !need(file_.types_stated, "CELL_TYPES"))) return false;
    if (file_.kind == structured_points && !file_.spacing) note("F105", "there is no SPACING: 1 1 1 is taken", end);
    if (file_.kind == structured_points && !file_.origin) note("F105", "there is no ORIGIN: 0 0 0 is taken", end);
    const char last = s_.bytes().back();
    const bool open_line = !file_.binary && last != '\n' && last != ' ' && last != '\r' && last != '\t';
    const bool open_section = !file_.sections.empty() && file_.sections.back().arrays.empty() && file_.sections.back().count != 0;
    // Old writers announce POINT_DATA and CELL_DATA also where there is none.
    if (open_section && !open_line) note("F119", "the file ends after POINT_DATA or CELL_DATA: no array follows", end);
    else if (open_line && open_section) note("F101", "the file ends without a line end: it may have been cut short", end);
    else if (open_line) note("F165", "the file ends without a line end, behind all that it states: its last value may be cut", end);
    return true;
}

bool Parser::header() {
    const std::string_view first = s_.line();
    constexpr std::string_view signature = "# vtk DataFile Version";
    if (!same_word(first.substr(0, signature.size()), signature))
        return s_.fail("F003", 0, "the first line of a legacy VTK file is '# vtk DataFile Version ...'");
    const std::string_view version = trimmed(first.substr(signature.size()));
    const std::size_t dot = version.find('.');
    std::int64_t major = 0, minor = 0;
    if (parse_integer(version.substr(0, dot), major) != NumberStatus::ok || major < 1 || major > 99 ||
        (dot != std::string_view::npos && parse_integer(version.substr(dot + 1), minor) != NumberStatus::ok))
        return s_.fail("F005", signature.size(),
                       "a version such as 3.0 is expected, '" + std::string(version.substr(0, 40)) + "' was found");
    if (major > 5)
        return s_.fail("F013", signature.size(),
                       "version " + std::string(version.substr(0, 40)) + " is newer than 5.1, the newest that is known");
    file_.major_version = static_cast<int>(major);
    file_.minor_version = static_cast<int>(std::clamp<std::int64_t>(minor, 0, 99));
    file_.title = std::string(trimmed(s_.line()));
    const std::string_view word = s_.peek_word();
    if (!same_word(word, "ASCII") && !same_word(word, "BINARY"))
        return s_.fail(word.empty() ? "F004" : "F012", s_.offset(),
                       "ASCII or BINARY is expected" +
                           (word.empty() ? std::string(", the file ends") : ", '" + std::string(word.substr(0, 40)) + "' was found"));
    file_.binary = s_.binary = same_word(word, "BINARY");
    s_.word();
    return true;
}

bool Parser::record() {
    const std::string_view word = s_.peek_word();
    const std::uint64_t at = s_.offset();
    if (!is_legacy_keyword(word)) return unknown(word, at);
    if (same_word(word, "METADATA")) return metadata(nullptr);
    s_.word();
    const std::string keyword = upper_case(word);
    if (keyword == "DATASET") return dataset();
    if (keyword == "FIELD") return field();
    if (keyword == "POINT_DATA") return section(at, false);
    if (keyword == "CELL_DATA") return section(at, true);
    bool known = false;
    if (!geometry(keyword, at, known)) return false;
    if (known) return true;
    if (file_.sections.empty()) return s_.fail("F012", at, keyword + " is expected after a POINT_DATA or CELL_DATA record, not before");
    return attribute(keyword, at, known);
}

bool Parser::dataset() {
    const std::string_view word = s_.peek_word();
    const std::uint64_t at = s_.offset();
    if (file_.kind != LegacyKind::none) return s_.fail("F012", at, "a second DATASET record: a legacy file holds one dataset");
    constexpr std::pair<std::string_view, LegacyKind> kinds[] = {{"STRUCTURED_POINTS", LegacyKind::structured_points},
                                                                 {"STRUCTURED_GRID", LegacyKind::structured_grid},
                                                                 {"RECTILINEAR_GRID", LegacyKind::rectilinear_grid},
                                                                 {"UNSTRUCTURED_GRID", LegacyKind::unstructured_grid},
                                                                 {"POLYDATA", LegacyKind::polydata},
                                                                 {"FIELD", LegacyKind::field}};
    for (const auto& [name, kind] : kinds) {
        if (!same_word(word, name)) continue;
        file_.kind = kind;
        if (kind != LegacyKind::field) s_.word();  // "DATASET FIELD name n": the record follows at once
        return true;
    }
    return s_.fail(word.empty() ? "F004" : "F013", at,
                   "STRUCTURED_POINTS, STRUCTURED_GRID, RECTILINEAR_GRID, UNSTRUCTURED_GRID, POLYDATA or FIELD is expected" +
                       (word.empty() ? std::string(", the file ends") : ", '" + std::string(word.substr(0, 40)) + "' was found"));
}

bool Parser::geometry(std::string_view keyword, std::uint64_t at, bool& known) {
    known = true;
    const auto of = [&](std::initializer_list<LegacyKind> kinds) {
        return std::ranges::find(kinds, file_.kind) != kinds.end() ||
               s_.fail("F012", at,
                       std::string(keyword) +
                           (file_.kind == LegacyKind::none ? " stands before DATASET" : " does not belong to this kind of DATASET"));
    };
    using enum LegacyKind;
    if (keyword == "DIMENSIONS") return of({structured_points, structured_grid, rectilinear_grid}) && dimensions(at);
    if (keyword == "ORIGIN") return of({structured_points}) && three_reals(file_.origin, "ORIGIN");
    if (keyword == "SPACING" || keyword == "ASPECT_RATIO") return of({structured_points}) && three_reals(file_.spacing, "SPACING");
    if (keyword == "X_COORDINATES") return of({rectilinear_grid}) && coordinates(0, at);
    if (keyword == "Y_COORDINATES") return of({rectilinear_grid}) && coordinates(1, at);
    if (keyword == "Z_COORDINATES") return of({rectilinear_grid}) && coordinates(2, at);
    if (keyword == "POINTS") return of({structured_grid, unstructured_grid, polydata}) && points(at);
    if (keyword == "CELLS") return of({unstructured_grid}) && cells(file_.cells, at, "CELLS");
    if (keyword == "CELL_TYPES") return of({unstructured_grid}) && cell_types(at);
    if (keyword == "VERTICES") return of({polydata}) && cells(file_.verts, at, "VERTICES");
    if (keyword == "LINES") return of({polydata}) && cells(file_.lines, at, "LINES");
    if (keyword == "POLYGONS") return of({polydata}) && cells(file_.polys, at, "POLYGONS");
    if (keyword == "TRIANGLE_STRIPS") return of({polydata}) && cells(file_.strips, at, "TRIANGLE_STRIPS");
    if (keyword == "BLANKING") return of({structured_grid}) && blanking(at);
    known = false;
    return true;
}

bool Parser::attribute(std::string_view keyword, std::uint64_t at, bool& known) {
    known = true;
    LegacyArray array;
    array.offset = at;
    const auto as = [&](LegacyRole role, bool counted, std::uint32_t components) {
        array.role = role;
        return named_array(std::move(array), counted, components);
    };
    if (keyword == "SCALARS") return scalars(std::move(array));
    if (keyword == "COLOR_SCALARS") return color_scalars(std::move(array));
    if (keyword == "LOOKUP_TABLE") return lookup_table();
    if (keyword == "VECTORS") return as(LegacyRole::vectors, false, 3);
    if (keyword == "NORMALS") return as(LegacyRole::normals, false, 3);
    if (keyword == "TENSORS") return as(LegacyRole::tensors, false, 9);
    if (keyword == "TENSORS6") return as(LegacyRole::tensors6, false, 6);
    if (keyword == "TEXTURE_COORDINATES") return as(LegacyRole::texture, true, 0);
    if (keyword == "GLOBAL_IDS") return as(LegacyRole::global_ids, false, 1);
    if (keyword == "PEDIGREE_IDS") return as(LegacyRole::pedigree_ids, false, 1);
    if (keyword == "EDGE_FLAGS") return as(LegacyRole::edge_flags, false, 1);
    known = false;
    return true;
}

// A number here is one too many for the record before; another word may begin a record of which we do not know
// the length, so that in text we go on at the next record that we know.
bool Parser::unknown(std::string_view word, std::uint64_t at) {
    double value = 0;
    if (!s_.binary && parse_real(word, value) == NumberStatus::ok)
        return s_.fail("F008", at,
                       "the record before states fewer values than follow: a keyword is expected, '" + std::string(word.substr(0, 40)) +
                           "' was found");
    if (at + word.size() == s_.bytes().size() && begins_legacy_keyword(word))
        return s_.fail("F004", at, "the file ends inside the word '" + std::string(word) + "'");
    const std::string name(word.substr(0, 60));
    s_.line();
    while (!s_.at_end()) {
        const std::uint64_t here = s_.offset();
        if (is_legacy_keyword(s_.peek_word()) && (here == 0 || s_.bytes()[here - 1] == '\n')) {
            if (s_.binary)
                return s_.fail("F008", at,
                               "a keyword is expected here: the record before is longer than stated, or of a kind that is not known");
            drop(file_.findings, file_.losses,
                 {.what = "record '" + name + "'", .why = "it is not a record of the legacy VTK format", .where = s_.location(at)});
            return true;
        }
        s_.line();
    }
    return trailing(at);
}

void Parser::note(const char* code, std::string message, std::uint64_t at) {
    file_.findings.push_back(make_finding(code, std::move(message), s_.location(at)));
}

bool Parser::trailing(std::uint64_t at) {
    if (file_.kind == LegacyKind::none && file_.fields.empty()) return s_.fail("F012", at, "a DATASET or FIELD record is expected");
    const std::uint64_t size = s_.bytes().size() - at;
    if (s_.bytes().substr(at).find_first_not_of(file_filling) == std::string_view::npos) {
        s_.take_rest();
        return true;
    }
    drop(file_.findings, file_.losses,
         {.loss_class = LossClass::identity,
          .what = "bytes after the last record",
          .why = "they belong to no record",
          .count = size,
          .where = s_.location(at),
          .message = std::to_string(size) + " bytes after the last record are not read"});
    s_.take_rest();
    return true;
}

bool Parser::dimensions(std::uint64_t at) {
    std::array<std::uint32_t, 3> dims{};
    for (auto& dim : dims) {
        std::uint64_t n = 0;
        if (!s_.count(n, "a number of DIMENSIONS")) return false;
        if (n < 1 || n > 0x7fffffff) return s_.fail("F012", at, "DIMENSIONS are whole numbers from 1, " + std::to_string(n) + " was found");
        dim = static_cast<std::uint32_t>(n);
    }
    const std::uint64_t plane = std::uint64_t{dims[0]} * dims[1];
    if (plane > no_index || plane * dims[2] >= no_index) return s_.fail("F014", at, "DIMENSIONS ask for more than 4294967294 points");
    file_.dims = dims;
    return true;
}

bool Parser::three_reals(std::optional<Vec3>& out, const char* what) {
    Vec3 v{};
    for (double& x : v) {
        const std::uint64_t at = s_.offset();
        if (!s_.real(x, what)) return false;
        if (!std::isfinite(x)) return s_.fail("F006", at, std::string(what) + " is not finite");
    }
    out = v;
    return true;
}

bool Parser::type(LegacyType& out, std::string_view what) {
    const std::string_view word = s_.peek_word();
    const std::uint64_t at = s_.offset();
    if (word.empty()) return s_.fail("F004", at, "the file ends where the type of " + std::string(what) + " is expected");
    out = legacy_type(word);
    if (out == LegacyType::unknown)
        return s_.fail("F013", at,
                       "a type (float, double, int, ...) is expected for " + std::string(what) + ", '" + std::string(word.substr(0, 40)) +
                           "' was found");
    s_.word();
    return true;
}

bool Parser::coordinates(std::size_t axis, std::uint64_t at) {
    constexpr const char* names[] = {"X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"};
    std::uint64_t n = 0;
    LegacyType type_here{};
    if (!s_.count(n, "the number of coordinates") || !type(type_here, names[axis]) || !s_.room_for(type_here, n, names[axis])) return false;
    auto& out = file_.coordinates[axis];
    out.resize(static_cast<std::size_t>(n));
    const std::uint64_t block = s_.offset();
    if (!s_.reals(type_here, n, names[axis], out.data())) return false;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!std::isfinite(out[i]))
            return s_.fail_at("F006", s_.value_location(block, type_here, i),
                              std::string(names[axis]) + " holds a value that is not finite");
    }
    if (file_.coordinates_stated[axis]) return s_.fail("F009", at, std::string(names[axis]) + " is given twice");
    file_.coordinates_stated[axis] = true;
    file_.coordinates_type[axis] = type_here;
    return metadata(nullptr);
}

bool Parser::points(std::uint64_t at) {
    if (file_.points_stated) return s_.fail("F009", at, "POINTS is given twice");
    std::uint64_t n = 0;
    if (!s_.count(n, "the number of POINTS") || !type(file_.points_type, "POINTS")) return false;
    if (n >= no_index) return s_.fail("F014", at, "POINTS asks for " + std::to_string(n) + " points: at most 4294967294 can be read");
    if (!s_.room_for(file_.points_type, 3 * n, "POINTS")) return false;
    file_.points.resize(static_cast<std::size_t>(n));
    file_.points_offset = at;
    file_.points_stated = true;
    const std::uint64_t block = s_.offset();
    if (n != 0 && !s_.reals(file_.points_type, 3 * n, "POINTS", file_.points.data()->data())) return false;
    for (std::size_t i = 0; i < file_.points.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(file_.points[i][axis])) [[unlikely]]
                return s_.fail_at("F006", s_.value_location(block, file_.points_type, 3 * i + axis),
                                  "a coordinate of point " + std::to_string(i) + " is not finite");
        }
    }
    return metadata(nullptr);
}

bool Parser::cells(LegacyCells& out, std::uint64_t at, const char* what) {
    if (out.stated) return s_.fail("F009", at, std::string(what) + " is given twice");
    out.stated = true;
    out.offset = at;
    std::uint64_t count = 0, size = 0;
    if (!s_.count(count, "a number of cells") || !s_.count(size, "a number of values")) return false;
    // The word tells the layouts apart more safely than the version: 'OFFS' as a binary count is 1.3e9.
    const std::uint64_t after_counts = s_.offset();
    if (same_word(s_.peek_word(), "OFFSETS")) return offset_cells(out, count, size, what);
    s_.jump(after_counts);
    if (file_.major_version >= 5 && count == 0 && size == 0) return metadata(nullptr);
    return counted_cells(out, count, size, what);
}

bool Parser::counted_cells(LegacyCells& out, std::uint64_t count, std::uint64_t size, const char* what) {
    out.counted = true;
    out.values_offset = s_.offset();
    if (!s_.room_for(LegacyType::int32, size, what)) return false;
    if (count > size)
        return s_.fail("F008", out.offset,
                       std::string(what) + ": " + std::to_string(count) + " cells cannot stand in " + std::to_string(size) + " values");
    auto& corners = out.cells.corners;
    corners.resize(static_cast<std::size_t>(size));
    if (!s_.indices(LegacyType::int32, size, what, corners.data())) return false;
    out.cells.offsets.reserve(static_cast<std::size_t>(count) + 1);
    std::uint64_t read = 0, kept = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (read == size || corners[read] > size - read - 1)
            return s_.fail_at("F008", s_.value_location(out.values_offset, LegacyType::int32, read),
                              std::string(what) + ": cell " + std::to_string(i) + " of " + std::to_string(count) + " reaches beyond the " +
                                  std::to_string(size) + " values that are stated");
        const std::uint64_t n = corners[read++];
        std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(read), n, corners.begin() + static_cast<std::ptrdiff_t>(kept));
        read += n;
        kept += n;
        out.cells.offsets.push_back(kept);
    }
    if (read != size)
        return s_.fail("F008", out.offset,
                       std::string(what) + " states " + std::to_string(size) + " values, but its " + std::to_string(count) +
                           " cells take " + std::to_string(read));
    corners.resize(static_cast<std::size_t>(kept));
    return true;
}

bool Parser::offset_cells(LegacyCells& out, std::uint64_t count, std::uint64_t size, const char* what) {
    s_.word();
    LegacyType offsets_type{};
    const std::string name = std::string("OFFSETS of ") + what, connectivity = std::string("CONNECTIVITY of ") + what;
    if (!type(offsets_type, name) || !s_.room_for(offsets_type, count, name)) return false;
    const std::uint64_t block = s_.offset();
    std::vector<std::uint64_t> offsets(static_cast<std::size_t>(count));
    if (!s_.offsets(offsets_type, count, name, offsets.data()) || !metadata(nullptr)) return false;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (i == 0 ? offsets[0] != 0 : offsets[i] < offsets[i - 1])
            return s_.fail_at("F012", s_.value_location(block, offsets_type, i), name + " begin with 0 and do not fall");
    }
    if ((count == 0 ? 0 : offsets.back()) != size)
        return s_.fail("F008", out.offset,
                       std::string(what) + " states " + std::to_string(size) + " values, but its offsets end at " +
                           std::to_string(count == 0 ? 0 : offsets.back()));
    if (!same_word(s_.peek_word(), "CONNECTIVITY"))
        return s_.fail(s_.at_end() ? "F004" : "F008", s_.offset(), "CONNECTIVITY is expected after " + name);
    s_.word();
    if (!type(out.values_type, connectivity) || !s_.room_for(out.values_type, size, connectivity)) return false;
    out.values_offset = s_.offset();
    out.cells.corners.resize(static_cast<std::size_t>(size));
    if (!s_.indices(out.values_type, size, connectivity, out.cells.corners.data())) return false;
    if (count != 0) out.cells.offsets = std::move(offsets);
    return metadata(nullptr);
}

bool Parser::cell_types(std::uint64_t at) {
    if (file_.types_stated) return s_.fail("F009", at, "CELL_TYPES is given twice");
    std::uint64_t n = 0;
    if (!s_.count(n, "the number of CELL_TYPES") || !s_.room_for(LegacyType::int32, n, "CELL_TYPES")) return false;
    file_.types_stated = true;
    file_.types_offset = at;
    file_.types_values_offset = s_.offset();
    file_.types.resize(static_cast<std::size_t>(n));
    return s_.indices(LegacyType::int32, n, "CELL_TYPES", file_.types.data()) && metadata(nullptr);
}

bool Parser::blanking(std::uint64_t at) {
    std::uint64_t n = 0;
    LegacyType type_here{};
    AttributeValues values;
    if (!s_.count(n, "the number of BLANKING values") || !type(type_here, "BLANKING") || !s_.values(type_here, n, "BLANKING", values))
        return false;
    file_.blanking_offset = at;
    Attribute a;
    a.values = std::move(values);
    file_.blanking.resize(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < file_.blanking.size(); ++i) file_.blanking[i] = value_as_double(a, i) != 0;
    return true;
}

bool Parser::section(std::uint64_t at, bool of_cells) {
    LegacySection section;
    section.offset = at;
    section.of_cells = of_cells;
    if (!s_.count(section.count, of_cells ? "the number of cells" : "the number of points")) return false;
    file_.sections.push_back(std::move(section));
    return true;
}

bool Parser::keep(LegacyArray array) {
    file_.sections.back().arrays.push_back(std::move(array));
    return true;
}

bool Parser::array_values(LegacyArray& array, std::string_view record) {
    const std::string what = std::string(record) + (array.name.empty() ? "" : " '" + array.name + "'");
    if (array.tuples != 0 && array.components > ~std::uint64_t{0} / array.tuples)
        return s_.fail("F014", array.offset, what + " asks for more values than there can be");
    return s_.values(array.type, array.components * array.tuples, what, array.values) && metadata(&array);
}

bool Parser::named_array(LegacyArray array, bool counted, std::uint32_t components) {
    array.name = percent_decoded(s_.word());
    array.components = components;
    if (counted) {
        std::uint64_t n = 0;
        const std::uint64_t at = s_.offset();
        if (!s_.count(n, "a number of components")) return false;
        if (n < 1 || n > 3) return s_.fail("F012", at, "TEXTURE_COORDINATES have 1 to 3 components, " + std::to_string(n) + " was found");
        array.components = static_cast<std::uint32_t>(n);
    }
    array.tuples = file_.sections.back().count;
    return type(array.type, array.name) && array_values(array, "the values of") && keep(std::move(array));
}

// SCALARS name type [components] LOOKUP_TABLE table; files without the LOOKUP_TABLE line exist and are taken.
bool Parser::component_count(LegacyArray& array) {
    std::uint64_t n = 0;
    const std::uint64_t at = s_.offset();
    if (!s_.count(n, "a number of components")) return false;
    if (n < 1 || n > most_components)
        return s_.fail("F012", at, "a number of components from 1 is expected, " + std::to_string(n) + " was found");
    array.components = static_cast<std::uint32_t>(n);
    return true;
}

bool Parser::scalars(LegacyArray array) {
    array.role = LegacyRole::scalars;
    array.name = percent_decoded(s_.word());
    array.tuples = file_.sections.back().count;
    if (!type(array.type, "SCALARS '" + array.name + "'")) return false;
    const std::string_view rest =
        trimmed(std::string_view(s_.bytes()).substr(s_.offset(), s_.bytes().find('\n', s_.offset()) - s_.offset()));
    if (!rest.empty() && !same_word(rest.substr(0, 12), "LOOKUP_TABLE")) {
        if (!component_count(array)) return false;
    }
    const std::uint64_t before = s_.offset();
    if (same_word(s_.peek_word(), "LOOKUP_TABLE")) {
        s_.word();
        array.lookup_table = percent_decoded(s_.word());
    } else {
        s_.jump(before);
    }
    return array_values(array, "SCALARS") && keep(std::move(array));
}

// Parts of the whole as VTK makes bytes of them: rounded, and from 0 to 255.
static std::vector<std::uint8_t> bytes_of_shares(const std::vector<float>& shares) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(shares.size());
    for (const float share : shares) {
        const double byte = std::floor(double{share} * 255.0 + 0.5);
        bytes.push_back(byte > 0 ? static_cast<std::uint8_t>(std::min(byte, 255.0)) : std::uint8_t{0});  // 0 for what is no number
    }
    return bytes;
}

bool Parser::color_scalars(LegacyArray array) {
    array.role = LegacyRole::color_scalars;
    array.name = percent_decoded(s_.word());
    array.tuples = file_.sections.back().count;
    if (!component_count(array)) return false;
    array.type = s_.binary ? LegacyType::unsigned_char : LegacyType::float32;  // bytes, or 0..1 in text
    if (!array_values(array, "COLOR_SCALARS")) return false;
    if (const auto* shares = std::get_if<std::vector<float>>(&array.values)) array.values = bytes_of_shares(*shares);
    return keep(std::move(array));
}

bool Parser::lookup_table() {
    const std::uint64_t at = s_.offset();
    const std::string name = percent_decoded(s_.word());
    std::uint64_t n = 0;
    if (!s_.count(n, "the number of colours")) return false;
    if (n > ~std::uint64_t{0} / 16) return s_.fail("F014", at, "LOOKUP_TABLE asks for more colours than there can be");
    AttributeValues values;
    const LegacyType type_here = s_.binary ? LegacyType::unsigned_char : LegacyType::float64;
    if (!s_.values(type_here, 4 * n, "LOOKUP_TABLE", values)) return false;
    std::vector<double> colours;
    if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&values)) {
        for (const std::uint8_t b : *bytes) colours.push_back(b / 255.0);
    } else {
        colours = std::get<std::vector<double>>(std::move(values));
    }
    for (auto section = file_.sections.rbegin(); section != file_.sections.rend(); ++section) {
        for (LegacyArray& array : section->arrays) {
            if (array.lookup_table != name || !array.lookup_values.empty()) continue;
            array.lookup_values = std::move(colours);
            return true;
        }
    }
    list_dropped(file_.losses, {LossClass::style, name, "colour table '" + name + "'", "no SCALARS name it"});
    return true;
}

bool Parser::field() {
    s_.word();  // the name of the field; VTK itself always writes FieldData
    std::uint64_t n = 0;
    if (!s_.count(n, "the number of arrays of FIELD")) return false;
    for (std::uint64_t i = 0; i < n; ++i) {
        const std::string_view word = s_.peek_word();
        const std::uint64_t at = s_.offset();
        if (word.empty())
            return s_.fail("F004", at, "the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " arrays of FIELD");
        s_.word();
        if (word == "NULL_ARRAY") continue;
        if (s_.stopped()) return false;
        LegacyArray array;
        array.offset = at;
        array.name = percent_decoded(word);
        std::uint64_t components = 0;
        if (!s_.count(components, "a number of components") || !s_.count(array.tuples, "a number of tuples")) return false;
        if (components > most_components || (components == 0 && array.tuples != 0))
            return s_.fail("F012", at, "array '" + array.name + "' cannot have " + std::to_string(components) + " components");
        array.components = static_cast<std::uint32_t>(std::max<std::uint64_t>(components, 1));
        if (!type(array.type, "array '" + array.name + "'")) return false;
        if (!file_.sections.empty() && array.tuples != file_.sections.back().count)
            return s_.fail("F008", at,
                           "array '" + array.name + "' has " + std::to_string(array.tuples) + " tuples where " +
                               std::to_string(file_.sections.back().count) + " are expected");
        if (!array_values(array, "array")) return false;
        (file_.sections.empty() ? file_.fields : file_.sections.back().arrays).push_back(std::move(array));
    }
    return true;
}

// Follows an array, ends with an empty line. Without an array (of POINTS, OFFSETS, ...) it is only passed over.
bool Parser::metadata(LegacyArray* array) {
    if (!same_word(s_.peek_word(), "METADATA")) return true;
    s_.word();
    s_.line();
    while (s_.remaining() != 0) {
        const std::string_view text = trimmed(s_.line());
        if (text.empty()) return true;
        if (same_word(text, "COMPONENT_NAMES")) {
            std::vector<std::string> names;
            for (std::uint32_t i = 0; array != nullptr && i < array->components; ++i) {
                if (s_.remaining() == 0)
                    return s_.fail("F004", s_.offset(), "the file ends inside the component names of '" + array->name + "'");
                names.push_back(percent_decoded(trimmed(s_.line())));
            }
            if (array != nullptr) array->component_names = std::move(names);
        } else {
            information(array, text);
        }
    }
    return true;
}

// "NAME key LOCATION class" and then "DATA ..." lines. Ranges are only a memory of VTK's and are left out.
void Parser::information(LegacyArray* array, std::string_view first_line) {
    if (array == nullptr || first_line.starts_with("INFORMATION")) return;
    const bool range = first_line.starts_with("NAME L2_NORM_RANGE") || first_line.starts_with("NAME L2_NORM_FINITE_RANGE") ||
                       first_line.starts_with("NAME COMPONENT_RANGE") || first_line.starts_with("NAME FINITE_RANGE");
    if (range || first_line.starts_with("NAME UNITS_LABEL ")) {
        const std::string_view data = trimmed(s_.line());
        if (!range && data.starts_with("DATA ")) array->unit = percent_decoded(trimmed(data.substr(5)));
        return;
    }
    if (!array->information.empty()) array->information += '\n';
    array->information += first_line;
}

}  // namespace

bool parse_legacy(LegacyScanner& scanner, LegacyFile& file) { return Parser(scanner, file).run(); }

}  // namespace geomend::vtk
