// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/point_table.h"

#include <cmath>
#include <limits>

#include "formats/horizon/common.h"

namespace geomend::horizon {

namespace {

using Kind = PointColumn::Kind;

Attribute attribute_of(const PointColumn& column, double no_data) {
    Attribute a;
    a.name = column.name;
    if (column.kind == Kind::text) {
        a.values = std::vector<std::string>{};
    } else {
        if (column.kind == Kind::integer) a.values = std::vector<std::int32_t>{};
        else a.values = std::vector<double>{};
        a.no_data = no_data;
    }
    if (!column.type_word.empty()) a.annotations.emplace_back("horizon.type", column.type_word);
    return a;
}

std::optional<Failure> add_integer(const Input& input, const TextCursor& cursor, std::string_view token, Attribute& a) {
    std::int64_t value = 0;
    NumberStatus status = parse_integer(token, value);
    double real = 0;
    // Some programs print whole numbers with decimals.
    if (status == NumberStatus::malformed && parse_real(token, real) == NumberStatus::ok && real == std::floor(real) &&
        std::abs(real) < 2e9) {
        value = static_cast<std::int64_t>(real);
        status = NumberStatus::ok;
    }
    const bool fits = value >= std::numeric_limits<std::int32_t>::min() && value <= std::numeric_limits<std::int32_t>::max();
    if (status != NumberStatus::ok || !fits) {
        return unreadable("F005", location_of(input, cursor, token),
                          "expected a whole number of 32 bits for '" + a.name + "', found " + shown(token));
    }
    std::get<std::vector<std::int32_t>>(a.values).push_back(static_cast<std::int32_t>(value));
    return std::nullopt;
}

/// Adds the token to the attribute.
std::optional<Failure> add_value(const Input& input, TextCursor& cursor, const PointRows& rows, Kind kind, std::string_view token,
                                 Attribute& a) {
    if (kind == Kind::text) {
        std::get<std::vector<std::string>>(a.values).emplace_back(token);
        return std::nullopt;
    }
    const bool missing = !rows.undefined.empty() && same_word(token, rows.undefined);
    if (kind == Kind::integer) {
        if (!missing) return add_integer(input, cursor, token, a);
        std::get<std::vector<std::int32_t>>(a.values).push_back(static_cast<std::int32_t>(rows.no_data));
        return std::nullopt;
    }
    double value = rows.no_data;
    if (!missing) {
        if (auto failed = finite_number(input, cursor, token, "a number for '" + a.name + "'", value)) return failed;
    }
    std::get<std::vector<double>>(a.values).push_back(value);
    return std::nullopt;
}

bool can_be_quoted(std::string_view text) { return text.find_first_of("\"\n\r") == std::string_view::npos; }

void append_text(std::string& out, std::string_view text, std::string_view missing, Quotes quotes) {
    if (!can_be_quoted(text)) text = {};
    if (quotes == Quotes::where_needed && text.empty()) {
        out += missing;
    } else if (quotes == Quotes::always || text.find_first_of(" \t") != std::string_view::npos) {
        ((out += '"') += text) += '"';
    } else {
        out += text;
    }
}

/// Values that do not survive in a column of numbers or texts.
void tell_values(const PointSet& set, const Attribute& a, double no_data, std::string_view title, std::vector<Loss>& losses) {
    std::uint64_t taken = 0, unquotable = 0, trimmed_off = 0;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&a.values)) {
        for (const std::string& text : *texts) {
            if (!can_be_quoted(text)) ++unquotable;
            else if (trimmed(text) != text) ++trimmed_off;
        }
    } else {
        for (std::size_t i = 0; i < value_count(a); ++i) {
            const double v = value_as_double(a, i);
            if (v == no_data && !is_no_data(a, v)) ++taken;
        }
    }
    const auto lost = [&](LossClass c, std::string what, std::string why, std::uint64_t count) {
        if (count > 0) add_loss(losses, {c, set.info.name, std::move(what), std::move(why), count});
    };
    lost(LossClass::substance, "values " + number_text(no_data) + " of attribute '" + a.name + "'",
         "this value stands for missing in " + std::string(title), taken);
    lost(LossClass::substance, "texts of attribute '" + a.name + "'", "there are quotes or line ends in them", unquotable);
    lost(LossClass::style, "blanks around texts of attribute '" + a.name + "'", "texts are trimmed when they are read", trimmed_off);
}

constexpr std::string_view axis_names[] = {"x", "y", "z"};

class RowReader {
public:
    RowReader(const Input& input, TextCursor& cursor, const PointRows& rows, PointSet& set)
        : input_(&input), cursor_(&cursor), rows_(&rows), set_(&set) {
        first_ = set.info.attributes.size();
        for (const PointColumn& column : rows.columns) {
            if (column.kind > Kind::z) set.info.attributes.push_back(attribute_of(column, rows.no_data));
        }
    }

    std::optional<Failure> read_row();

private:
    std::string_view token(bool& given) {
        if (!rows_->quoted) {
            const std::string_view text = cursor_->token();
            given = !text.empty();
            return text;
        }
        bool quoted = false;
        const std::string_view text = cursor_->quoted_token(&quoted);
        given = quoted || !text.empty();
        return text;
    }
    Failure wrong_count(std::string_view found) const {
        return unreadable("F012", location_of(*input_, *cursor_, found),
                          "expected " + std::to_string(rows_->columns.size()) + " columns, found " + shown(found));
    }

    const Input* input_;
    TextCursor* cursor_;
    const PointRows* rows_;
    PointSet* set_;
    std::size_t first_ = 0;
};

std::optional<Failure> RowReader::read_row() {
    Vec3 p{};
    std::size_t attribute = first_;
    bool given = false;
    for (std::size_t c = 0; c < rows_->columns.size(); ++c) {
        const Kind kind = rows_->columns[c].kind;
        const std::string_view text = token(given);
        if (!given) {
            // Separators have three columns, whatever the rows have.
            if (rows_->separators && c == 3 && is_separator(p)) break;
            return wrong_count(text);
        }
        if (kind > Kind::z) {
            if (auto failed = add_value(*input_, *cursor_, *rows_, kind, text, set_->info.attributes[attribute++])) return failed;
            continue;
        }
        const auto axis = static_cast<std::size_t>(kind);
        if (auto failed = finite_number(*input_, *cursor_, text, axis_names[axis], p[axis])) return failed;
    }
    if (rows_->separators && attribute == first_ && is_separator(p)) {
        const auto next = static_cast<std::uint32_t>(set_->points.size());
        if (next > 0 && (set_->part_first.empty() || set_->part_first.back() != next)) set_->part_first.push_back(next);
        return std::nullopt;
    }
    if (const std::string_view more = token(given); given) return wrong_count(more);
    set_->points.push_back(file_position(p, rows_->sign));
    return std::nullopt;
}

}  // namespace

std::vector<PointColumn> plain_columns(std::size_t n) {
    std::vector<PointColumn> columns;
    for (std::size_t i = 0; i < n; ++i) {
        if (i < 3) columns.push_back({static_cast<Kind>(i), std::string(axis_names[i]), {}});
        else columns.push_back({Kind::real, "column " + std::to_string(i + 1), {}});
    }
    return columns;
}

std::optional<Failure> read_point_rows(const Input& input, TextCursor& cursor, const PointRows& rows, const Monitor* monitor,
                                       PointSet& set) {
    constexpr std::uint64_t often = 16384;
    RowReader reader(input, cursor, rows, set);
    while (cursor.next_line()) {
        if (cursor.line() % often == 0 && monitor != nullptr && monitor->stopped()) return stopped(input);
        if (cursor.at_line_end() || cursor.peek_rest().starts_with('#') || cursor.peek_rest().starts_with('!')) continue;
        if (set.points.size() >= no_index) return unreadable("F014", {input.name(), cursor.line()}, "expected fewer than 2^32 points");
        if (auto failed = reader.read_row()) return failed;
    }
    while (!set.part_first.empty() && set.part_first.back() >= set.points.size()) set.part_first.pop_back();
    return std::nullopt;
}

std::vector<WrittenColumn> columns_of(const PointSet& set, double no_data, std::string_view title, std::vector<Loss>& losses) {
    std::vector<WrittenColumn> columns;
    for (const Attribute& a : set.info.attributes) {
        if (a.location != AttributeLocation::point) continue;  // told with the other losses
        if (a.components == 0 || value_count(a) != std::size_t{a.components} * set.points.size()) {
            add_loss(losses, {LossClass::substance, set.info.name, "attribute '" + a.name + "'", "it has not one value per point"});
            continue;
        }
        const bool text = std::holds_alternative<std::vector<std::string>>(a.values);
        const bool real = std::holds_alternative<std::vector<double>>(a.values) || std::holds_alternative<std::vector<float>>(a.values);
        std::string name = a.name;
        if (trimmed(name).empty() || name.find_first_of("\n\r") != std::string::npos) {
            name = "attribute " + std::to_string(columns.size() + 1);
            add_loss(losses, {LossClass::identity, set.info.name, "name of an attribute", "it does not fit into a line"});
        }
        WrittenColumn column{name, text ? Kind::text : real ? Kind::real : Kind::integer, {}, &a, 0};
        for (const auto& [key, value] : a.annotations) {
            if (key == "horizon.type") column.type_word = value;
        }
        if (a.components > 1) {
            add_loss(losses, {LossClass::identity, set.info.name,
                              "attribute '" + a.name + "' as one of " + std::to_string(a.components) + " components (written as columns)",
                              std::string(title) + " have columns of one number"});
        }
        for (std::uint32_t c = 0; c < a.components; ++c) {
            column.component = c;
            if (a.components > 1) column.name = c < a.component_names.size() ? a.component_names[c] : name + "_" + std::to_string(c + 1);
            columns.push_back(column);
        }
        tell_values(set, a, no_data, title, losses);
    }
    return columns;
}

void append_value(std::string& text, const WrittenColumn& column, std::size_t point, std::string_view missing, Quotes quotes) {
    const Attribute& a = *column.attribute;
    const std::size_t i = point * a.components + column.component;
    std::visit(
        [&](const auto& values) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            if constexpr (std::is_same_v<Value, std::string>) {
                append_text(text, values[i], missing, quotes);
            } else {
                const auto v = static_cast<double>(values[i]);
                if (!std::isfinite(v) || is_no_data(a, v)) text += missing;
                else if constexpr (std::is_floating_point_v<Value>) append_number(text, values[i]);
                else if constexpr (std::is_signed_v<Value>) append_number(text, static_cast<std::int64_t>(values[i]));
                else append_number(text, static_cast<std::uint64_t>(values[i]));
            }
        },
        a.values);
}

Result<std::size_t> point_set_for_writing(const Dataset& dataset, std::string_view title) {
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        const auto* set = std::get_if<PointSet>(&dataset.objects[i]);
        if (set != nullptr && !set->points.empty()) return i;
    }
    return failure(FailureKind::cannot_hold, "F021", {},
                   std::string(title) + " hold one point set: there is none with points among the objects");
}

}  // namespace geomend::horizon
