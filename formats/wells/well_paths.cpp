// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/wells/well_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/table_fields.h"
#include "base/wording.h"
#include "formats/drop.h"
#include "formats/text_reading.h"
#include "formats/wells/path_length.h"

namespace geomend::wells {

namespace {

enum class Column : std::uint8_t { well, measured_depth, x, y, elevation, depth, depth_below_bushing, bushing, other };

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
    Named{Column::bushing, "KB"},
    Named{Column::bushing, "RKB"},
    Named{Column::bushing, "KBELEVATION"},
    Named{Column::bushing, "KELLYBUSHING"},
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

// Some write names in single quotes.
std::string_view unquoted(std::string_view text) {
    text = without_quotes(text);
    const bool quotes = text.size() >= 2 && text.front() == '\'' && text.back() == '\'';
    return quotes ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::vector<std::string_view> path_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields = fields_of(line, separator);
    for (std::string_view& field : fields) field = unquoted(field);
    return fields;
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
    for (const std::string_view name : path_fields(line, table.separator)) {
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

/// What exports put where a position is missing; -999 is no elevation of note either, but Z may well be that.
bool is_missing(double value, Column column) { return value == -999.25 || (value == -999 && column != Column::elevation); }

/// A well whose rows are being read.
struct OpenWell {
    Well well;
    std::vector<std::vector<double>> others;       ///< per further column
    std::uint64_t texts = 0;                       ///< fields of these that are no numbers
    std::uint64_t missing = 0, first_missing = 0;  ///< rows without a position, and the line of the first
    ZAgainstDepths heights;
    bool has_bushing = false;  ///< its height is stated
    std::uint64_t first_line = 0;
};

/// One row of a table.
struct Row {
    Vec3 position{};
    std::optional<double> measured, below_sea, under_bushing, bushing;
    std::string_view well;
    std::vector<double> others;
    std::uint64_t texts = 0;
    bool is_missing = false;  ///< its position
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
        finish_wells();
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
    std::deque<OpenWell> open_ = std::deque<OpenWell>(1);  ///< in the order of their first rows; rows of wells may take turns
    OpenWell* at_ = &open_.front();                        ///< the one that rows go to

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
            finish_wells();
            at_->well.info.name = *name;
            return std::nullopt;
        }
        if (line == "-999") {
            finish_wells();
            return std::nullopt;
        }
        if (table && at_->well.path.empty() && !named_columns_) return take_names(std::move(*table));
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
            const bool good = words.next_line() && words.real(value) == NumberStatus::ok && std::isfinite(value);
            if (good) to = value;
            return good;
        };
        const auto bushing = [&]() -> std::string_view {
            for (const std::string_view key : {"WELL DATUM (KB, Kelly bushing, from MSL):", "WELL KB:", "KB:"}) {
                if (const auto text = fact(key); !text.empty()) return text;
            }
            return {};
        };
        Well& well = at_->well;
        if (const auto name = fact("WELL NAME:"); !name.empty()) {
            finish_wells();
            at_->well.info.name = name;
        } else if (const auto x = fact("WELL HEAD X-COORDINATE:"); !x.empty()) {
            number(x, well.head[0]);
        } else if (const auto y = fact("WELL HEAD Y-COORDINATE:"); !y.empty()) {
            number(y, well.head[1]);
        } else if (const auto kb = bushing(); !kb.empty()) {
            at_->has_bushing = number(kb, well.kelly_bushing) || at_->has_bushing;
        } else if (const auto table = table_of(line.substr(1)); table && table->has_positions()) {
            static_cast<void>(take_names(*table));
        } else if (line.find_first_not_of("#=-! ") != std::string_view::npos) {
            well.info.annotations.push_back({"well.comment", std::string(line)});
        }
    }

    std::optional<Failure> take_names(Table table) {
        if (!table.has_positions()) {
            if (table.has(Column::measured_depth))
                return unreadable("F013", {input_.name(), cursor_.line()},
                                  "surveys of angles without positions (X, Y and Z or TVD) are not read");
            return malformed("names of columns with X, Y and Z, TVD or TVDSS", trimmed(cursor_.line_text()));
        }
        if (!at_->well.path.empty() || at_->missing > 0) finish_wells();
        table_ = std::move(table);
        named_columns_ = true;
        return std::nullopt;
    }

    std::optional<Failure> take_row(std::string_view line) {
        const auto fields = path_fields(line, table_.separator);
        if (fields.size() != table_.columns.size()) return malformed(std::to_string(table_.columns.size()) + " columns", line);
        auto row = row_of(fields);
        if (!row) return std::move(row).why();
        select(*row);
        if (at_->well.path.size() >= no_index)
            return unreadable("F014", {input_.name(), cursor_.line()}, "expected fewer than 2^32 points");
        add(*row);
        return std::nullopt;
    }

    bool is_below_bushing() const { return !table_.has(Column::elevation) && !table_.has(Column::depth); }

    Result<Row> row_of(std::span<const std::string_view> fields) {
        Row row;
        for (std::size_t c = 0; c < fields.size(); ++c) {
            const Column column = table_.columns[c];
            double value = 0;
            if (column == Column::well) {
                row.well = fields[c];
                continue;
            }
            if (column == Column::other) {
                row.others.push_back(further_value(fields[c], row.texts));
                continue;
            }
            if (column == Column::bushing || (column == Column::depth_below_bushing && !is_below_bushing())) {
                if (parse_real(fields[c], value) != NumberStatus::ok || !std::isfinite(value)) continue;
                (column == Column::bushing ? row.bushing : row.under_bushing) = value;
                continue;
            }
            if (auto failed = finite_number(input_, cursor_, fields[c], "a number for '" + table_.names[c] + "'", value))
                return std::move(*failed);
            if (column != Column::measured_depth && is_missing(value, column)) row.is_missing = true;
            if (column == Column::x) row.position[0] = value;
            else if (column == Column::y) row.position[1] = value;
            else if (column == Column::elevation) row.position[2] = sign_ == ZPositive::depth ? -value : value;
            else if (column == Column::depth) row.below_sea = value;
            else if (column == Column::depth_below_bushing) row.under_bushing = value;
            else row.measured = value;
        }
        return row;
    }

    /// Makes the well of a row the one at hand: of those that are open that of its name, whose measured depths go on; else a new one.
    void select(const Row& row) {
        if (row.well.empty() || row.well == at_->well.info.name) return;
        const bool is_fresh = at_->well.path.empty() && at_->missing == 0;
        if (!is_fresh) {
            const auto goes_on = [&](const OpenWell& open) {
                const auto& depths = open.well.measured_depth;
                return open.well.info.name == row.well && row.measured && (depths.empty() || *row.measured > depths.back());
            };
            const auto known = std::ranges::find_if(open_, goes_on);
            at_ = known != open_.end() ? &*known : &open_.emplace_back();
        }
        at_->well.info.name = row.well;
    }

    void add(const Row& row) {
        Well& well = at_->well;
        if (at_->first_line == 0) at_->first_line = cursor_.line();
        if (row.is_missing) {
            if (at_->missing++ == 0) at_->first_missing = cursor_.line();
            return;
        }
        if (row.bushing) {
            well.kelly_bushing = *row.bushing;
            at_->has_bushing = true;
        }
        Vec3 p = row.position;
        if (table_.has(Column::elevation))
            at_->heights.add(sign_ == ZPositive::depth ? -p[2] : p[2], row.below_sea, row.under_bushing, cursor_.line());
        else p[2] = row.below_sea ? -*row.below_sea : well.kelly_bushing - row.under_bushing.value_or(0);
        well.path.push_back(p);
        if (row.measured) well.measured_depth.push_back(*row.measured);
        at_->others.resize(row.others.size());
        for (std::size_t k = 0; k < row.others.size(); ++k) at_->others[k].push_back(row.others[k]);
        at_->texts += row.texts;
    }

    static double further_value(std::string_view text, std::uint64_t& texts) {
        double value = 0;
        if (parse_real(text, value) == NumberStatus::ok && std::isfinite(value)) return value;
        if (!text.empty() && !same_word(text, "nan") && !same_word(text, "null")) ++texts;
        return std::numeric_limits<double>::quiet_NaN();
    }

    /// Puts the wells that were read into the dataset, and begins a new one. Names and facts of a well stand before its rows.
    void finish_wells() {
        for (OpenWell& open : open_) finish(open);
        open_.clear();
        at_ = &open_.emplace_back();
    }

    void finish(OpenWell& open) {
        Well& well = open.well;
        if (well.info.name.empty()) well.info.name = name_of(input_);
        if (open.missing > 0)
            drop(data_.findings, data_.losses,
                 {.entity = well.info.name,
                  .what = "rows without a position",
                  .why = "x, y or the depth is -999 or -999.25, which stands for none",
                  .count = open.missing,
                  .where = {input_.name(), open.first_missing}});
        if (well.path.empty()) return;
        if (well.head[0] == 0 && well.head[1] == 0) well.head = {well.path.front()[0], well.path.front()[1], 0};
        const bool turned = !sign_ && open.heights.says_depth();
        if (turned) {
            for (Vec3& p : well.path) p[2] = -p[2];
        }
        report_heights(open, turned);
        report_bushing(open);
        const bool depth = !table_.has(Column::elevation) || sign_ == ZPositive::depth || turned;
        well.info.crs.z_positive = depth ? ZPositive::depth : ZPositive::elevation;
        well.info.crs.z_positive_stated = true;
        add_curves(open);
        if (open.texts > 0)
            drop(data_.findings, data_.losses,
                 {.entity = well.info.name,
                  .what = "texts in columns of the table",
                  .why = "logs hold numbers",
                  .count = open.texts,
                  .where = {input_.name()}});
        data_.objects.emplace_back(std::move(well));
    }

    void add_curves(OpenWell& open) {
        Well& well = open.well;
        const std::vector<double> depths = well.measured_depth.empty() ? lengths_along(well.path) : well.measured_depth;
        std::size_t other = 0;
        for (std::size_t c = 0; c < table_.columns.size(); ++c) {
            if (table_.columns[c] != Column::other || other >= open.others.size()) continue;
            Attribute a;
            a.name = table_.names[c];
            a.no_data = std::ranges::find(open.others[other], -999.25) != open.others[other].end() ? -999.25 : -999;
            a.values = std::move(open.others[other++]);
            well.curves.push_back({depths, std::move(a)});
        }
    }

    /// F113 where depths count from the kelly bushing, and nothing says how high that is.
    void report_bushing(const OpenWell& open) {
        if (!is_below_bushing() || open.has_bushing) return;
        Finding f = make_finding("F113",
                                 "TVD is depth below the kelly bushing, and no comment (# WELL KB: 25) and no column KB says how high that "
                                 "is: it is taken as 0, so that depths are those below the bushing",
                                 {input_.name(), open.first_line}, open.well.path.size());
        f.entities.push_back({"well", open.well.info.name});
        data_.findings.push_back(std::move(f));
    }

    /// F113 where Z was taken as depth, or says something else than the column of depths.
    void report_heights(const OpenWell& open, bool turned) {
        if (sign_) return;  // the user has said so
        const ZAgainstDepths& heights = open.heights;
        const std::uint64_t wrong = turned ? 0 : heights.not_elevation;
        if (wrong == 0 && !turned) return;
        std::string message = turned ? "column Z is the depth that another column states: it is taken as positive downwards; --option "
                                       "z=elevation takes it as it stands"
                                     : "Z and the column of depths disagree at " + counted(wrong, "point", "points") +
                                           ": Z is taken, as elevation; --option z=depth takes it as depth";
        Finding f = make_finding("F113", std::move(message), {input_.name(), heights.first_line}, turned ? heights.not_elevation : wrong);
        f.entities.push_back({"well", open.well.info.name});
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
