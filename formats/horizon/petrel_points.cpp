// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/petrel_points.h"

#include <algorithm>

#include "formats/horizon/common.h"
#include "formats/horizon/losses.h"
#include "formats/horizon/point_table.h"

namespace geomend::horizon {

namespace {

using Kind = PointColumn::Kind;

constexpr std::string_view title = "Petrel points";
constexpr double no_data = -999;
constexpr std::string_view missing_text = "-999";
constexpr std::string_view signature = "# Petrel Points with attributes";
constexpr std::string_view horizontal_unit = "# Unit in X and Y direction:", vertical_unit = "# Unit in depth:";

bool begins_with(std::string_view text, std::string_view begin) {
    return text.size() >= begin.size() && same_word(text.substr(0, begin.size()), begin);
}

/// Units stand in comments.
bool take_unit(std::string_view line, CoordinateSystem& crs) {
    if (begins_with(line, horizontal_unit)) {
        crs.axis_units[0] = crs.axis_units[1] = trimmed(line.substr(horizontal_unit.size()));
    } else if (begins_with(line, vertical_unit)) {
        crs.axis_units[2] = trimmed(line.substr(vertical_unit.size()));
    } else {
        return false;
    }
    crs.stated = true;
    return true;
}

bool is_text_type(std::string_view type) { return same_word(type, "STRING") || same_word(type, "BOOL") || same_word(type, "DATE"); }

bool is_integer_type(std::string_view type) { return same_word(type, "INT") || same_word(type, "INTEGER"); }

bool is_real_type(std::string_view type) { return same_word(type, "FLOAT") || same_word(type, "DOUBLE"); }

/// Where the type of a column ends: at the comma; or at the blank or semicolon behind a known type. npos: there is no type.
std::size_t end_of_type(std::string_view line) {
    const std::size_t end = line.find_first_of(" \t;,");
    if (end == std::string_view::npos) return end;
    const std::string_view first = line.substr(0, end);
    if (is_text_type(first) || is_integer_type(first) || is_real_type(first)) {
        const std::size_t next = line.find_first_not_of(" \t", end);
        return next != std::string_view::npos && (line[next] == ',' || line[next] == ';') ? next : end;
    }
    const std::size_t comma = line.find(','), quote = line.find('"');
    if (quote == std::string_view::npos || comma < quote || !line.ends_with('"')) return comma;
    const std::size_t blank = line.find_first_of(" \t");
    return blank < quote ? blank : std::string_view::npos;
}

std::optional<PointColumn> declared_column(std::string_view line) {
    const std::size_t comma = end_of_type(line);
    if (comma == std::string_view::npos) {
        if (same_word(line, "X")) return PointColumn{Kind::x, "x", {}};
        if (same_word(line, "Y")) return PointColumn{Kind::y, "y", {}};
        if (same_word(line, "Z")) return PointColumn{Kind::z, "z", {}};
        return PointColumn{Kind::real, std::string(line), {}};
    }
    PointColumn column;
    const std::string_view type = trimmed(line.substr(0, comma));
    column.type_word = type;
    std::string_view name = trimmed(line.substr(comma + 1));
    if (name.size() >= 2 && name.starts_with('"') && name.ends_with('"')) name = trimmed(name.substr(1, name.size() - 2));
    column.name = name;
    if (is_integer_type(type)) column.kind = Kind::integer;
    else if (is_real_type(type)) column.kind = Kind::real;
    else if (is_text_type(type)) column.kind = Kind::text;
    else return std::nullopt;
    return column;
}

std::optional<Failure> check_axes(const Input& input, const TextCursor& cursor, const std::vector<PointColumn>& columns) {
    for (const Kind axis : {Kind::x, Kind::y, Kind::z}) {
        if (std::ranges::count(columns, axis, &PointColumn::kind) == 1) continue;
        return unreadable("F012", {input.name(), cursor.line()}, "expected X, Y and Z once each in the header");
    }
    return std::nullopt;
}

std::optional<Failure> read_header(const Input& input, TextCursor& cursor, PointRows& rows, ObjectInfo& info) {
    bool begun = false;
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (line.empty()) continue;
        if (line.starts_with('#')) {
            if (!take_unit(line, info.crs) && !same_word(line, signature))
                info.annotations.push_back({"horizon.petrel_comment", std::string(line)});
        } else if (same_word(line, "END HEADER")) {
            return check_axes(input, cursor, rows.columns);
        } else if (same_word(line, "BEGIN HEADER")) {
            begun = true;
        } else if (begun) {
            auto column = declared_column(line);
            if (!column)
                return unreadable("F013", {input.name(), cursor.line(), 1},
                                  "expected FLOAT, DOUBLE, INT, STRING, BOOL or DATE and a name, found " + shown(line));
            rows.columns.push_back(std::move(*column));
        } else if (!begins_with(line, "VERSION")) {
            return unreadable("F012", {input.name(), cursor.line(), 1}, "expected VERSION or BEGIN HEADER, found " + shown(line));
        }
    }
    return unreadable("F004", {input.name(), cursor.line()}, "expected END HEADER, found the end of the file");
}

std::string_view type_word(const WrittenColumn& column) {
    if (!column.type_word.empty()) {
        for (const std::string_view known : {"FLOAT", "DOUBLE", "INT", "STRING", "BOOL", "DATE"}) {
            if (column.type_word == known) return known;
        }
    }
    if (column.kind == Kind::text) return "STRING";
    if (column.kind == Kind::integer) return "INT";
    return std::holds_alternative<std::vector<float>>(column.attribute->values) ? "FLOAT" : "DOUBLE";
}

void write_header(OutputFile& file, const PointSet& set, const std::vector<WrittenColumn>& columns) {
    const CoordinateSystem& crs = set.info.crs;
    file << signature << '\n';
    if (!crs.axis_units[0].empty()) file << horizontal_unit << ' ' << crs.axis_units[0] << '\n';
    if (!crs.axis_units[2].empty()) file << vertical_unit << ' ' << crs.axis_units[2] << '\n';
    for (const Annotation& a : set.info.annotations) {
        if (a.key == "horizon.petrel_comment" && a.value.find_first_of("\n\r") == std::string::npos) file << a.value << '\n';
    }
    file << "VERSION 1\nBEGIN HEADER\nX\nY\nZ\n";
    for (const WrittenColumn& column : columns) file << type_word(column) << ',' << column.name << '\n';
    file << "END HEADER\n";
}

}  // namespace

int sniff_petrel_points(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    bool begun = false;
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (line.empty()) continue;
        if (begins_with(line, signature)) return 98;
        if (begun) return same_word(line, "X") ? 40 : 0;
        if (same_word(line, "BEGIN HEADER")) begun = true;
        else if (!line.starts_with('#') && !begins_with(line, "VERSION")) return 0;
    }
    return 0;
}

Result<Dataset> read_petrel_points(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    PointRows rows;
    rows.no_data = no_data;
    rows.quoted = true;
    rows.sign = sign->value_or(ZPositive::elevation);
    PointSet set;
    set.info.name = name_of(input);
    TextCursor cursor(text_of(input));
    if (auto failed = read_header(input, cursor, rows, set.info)) return std::move(*failed);
    set.info.crs.z_positive = rows.sign;
    set.info.crs.z_positive_stated = sign->has_value();
    if (auto failed = read_point_rows(input, cursor, rows, options.monitor, set)) return std::move(*failed);
    Dataset dataset = dataset_of("Petrel points with attributes", std::move(set));
    tell_missing_line_end(input, dataset);
    return dataset;
}

Result<std::vector<Loss>> write_petrel_points(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    const auto asked_sign = z_option(options.options);
    if (!asked_sign) return asked_sign.why();
    const auto index = point_set_for_writing(dataset, title);
    if (!index) return index.why();
    const PointSet& set = std::get<PointSet>(dataset.objects[*index]);
    std::vector<Loss> losses;
    add_other_losses(dataset, *index, title, losses);
    const bool units = set.info.crs.axis_units[0] == set.info.crs.axis_units[1];
    add_info_losses(set.info, {.title = title, .units = units, .attributes = true, .annotations = "horizon."}, out, losses);
    if (!set.part_first.empty())
        add_loss(losses, {LossClass::identity, set.info.name, "parts", "Petrel points have none", set.part_first.size() + 1});
    const std::vector<WrittenColumn> columns = columns_of(set, no_data, title, losses);

    OutputFile& file = out.main_file();
    write_header(file, set, columns);
    const ZPositive sign = asked_sign->value_or(set.info.crs.z_positive);
    std::string text;
    for (std::size_t i = 0; i < set.points.size() && file.good(); ++i) {
        const Vec3 p = file_position(set.points[i], sign);
        file.number(p[0]) << ' ';
        file.number(p[1]) << ' ';
        file.number(p[2]);
        for (const WrittenColumn& column : columns) {
            text = ' ';
            append_value(text, column, i, missing_text, Quotes::always);
            file << text;
        }
        file << '\n';
    }
    return losses;
}

}  // namespace geomend::horizon
