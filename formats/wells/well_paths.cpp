// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/wells/well_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/wording.h"
#include "formats/drop.h"
#include "formats/text_reading.h"
#include "formats/wells/path_length.h"

namespace geomend::wells {

namespace {

enum class Column : std::uint8_t { well, measured_depth, x, y, elevation, depth, depth_below_bushing, other };

struct Named {
    Column column;
    std::string_view name;
};

/// Names of columns, in letters and digits alone.
constexpr std::array known_names{
    Named{Column::well, "WELL"},
    Named{Column::well, "WELLNAME"},
    Named{Column::well, "WELLBORE"},
    Named{Column::well, "NAME"},
    Named{Column::well, "BOREHOLE"},
    Named{Column::well, "UWI"},
    Named{Column::measured_depth, "MD"},
    Named{Column::measured_depth, "MDEPTH"},
    Named{Column::measured_depth, "MEASUREDDEPTH"},
    Named{Column::measured_depth, "MDMSL"},
    Named{Column::measured_depth, "MDRKB"},
    Named{Column::x, "X"},
    Named{Column::x, "XUTME"},
    Named{Column::x, "EASTING"},
    Named{Column::x, "XCOORD"},
    Named{Column::y, "Y"},
    Named{Column::y, "YUTMN"},
    Named{Column::y, "NORTHING"},
    Named{Column::y, "YCOORD"},
    Named{Column::elevation, "Z"},
    Named{Column::depth, "ZTVDSS"},
    Named{Column::depth, "TVDSS"},
    Named{Column::depth, "SSTVD"},
    Named{Column::depth, "TVDMSL"},
    Named{Column::depth_below_bushing, "TVD"},
};

/// A name of a column in capital letters and digits, without its unit in brackets.
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : upper_case(name.substr(0, name.find_first_of("([")))) {
        if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) plain += c;
    }
    return plain;
}

Column column_of(std::string_view name) {
    const std::string plain = plain_name(name);
    const auto found = std::ranges::find(known_names, plain, &Named::name);
    return found == known_names.end() ? Column::other : found->column;
}

std::string_view unquoted(std::string_view text) {
    text = trimmed(text);
    const bool quotes = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
    return quotes ? trimmed(text.substr(1, text.size() - 2)) : text;
}

/// The fields of a line: between separators, or, where that is a blank, words.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    if (separator == ' ') {
        TextCursor cursor(line);
        cursor.next_line();
        bool quoted = false;
        for (std::string_view t = cursor.quoted_token(&quoted); !t.empty() || quoted; t = cursor.quoted_token(&quoted)) fields.push_back(t);
        return fields;
    }
    for (;;) {
        const std::size_t end = line.find(separator);
        fields.push_back(unquoted(line.substr(0, end)));
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end + 1);
    }
}

char separator_of(std::string_view names) {
    for (const char c : {';', ',', '\t'}) {
        if (names.find(c) != std::string_view::npos) return c;
    }
    return ' ';
}

struct Table {
    char separator = ' ';
    std::vector<Column> columns;
    std::vector<std::string> names;

    bool has(Column c) const { return std::ranges::find(columns, c) != columns.end(); }
    bool has_positions() const {
        return has(Column::x) && has(Column::y) && (has(Column::elevation) || has(Column::depth) || has(Column::depth_below_bushing));
    }
    bool is_path() const { return has(Column::measured_depth) && has_positions(); }
};

/// The columns that a line names; none where it holds a number.
std::optional<Table> table_of(std::string_view line) {
    line = trimmed(line);
    Table table;
    table.separator = separator_of(line);
    for (const std::string_view name : fields_of(line, table.separator)) {
        double value = 0;
        if (parse_real(name, value) == NumberStatus::ok) return std::nullopt;
        if (table.separator == ' ' && (name.starts_with('(') || name.starts_with('['))) continue;  // a unit behind its name
        Column c = column_of(name);
        const bool again = c != Column::other && table.has(c);
        if (again) c = Column::other;
        table.columns.push_back(c);
        table.names.emplace_back(name);
    }
    return table;
}

/// "WELLNAME: A" or "name A": what ResInsight puts before a path.
std::optional<std::string_view> name_line(std::string_view line) {
    line = trimmed(line);
    for (const std::string_view key : {"wellname:", "wellname", "name"}) {
        if (line.size() <= key.size() || !same_word(line.substr(0, key.size()), key)) continue;
        const std::string_view rest = line.substr(key.size());
        if (!key.ends_with(':') && rest.front() != ' ' && rest.front() != '\t' && rest.front() != ':') continue;
        const std::size_t begin = rest.find_first_not_of(" \t:");
        if (begin != std::string_view::npos && separator_of(rest) == ' ') return unquoted(rest.substr(begin));
    }
    return std::nullopt;
}

/// How the numbers of a column Z go with those of a column of depths, row by row.
struct ZAgainstDepths {
    std::uint64_t rows = 0, not_elevation = 0, not_depth = 0;  ///< where Z is not minus the depth; where it is not the depth
    std::uint64_t first_line = 0;                              ///< of a row where it is not minus the depth

    /// Whether Z is a depth in all rows, and no elevation in some.
    bool says_depth() const { return not_elevation > 0 && not_depth == 0; }

    /// \param below_sea depth below the level from which Z counts
    /// \param below_bushing depth below a point at an unknown height: only its steps from the first row count
    void add(double z, std::optional<double> below_sea, std::optional<double> below_bushing, std::uint64_t line) {
        if (!below_sea && !below_bushing) return;
        const bool is_first = rows++ == 0;
        if (is_first) first_ = {z, below_bushing.value_or(0)};
        const double height = below_sea ? z : z - first_[0], depth = below_sea ? *below_sea : *below_bushing - first_[1];
        const double granted = 0.05 + 1e-4 * std::abs(depth);  // both are rounded
        if (std::abs(height - depth) > granted) ++not_depth;
        if (std::abs(height + depth) <= granted) return;
        if (not_elevation++ == 0) first_line = line;
    }

private:
    std::array<double, 2> first_{};
};

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options, std::optional<ZPositive> sign)
        : input_(input), options_(options), sign_(sign), cursor_(text_of(input)) {
        table_.columns = {Column::x, Column::y, Column::depth, Column::measured_depth};  // of ResInsight, which names none
        table_.names = {"X", "Y", "TVDMSL", "MD"};
    }

    Result<Dataset> run() {
        data_.format = "well";
        data_.variant = "well paths";
        constexpr std::uint64_t often = 16384;
        while (cursor_.next_line()) {
            if (cursor_.line() % often == 0 && options_.monitor != nullptr && options_.monitor->stopped()) return stopped(input_);
            if (cursor_.at_line_end()) continue;
            if (auto failed = take_line(trimmed(cursor_.line_text()))) return std::move(*failed);
        }
        finish_well();
        if (data_.objects.empty()) return unreadable("F017", {input_.name(), cursor_.line()}, "expected points of a well path, found none");
        tell_missing_line_end(input_, data_);
        return std::move(data_);
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    std::optional<ZPositive> sign_;
    TextCursor cursor_;
    Dataset data_;
    Table table_;
    bool named_columns_ = false;
    Well well_;
    std::vector<std::vector<double>> others_;  ///< per further column
    std::uint64_t texts_ = 0;
    ZAgainstDepths heights_;

    Failure malformed(const std::string& expected, std::string_view found) const {
        return unreadable("F012", location_of(input_, cursor_, found), "expected " + expected + ", found " + shown(found));
    }

    std::optional<Failure> take_line(std::string_view line) {
        if (line.starts_with('#') || line.starts_with('!')) {
            take_comment(line);
            return std::nullopt;
        }
        if (line.find_first_not_of("=-") == std::string_view::npos) return std::nullopt;  // a ruler
        auto table = table_of(line);
        if (table && table->has_positions()) return take_names(std::move(*table));
        if (const auto name = name_line(line); name && !table_.has(Column::well)) {
            finish_well();
            well_.info.name = *name;
            return std::nullopt;
        }
        if (line == "-999") {
            finish_well();
            return std::nullopt;
        }
        if (table && well_.path.empty() && !named_columns_) return take_names(std::move(*table));
        return take_row(line);
    }

    void take_comment(std::string_view line) {
        const auto fact = [&](std::string_view key) -> std::string_view {
            const std::string_view text = trimmed(line.substr(1));
            return same_word(text.substr(0, key.size()), key) ? trimmed(text.substr(key.size())) : std::string_view();
        };
        const auto number = [&](std::string_view text, double& to) {
            TextCursor words(text);
            double value = 0;
            if (words.next_line() && words.real(value) == NumberStatus::ok && std::isfinite(value)) to = value;
        };
        if (const auto name = fact("WELL NAME:"); !name.empty()) well_.info.name = name;
        else if (const auto x = fact("WELL HEAD X-COORDINATE:"); !x.empty()) number(x, well_.head[0]);
        else if (const auto y = fact("WELL HEAD Y-COORDINATE:"); !y.empty()) number(y, well_.head[1]);
        else if (const auto kb = fact("WELL DATUM (KB, Kelly bushing, from MSL):"); !kb.empty()) number(kb, well_.kelly_bushing);
        else if (const auto table = table_of(line.substr(1)); table && table->has_positions()) static_cast<void>(take_names(*table));
        else if (line.find_first_not_of("#=-! ") != std::string_view::npos)
            well_.info.annotations.push_back({"well.comment", std::string(line)});
    }

    std::optional<Failure> take_names(Table table) {
        if (!table.has_positions()) {
            if (table.has(Column::measured_depth))
                return unreadable("F013", {input_.name(), cursor_.line()},
                                  "surveys of angles without positions (X, Y and Z or TVD) are not read");
            return malformed("names of columns with X, Y and Z, TVD or TVDSS", trimmed(cursor_.line_text()));
        }
        if (!well_.path.empty()) finish_well();
        table_ = std::move(table);
        named_columns_ = true;
        return std::nullopt;
    }

    std::optional<Failure> take_row(std::string_view line) {
        const auto fields = fields_of(line, table_.separator);
        if (fields.size() != table_.columns.size()) return malformed(std::to_string(table_.columns.size()) + " columns", line);
        for (std::size_t c = 0; c < fields.size(); ++c) {
            if (table_.columns[c] == Column::well && !fields[c].empty() && fields[c] != well_.info.name) {
                finish_well();
                well_.info.name = fields[c];
            }
        }
        if (well_.path.size() >= no_index) return unreadable("F014", {input_.name(), cursor_.line()}, "expected fewer than 2^32 points");
        others_.resize(static_cast<std::size_t>(std::ranges::count(table_.columns, Column::other)));
        Vec3 p{};
        std::size_t other = 0;
        const bool below_bushing = !table_.has(Column::elevation) && !table_.has(Column::depth);
        std::optional<double> below_sea, under_bushing, measured;
        for (std::size_t c = 0; c < fields.size(); ++c) {
            const Column column = table_.columns[c];
            if (column == Column::well) continue;
            if (column == Column::other || (column == Column::depth_below_bushing && !below_bushing)) {
                double depth = 0;
                if (column == Column::other) others_[other++].push_back(further_value(fields[c]));
                else if (parse_real(fields[c], depth) == NumberStatus::ok) under_bushing = depth;
                continue;
            }
            double value = 0;
            if (auto failed = finite_number(input_, cursor_, fields[c], "a number for '" + table_.names[c] + "'", value)) return failed;
            switch (column) {
                case Column::x:
                    p[0] = value;
                    break;
                case Column::y:
                    p[1] = value;
                    break;
                case Column::elevation:
                    p[2] = sign_ == ZPositive::depth ? -value : value;
                    break;
                case Column::depth:
                    below_sea = value;
                    break;
                case Column::depth_below_bushing:
                    p[2] = well_.kelly_bushing - value;
                    break;
                default:
                    measured = value;
                    break;
            }
        }
        if (below_sea && !table_.has(Column::elevation)) p[2] = -*below_sea;
        if (table_.has(Column::elevation)) heights_.add(sign_ == ZPositive::depth ? -p[2] : p[2], below_sea, under_bushing, cursor_.line());
        well_.path.push_back(p);
        if (measured) well_.measured_depth.push_back(*measured);
        return std::nullopt;
    }

    double further_value(std::string_view text) {
        double value = 0;
        if (parse_real(text, value) == NumberStatus::ok && std::isfinite(value)) return value;
        if (!text.empty() && !same_word(text, "nan") && !same_word(text, "null")) ++texts_;
        return std::numeric_limits<double>::quiet_NaN();
    }

    /// Puts the well that was read into the dataset. Its name and facts stand before its rows.
    void finish_well() {
        if (well_.path.empty()) {
            well_.info.annotations.clear();
            return;
        }
        if (well_.info.name.empty()) well_.info.name = name_of(input_);
        if (well_.head[0] == 0 && well_.head[1] == 0) well_.head = {well_.path.front()[0], well_.path.front()[1], 0};
        const bool turned = !sign_ && heights_.says_depth();
        if (turned) {
            for (Vec3& p : well_.path) p[2] = -p[2];
        }
        report_heights(turned);
        const bool depth = !table_.has(Column::elevation) || sign_ == ZPositive::depth || turned;
        well_.info.crs.z_positive = depth ? ZPositive::depth : ZPositive::elevation;
        well_.info.crs.z_positive_stated = true;
        const std::vector<double> depths = well_.measured_depth.empty() ? lengths_along(well_.path) : well_.measured_depth;
        std::size_t other = 0;
        for (std::size_t c = 0; c < table_.columns.size(); ++c) {
            if (table_.columns[c] != Column::other || other >= others_.size()) continue;
            Attribute a;
            a.name = table_.names[c];
            a.no_data = std::ranges::find(others_[other], -999.25) != others_[other].end() ? -999.25 : -999;
            a.values = std::move(others_[other++]);
            well_.curves.push_back({depths, std::move(a)});
        }
        if (texts_ > 0)
            drop(data_.findings, data_.losses,
                 {.entity = well_.info.name,
                  .what = "texts in columns of the table",
                  .why = "logs hold numbers",
                  .count = texts_,
                  .where = {input_.name()}});
        data_.objects.emplace_back(std::move(well_));
        well_ = {};
        others_.clear();
        texts_ = 0;
        heights_ = {};
    }

    /// F113 where Z was taken as depth, or says something else than the column of depths.
    void report_heights(bool turned) {
        if (sign_) return;  // the user has said so
        const std::uint64_t wrong = turned ? 0 : heights_.not_elevation;
        if (wrong == 0 && !turned) return;
        std::string message = turned ? "column Z is the depth that another column states: it is taken as positive downwards; --option "
                                       "z=elevation takes it as it stands"
                                     : "Z and the column of depths disagree at " + counted(wrong, "point", "points") +
                                           ": Z is taken, as elevation; --option z=depth takes it as depth";
        Finding f = make_finding("F113", std::move(message), {input_.name(), heights_.first_line}, turned ? heights_.not_elevation : wrong);
        f.entities.push_back({"well", well_.info.name});
        data_.findings.push_back(std::move(f));
    }
};

Result<std::optional<ZPositive>> asked_sign(const FormatOptions& options) {
    const std::string_view word = option_value(options, "z");
    if (word.empty()) return std::optional<ZPositive>{};
    if (same_word(word, "depth")) return std::optional{ZPositive::depth};
    if (same_word(word, "elevation")) return std::optional{ZPositive::elevation};
    return failure(FailureKind::usage, "F018", {}, "option z: expected depth or elevation, found " + shown(word));
}

}  // namespace

int sniff_well_paths(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (line.empty()) continue;
        if (line.starts_with("# WELL TRACE FROM PETREL")) return 98;
        const bool comment = line.starts_with('#');
        const auto table = table_of(comment ? line.substr(1) : line);
        if (table && table->is_path()) return 80;
        if (const auto name = name_line(line)) return line.find(':') != std::string_view::npos ? 80 : 0;
        if (!comment) return 0;
    }
    return 0;
}

Result<Dataset> read_well_paths(const Input& input, const ReadOptions& options) {
    const auto sign = asked_sign(options.options);
    if (!sign) return sign.why();
    return Reader(input, options, *sign).run();
}

}  // namespace geomend::wells
