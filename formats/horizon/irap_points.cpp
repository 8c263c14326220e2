// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/irap_points.h"

#include <algorithm>

#include "formats/horizon/common.h"
#include "formats/horizon/losses.h"
#include "formats/horizon/point_table.h"

namespace geomend::horizon {

namespace {

constexpr std::string_view title = "IRAP points";
constexpr double no_data = -999;
constexpr std::string_view undefined = "UNDEF";
constexpr std::size_t most_columns = 10000;

bool is_comment(std::string_view token) { return token.starts_with('#') || token.starts_with('!'); }

/// The column that a line "Float name" declares.
std::optional<PointColumn> declared_column(TextCursor& cursor) {
    using Kind = PointColumn::Kind;
    const std::string_view word = cursor.token();
    PointColumn column;
    if (same_word(word, "Float")) column.kind = Kind::real;
    else if (same_word(word, "Discrete") || same_word(word, "Integer") || same_word(word, "Int")) column.kind = Kind::integer;
    else if (same_word(word, "String")) column.kind = Kind::text;
    else return std::nullopt;
    column.name = cursor.rest();
    column.type_word = word;
    if (column.name.empty()) return std::nullopt;
    return column;
}

/// The number of tokens of the current line, and whether all are numbers.
std::pair<std::size_t, bool> count_tokens(TextCursor cursor) {
    std::size_t count = 0;
    bool numbers = true;
    double value = 0;
    cursor.rewind_line();
    for (std::string_view token = cursor.token(); !token.empty() && count <= most_columns; token = cursor.token(), ++count) {
        numbers = numbers && parse_real(token, value) == NumberStatus::ok;
    }
    return {count, numbers};
}

/// Reads the lines in front of the first row and says what the columns are.
std::optional<Failure> read_columns(const Input& input, TextCursor& cursor, PointRows& rows) {
    std::vector<PointColumn> declared;
    const char* row_begin = cursor.next_line_begin();
    std::uint64_t row_line = cursor.line() + 1;
    for (; cursor.next_line(); row_begin = cursor.next_line_begin(), row_line = cursor.line() + 1) {
        if (cursor.at_line_end() || is_comment(cursor.peek_rest())) continue;
        if (auto column = declared_column(cursor)) {
            declared.push_back(std::move(*column));
            continue;
        }
        const std::size_t count = count_tokens(cursor).first;
        if (count < 3 || count > most_columns) {
            return unreadable("F012", {input.name(), cursor.line(), 1}, "expected x, y and z, found " + shown(trimmed(cursor.line_text())));
        }
        rows.columns = plain_columns(declared.empty() ? count : 3);
        rows.columns.insert(rows.columns.end(), declared.begin(), declared.end());
        cursor.jump(row_begin, row_line);
        return std::nullopt;
    }
    return unreadable("F017", {input.name(), cursor.line()}, "expected points, found none");
}

}  // namespace

bool has_points_extension(std::string_view base_name) {
    const std::string name = lower_case(base_name);
    return std::ranges::any_of(points_extensions, [&](std::string_view extension) { return name.ends_with(extension); });
}

int sniff_irap_points(std::string_view head, std::string_view base_name) {
    TextCursor cursor(head);
    int rows = 0;
    bool declared = false;
    std::size_t columns = 0;
    constexpr int enough = 20;
    while (rows < enough && cursor.next_line()) {
        if (cursor.next_line_begin() == cursor.text_end() && rows > 0) break;  // may be cut
        if (cursor.at_line_end() || is_comment(cursor.peek_rest())) continue;
        if (rows == 0 && declared_column(cursor)) {
            declared = true;
            continue;
        }
        const auto [count, numbers] = count_tokens(cursor);
        if (count < 3 || (!numbers && !declared)) return 0;
        if (columns != 0 && count != columns && !declared && count != 3) return 0;
        if (columns == 0) columns = count;
        ++rows;
    }
    if (rows == 0) return 0;
    if (declared) return 60;
    return has_points_extension(base_name) ? 30 : 0;  // any table of numbers might be points
}

Result<Dataset> read_irap_points(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    PointRows rows;
    rows.no_data = no_data;
    rows.undefined = undefined;
    rows.quoted = true;
    rows.separators = true;
    rows.sign = sign->value_or(ZPositive::elevation);
    TextCursor cursor(text_of(input));
    if (auto failed = read_columns(input, cursor, rows)) return std::move(*failed);
    PointSet set;
    set.info.name = name_of(input);
    set.info.crs.z_positive = rows.sign;
    set.info.crs.z_positive_stated = sign->has_value();
    if (auto failed = read_point_rows(input, cursor, rows, options.monitor, set)) return std::move(*failed);
    Dataset dataset = dataset_of("IRAP points", std::move(set));
    tell_missing_line_end(input, dataset);
    return dataset;
}

Result<std::vector<Loss>> write_irap_points(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    const auto asked_sign = z_option(options.options);
    if (!asked_sign) return asked_sign.why();
    const std::string_view style = option_value(options.options, "attributes");
    if (!style.empty() && !same_word(style, "rms") && !same_word(style, "none")) {
        return failure(FailureKind::usage, "F018", {}, "option attributes: expected rms or none, found " + shown(style));
    }
    const auto index = point_set_for_writing(dataset, title);
    if (!index) return index.why();
    const PointSet& set = std::get<PointSet>(dataset.objects[*index]);
    std::vector<Loss> losses;
    add_other_losses(dataset, *index, title, losses);
    const bool with_attributes = same_word(style, "rms");
    add_info_losses(set.info, {.title = title, .attributes = with_attributes}, out, losses);
    std::vector<WrittenColumn> columns;
    if (with_attributes) columns = columns_of(set, no_data, title, losses);

    OutputFile& file = out.main_file();
    for (const WrittenColumn& column : columns) {
        using Kind = PointColumn::Kind;
        file << (column.kind == Kind::text ? "String " : column.kind == Kind::integer ? "Discrete " : "Float ") << column.name << '\n';
    }
    const ZPositive sign = asked_sign->value_or(set.info.crs.z_positive);
    std::size_t part = 0;
    std::string text;
    for (std::size_t i = 0; i < set.points.size() && file.good(); ++i) {
        if (part < set.part_first.size() && set.part_first[part] == i) {
            if (i > 0) file << "999.0 999.0 999.0\n";
            ++part;
        }
        const Vec3 p = file_position(set.points[i], sign);
        if (is_separator(p))
            add_loss(losses, {LossClass::substance, set.info.name, "a point at 999 999 999", "this ends a part in IRAP points"});
        file.number(p[0]) << ' ';
        file.number(p[1]) << ' ';
        file.number(p[2]);
        for (const WrittenColumn& column : columns) {
            text = ' ';
            append_value(text, column, i, undefined, Quotes::where_needed);
            file << text;
        }
        file << '\n';
    }
    return losses;
}

}  // namespace geomend::horizon
