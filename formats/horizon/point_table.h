// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text_cursor.h"
#include "formats/format.h"
#include "model/objects.h"

namespace geomend::horizon {

/// A column of a file of points.
struct PointColumn {
    enum class Kind : std::uint8_t { x, y, z, real, integer, text };
    Kind kind = Kind::real;
    std::string name;
    std::string type_word;  ///< the file's own word for the type ("FLOAT"); may be empty
};

/// How rows of points are read.
struct PointRows {
    std::vector<PointColumn> columns;  ///< with x, y and z in them
    double no_data = -999;             ///< of number columns
    std::string_view undefined;        ///< a word for missing, too; empty: none
    bool quoted = false;               ///< texts may stand in double quotes
    bool separators = false;           ///< rows of 999.0 999.0 999.0 begin a new part
    ZPositive sign = ZPositive::elevation;
};

/// x, y, z and further numbers of a plain row of n columns.
std::vector<PointColumn> plain_columns(std::size_t n);

/// True for the three numbers that end a polygon in IRAP files.
inline bool is_separator(const Vec3& p) { return p[0] == 999 && p[1] == 999 && p[2] == 999; }

/// Reads one row per line from the next line of the cursor to the end of the text, into points, attributes and parts.
/// Blank lines and lines that begin with '#' or '!' are passed over. Failure F012 for a row with another number of
/// columns, F005/F006 for a wrong number.
std::optional<Failure> read_point_rows(const Input& input, TextCursor& cursor, const PointRows& rows, const Monitor* monitor,
                                       PointSet& set);

/// A point attribute as columns of a file, one per component.
struct WrittenColumn {
    std::string name;
    PointColumn::Kind kind = PointColumn::Kind::real;
    std::string type_word;
    const Attribute* attribute = nullptr;
    std::uint32_t component = 0;
};

/// The point attributes as columns; those that have not one value per point are losses, and so are numbers that
/// would read as missing because they equal `no_data`, and texts with quotes or line ends in them.
std::vector<WrittenColumn> columns_of(const PointSet& set, double no_data, std::string_view title, std::vector<Loss>& losses);

enum class Quotes : std::uint8_t { where_needed, always };

/// Appends the value of a column at a point; missing numbers as `missing`, a number or a word, which also stands for
/// empty texts that are not quoted.
void append_value(std::string& text, const WrittenColumn& column, std::size_t point, std::string_view missing, Quotes quotes);

/// The first point set of a dataset, or the failure cannot_hold.
Result<std::size_t> point_set_for_writing(const Dataset& dataset, std::string_view title);

/// The position of a point in the file's sign.
inline Vec3 file_position(Vec3 p, ZPositive sign) {
    if (sign == ZPositive::depth) p[2] = -p[2];
    return p;
}

}  // namespace geomend::horizon
