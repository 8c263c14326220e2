// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/named_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/table_fields.h"
#include "formats/drop.h"
#include "formats/horizon/common.h"
#include "formats/horizon/ijxyz_map.h"
#include "formats/horizon/point_table.h"
#include "formats/horizon/polylines.h"

namespace geomend::horizon {

namespace {

enum class Meaning : std::uint8_t { attribute, line, x, y, z, depth, inline_number, crossline_number };

struct KnownName {
    std::string_view name;  ///< in capital letters and digits alone
    Meaning meaning;
};

constexpr std::array known_names{KnownName{"X", Meaning::x},
                                 KnownName{"XUTME", Meaning::x},
                                 KnownName{"EASTING", Meaning::x},
                                 KnownName{"XCOORD", Meaning::x},
                                 KnownName{"CDPX", Meaning::x},
                                 KnownName{"Y", Meaning::y},
                                 KnownName{"YUTMN", Meaning::y},
                                 KnownName{"NORTHING", Meaning::y},
                                 KnownName{"YCOORD", Meaning::y},
                                 KnownName{"CDPY", Meaning::y},
                                 KnownName{"Z", Meaning::z},
                                 KnownName{"ELEVATION", Meaning::z},
                                 KnownName{"ZCOORD", Meaning::z},
                                 KnownName{"ZTVDSS", Meaning::depth},
                                 KnownName{"TVDSS", Meaning::depth},
                                 KnownName{"DEPTH", Meaning::depth},
                                 KnownName{"POLYID", Meaning::line},
                                 KnownName{"POLYGONID", Meaning::line},
                                 KnownName{"LINEID", Meaning::line},
                                 KnownName{"SEGID", Meaning::line},
                                 KnownName{"SEGMENTID", Meaning::line},
                                 KnownName{"I", Meaning::inline_number},
                                 KnownName{"IL", Meaning::inline_number},
                                 KnownName{"ILINE", Meaning::inline_number},
                                 KnownName{"INLINE", Meaning::inline_number},
                                 KnownName{"J", Meaning::crossline_number},
                                 KnownName{"XL", Meaning::crossline_number},
                                 KnownName{"XLINE", Meaning::crossline_number},
                                 KnownName{"CROSSLINE", Meaning::crossline_number}};

Meaning meaning_of(std::string_view name) {
    std::string plain;
    for (const char c : upper_case(name.substr(0, name.find_first_of("([")))) {
        if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) plain += c;
    }
    const auto found = std::ranges::find(known_names, plain, &KnownName::name);
    return found == known_names.end() ? Meaning::attribute : found->meaning;
}

bool is_remark(std::string_view line) { return line.empty() || line.starts_with('#') || line.starts_with('!'); }

struct TableHead {
    char separator = ' ';
    std::vector<std::string> names;
    std::vector<Meaning> meanings;

    bool has(Meaning m) const { return std::ranges::find(meanings, m) != meanings.end(); }
    bool has_positions() const { return has(Meaning::x) && has(Meaning::y) && (has(Meaning::z) || has(Meaning::depth)); }
    /// Whether each row is a point of the line that a column names, and no further column has values of its own.
    bool has_polylines() const { return has(Meaning::line) && !has(Meaning::attribute) && !has(Meaning::inline_number); }
    bool has_lines() const { return has(Meaning::inline_number) && has(Meaning::crossline_number); }
};

/// The names in a line; none where a number is among them.
std::optional<TableHead> head_of(std::string_view line) {
    TableHead head;
    head.separator = separator_of(line);
    for (const std::string_view name : fields_of(line, head.separator)) {
        double value = 0;
        if (parse_real(name, value) == NumberStatus::ok) return std::nullopt;
        Meaning m = meaning_of(name);
        const bool again = m != Meaning::attribute && head.has(m);
        if (again || (m == Meaning::depth && head.has(Meaning::z)) || (m == Meaning::z && head.has(Meaning::depth))) m = Meaning::attribute;
        head.names.emplace_back(name);
        head.meanings.push_back(m);
    }
    return head;
}

bool is_missing(std::string_view field) {
    return field.empty() || same_word(field, "nan") || same_word(field, "null") || same_word(field, "undef") || same_word(field, "n/a");
}

/// The values of a column in the narrowest type that holds all of them: whole numbers, numbers, else texts.
Attribute attribute_of(const std::string& name, const std::vector<std::string_view>& fields) {
    Attribute a;
    a.name = name;
    std::vector<std::int32_t> whole;
    std::vector<double> real;
    bool all_whole = true, all_real = true;
    for (const std::string_view field : fields) {
        std::int64_t n = 0;
        double v = std::numeric_limits<double>::quiet_NaN();
        all_whole = all_whole && parse_integer(field, n) == NumberStatus::ok && n == static_cast<std::int32_t>(n);
        all_real = all_real && (is_missing(field) || (parse_real(field, v) == NumberStatus::ok && std::isfinite(v)));
        if (!all_real) break;
        if (all_whole) whole.push_back(static_cast<std::int32_t>(n));
        real.push_back(v);
    }
    if (all_whole && whole.size() == fields.size()) a.values = std::move(whole);
    else if (all_real) a.values = std::move(real);
    else a.values = std::vector<std::string>(fields.begin(), fields.end());
    return a;
}

class TableReader {
public:
    TableReader(const Input& input, const ReadOptions& options, TableHead head, std::optional<ZPositive> sign)
        : input_(input), options_(options), head_(std::move(head)), sign_(sign), columns_(head_.names.size()) {}

    Result<Dataset> run(TextCursor cursor) {
        constexpr std::uint64_t often = 16384;
        while (cursor.next_line()) {
            if (cursor.line() % often == 0 && options_.monitor != nullptr && options_.monitor->stopped()) return stopped(input_);
            if (is_remark(trimmed(cursor.line_text()))) continue;
            if (auto failed = read_row(cursor)) return std::move(*failed);
        }
        if (points_.empty()) return unreadable("F017", {input_.name(), cursor.line()}, "expected points, found none");
        Dataset data = head_.has_polylines() ? lines() : head_.has_lines() ? map_or_points() : points_alone();
        tell_missing_line_end(input_, data);
        return data;
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    TableHead head_;
    std::optional<ZPositive> sign_;
    std::vector<std::vector<std::string_view>> columns_;  ///< of attributes
    std::vector<Vec3> points_;
    std::vector<LineSample> samples_;

    bool is_depth() const { return sign_ ? *sign_ == ZPositive::depth : head_.has(Meaning::depth); }

    std::optional<Failure> read_row(TextCursor& cursor) {
        const auto fields = fields_of(trimmed(cursor.line_text()), head_.separator);
        if (fields.size() != head_.names.size())
            return unreadable("F012", {input_.name(), cursor.line(), 1},
                              "expected " + std::to_string(head_.names.size()) + " columns, found " + std::to_string(fields.size()));
        if (points_.size() >= no_index) return unreadable("F014", {input_.name(), cursor.line()}, "expected fewer than 2^32 points");
        Vec3 p{};
        LineSample sample;
        for (std::size_t c = 0; c < fields.size(); ++c) {
            const Meaning m = head_.meanings[c];
            if (m == Meaning::attribute || m == Meaning::line) {
                columns_[c].push_back(fields[c]);
            } else if (m >= Meaning::inline_number) {
                double number = 0;
                if (auto failed = finite_number(input_, cursor, fields[c], "a number of a line", number)) return failed;
                if (number != std::floor(number) || std::abs(number) > 1e9)
                    return unreadable("F005", location_of(input_, cursor, fields[c]),
                                      "expected the number of a line, found " + shown(fields[c]));
                (m == Meaning::inline_number ? sample.i : sample.j) = static_cast<std::int64_t>(number);
                columns_[c].push_back(fields[c]);
            } else {
                const std::size_t axis = m == Meaning::x ? 0 : m == Meaning::y ? 1 : 2;
                if (auto failed = finite_number(input_, cursor, fields[c], "a number for '" + head_.names[c] + "'", p[axis])) return failed;
            }
        }
        if (is_depth()) p[2] = -p[2];
        points_.push_back(p);
        sample.position = p;
        samples_.push_back(sample);
        return std::nullopt;
    }

    void describe(ObjectInfo& info) const {
        info.name = name_of(input_);
        info.crs.z_positive = is_depth() ? ZPositive::depth : ZPositive::elevation;
        info.crs.z_positive_stated = sign_.has_value() || head_.has(Meaning::depth);
    }

    Dataset points_alone() {
        PointSet set;
        describe(set.info);
        set.points = std::move(points_);
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            if (head_.meanings[c] <= Meaning::line || head_.meanings[c] >= Meaning::inline_number)
                set.info.attributes.push_back(attribute_of(head_.names[c], columns_[c]));
        }
        return dataset_of("points as a table", std::move(set));
    }

    /// Rows one after the other with the same word in the column of lines are a line.
    Dataset lines() {
        PolylineSet set;
        describe(set.info);
        const auto column = static_cast<std::size_t>(std::ranges::find(head_.meanings, Meaning::line) - head_.meanings.begin());
        const auto& names = columns_[column];
        for (std::size_t first = 0, end = 0; first < names.size(); first = end) {
            while (end < names.size() && names[end] == names[first]) ++end;
            add_line(set, std::string(names[first]), std::span(points_).subspan(first, end - first));
        }
        return dataset_of("lines as a table", std::move(set));
    }

    Dataset map_or_points() {
        std::string why;
        auto map = lattice_of_samples(samples_, why);
        if (!map) {
            Dataset data = points_alone();
            data.findings.push_back(
                make_finding("F113", "the numbers of lines are no lattice (" + why + "): the map is read as points", {input_.name()}));
            return data;
        }
        describe(map->raster.info);
        Dataset data = dataset_of("map by lines (IJXYZ)", std::move(map->raster));
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            if (head_.meanings[c] <= Meaning::line)
                drop(data.findings, data.losses,
                     {.what = "column '" + head_.names[c] + "'",
                      .why = "a map by lines has its heights alone",
                      .count = columns_[c].size(),
                      .where = {input_.name()}});
        }
        list_dropped(data.losses, {LossClass::identity, "", "numbers of inlines and crosslines", "a raster counts its samples"});
        double largest = 0;
        for (const LineSample& s : samples_) largest = std::max({largest, std::abs(s.position[0]), std::abs(s.position[1])});
        if (map->moved > 4 * std::numeric_limits<double>::epsilon() * largest)
            list_dropped(data.losses, {LossClass::identity, "", "digits of x and y",
                                       "the lattice is up to " + number_text(map->moved) + " away from them"});
        return data;
    }
};

}  // namespace

int sniff_named_points(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (is_remark(line)) continue;
        const auto names = head_of(line);
        return names && names->has_positions() ? 70 : 0;
    }
    return 0;
}

Result<Dataset> read_named_points(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    TextCursor cursor(text_of(input));
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (is_remark(line)) continue;
        auto head = head_of(line);
        if (!head || !head->has_positions())
            return unreadable("F012", {input.name(), cursor.line(), 1},
                              "expected a line with the names of the columns, X, Y and Z among them, found " + shown(line));
        return TableReader(input, options, std::move(*head), *sign).run(cursor);
    }
    return unreadable("F017", {input.name(), cursor.line()}, "expected points, found none");
}

int sniff_ijxyz(std::string_view head, std::string_view base_name) {
    if (!lower_case(base_name).ends_with(".ijxyz")) return 0;  // any table of five numbers might be one
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (is_remark(line)) continue;
        return fields_of(line, separator_of(line)).size() == 5 ? 40 : 0;
    }
    return 0;
}

Result<Dataset> read_ijxyz(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    TableHead head;
    head.names = {"I", "J", "X", "Y", "Z"};
    head.meanings = {Meaning::inline_number, Meaning::crossline_number, Meaning::x, Meaning::y, Meaning::z};
    TextCursor cursor(text_of(input));
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (is_remark(line)) continue;
        head.separator = separator_of(line);
        break;
    }
    return TableReader(input, options, std::move(head), *sign).run(TextCursor(text_of(input)));
}

}  // namespace geomend::horizon
