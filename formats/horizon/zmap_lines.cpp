// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/zmap_lines.h"

#include <algorithm>
#include <cmath>

#include "formats/drop.h"
#include "formats/horizon/common.h"
#include "formats/horizon/point_table.h"
#include "formats/horizon/polylines.h"

namespace geomend::horizon {

namespace {

constexpr std::int64_t x_code = 1, y_code = 2, z_code = 3, line_code = 35;

struct ZmapField {
    std::string name;
    std::int64_t code = 0;
    std::size_t first = 0, last = 0;  ///< columns from 1; 0: not stated
    std::optional<double> null;
    std::vector<double> values;  ///< of further fields
};

std::vector<std::string_view> between_commas(std::string_view line) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t comma = line.find(',');
        parts.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return parts;
        line.remove_prefix(comma + 1);
    }
}

bool is_lines_kind(std::string_view kind) { return same_word(kind, "DATA") || same_word(kind, "FAULT") || same_word(kind, "POLY"); }

bool is_passed_over(std::string_view line) { return line.empty() || line.starts_with('!') || line.starts_with('+'); }

class ZmapLineReader {
public:
    ZmapLineReader(const Input& input, const ReadOptions& options, std::optional<ZPositive> sign)
        : input_(input), options_(options), sign_(sign), cursor_(text_of(input)) {}

    Result<Dataset> run() {
        if (auto failed = read_head()) return std::move(*failed);
        constexpr std::uint64_t often = 16384;
        while (cursor_.next_line()) {
            if (cursor_.line() % often == 0 && options_.monitor != nullptr && options_.monitor->stopped()) return stopped(input_);
            if (is_passed_over(trimmed(cursor_.line_text()))) continue;
            if (auto failed = read_row()) return std::move(*failed);
        }
        if (points_.empty()) return unreadable("F017", {input_.name(), cursor_.line()}, "expected points, found none");
        Dataset data = finish();
        if (without_place_ > 0)
            drop(data.findings, data.losses,
                 {.what = "points", .why = "their x, y or z is missing", .count = without_place_, .where = {input_.name()}});
        tell_missing_line_end(input_, data);
        return data;
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    std::optional<ZPositive> sign_;
    TextCursor cursor_;
    std::vector<ZmapField> fields_;
    bool by_columns_ = true;
    std::vector<Vec3> points_;
    std::vector<double> lines_;  ///< per point the number of its line
    std::uint64_t without_place_ = 0;

    const ZmapField* field(std::int64_t code) const {
        const auto found = std::ranges::find(fields_, code, &ZmapField::code);
        return found == fields_.end() ? nullptr : &*found;
    }

    std::optional<Failure> read_head() {
        bool begun = false;
        while (cursor_.next_line()) {
            const std::string_view line = trimmed(cursor_.line_text());
            if (is_passed_over(line)) continue;
            if (!begun) {
                const auto parts = between_commas(line);
                if (!line.starts_with('@') || parts.size() < 2 || !is_lines_kind(parts[1]))
                    return unreadable("F012", {input_.name(), cursor_.line(), 1}, "expected '@name, DATA, ...', found " + shown(line));
                begun = true;
            } else if (line.starts_with('@')) {
                return check_fields();
            } else if (auto failed = read_field(line)) {
                return failed;
            }
        }
        return unreadable("F004", {input_.name(), cursor_.line()}, "expected '@' behind the fields, found the end of the file");
    }

    std::optional<Failure> read_field(std::string_view line) {
        const auto parts = between_commas(line);
        ZmapField& f = fields_.emplace_back();
        f.name = parts[0];
        const auto whole = [&](std::size_t part, std::int64_t& to) {
            return part < parts.size() && parse_integer(parts[part], to) == NumberStatus::ok && to > 0;
        };
        std::int64_t first = 0, last = 0;
        if (!whole(2, f.code))
            return unreadable("F012", {input_.name(), cursor_.line(), 1},
                              "expected a field as 'name, number, code, ...', found " + shown(line));
        const bool placed = whole(4, first) && whole(5, last) && first <= last;
        by_columns_ = by_columns_ && placed;
        f.first = static_cast<std::size_t>(first);
        f.last = static_cast<std::size_t>(last);
        double null = 0;
        if (parts.size() > 7 && parse_real(parts[7], null) == NumberStatus::ok) f.null = null;
        return std::nullopt;
    }

    std::optional<Failure> check_fields() const {
        for (const std::int64_t code : {x_code, y_code, z_code}) {
            if (std::ranges::count(fields_, code, &ZmapField::code) != 1)
                return unreadable("F012", {input_.name(), cursor_.line()}, "expected fields of codes 1, 2 and 3 (x, y and z) once each");
        }
        return std::nullopt;
    }

    std::optional<Failure> read_row() {
        const std::string_view line = cursor_.line_text();
        std::array<double, 3> place{};
        double line_number = 0;
        bool whole = true;
        if (points_.size() >= no_index) return unreadable("F014", {input_.name(), cursor_.line()}, "expected fewer than 2^32 points");
        cursor_.rewind_line();
        std::vector<double> further;
        for (const ZmapField& f : fields_) {
            std::string_view text =
                by_columns_ && f.first <= line.size() ? trimmed(line.substr(f.first - 1, f.last - f.first + 1)) : std::string_view();
            if (!by_columns_) text = cursor_.token();
            double value = 0;
            if (auto failed = finite_number(input_, cursor_, text, "a number for '" + f.name + "'", value)) return failed;
            const bool missing = f.null && (value == *f.null || static_cast<float>(value) == static_cast<float>(*f.null));
            if (f.code >= x_code && f.code <= z_code) {
                place[static_cast<std::size_t>(f.code - 1)] = value;
                whole = whole && !missing;
            } else if (f.code == line_code) {
                line_number = value;
            } else {
                further.push_back(value);
            }
        }
        if (!whole) {
            ++without_place_;
            return std::nullopt;
        }
        points_.push_back(file_position({place[0], place[1], place[2]}, sign_.value_or(ZPositive::elevation)));
        lines_.push_back(line_number);
        std::size_t k = 0;
        for (ZmapField& f : fields_) {
            if (f.code != line_code && !(f.code >= x_code && f.code <= z_code)) f.values.push_back(further[k++]);
        }
        return std::nullopt;
    }

    void describe(ObjectInfo& info) const {
        info.name = name_of(input_);
        info.crs.z_positive = sign_.value_or(ZPositive::elevation);
        info.crs.z_positive_stated = sign_.has_value();
    }

    Dataset finish() {
        if (field(line_code) == nullptr) {
            PointSet set;
            describe(set.info);
            set.points = std::move(points_);
            for (ZmapField& f : fields_) {
                if (f.values.empty()) continue;
                Attribute a;
                a.name = f.name;
                a.no_data = f.null;  // each property has its own
                a.values = std::move(f.values);
                set.info.attributes.push_back(std::move(a));
            }
            return dataset_of("ZMAP+ points", std::move(set));
        }
        PolylineSet set;
        describe(set.info);
        for (std::size_t begin = 0; begin < points_.size();) {
            std::size_t end = begin;
            while (end < points_.size() && lines_[end] == lines_[begin]) ++end;
            add_line(set, number_text(lines_[begin]), std::span(points_).subspan(begin, end - begin));
            begin = end;
        }
        Dataset data = dataset_of("ZMAP+ lines", std::move(set));
        for (const ZmapField& f : fields_) {
            if (!f.values.empty())
                drop(data.findings, data.losses,
                     {.what = "field '" + f.name + "'",
                      .why = "lines are kept by their points",
                      .count = f.values.size(),
                      .where = {input_.name()}});
        }
        return data;
    }
};

}  // namespace

int sniff_zmap_lines(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (is_passed_over(line)) continue;
        const auto parts = between_commas(line);
        return line.starts_with('@') && parts.size() > 1 && is_lines_kind(parts[1]) ? 97 : 0;
    }
    return 0;
}

Result<Dataset> read_zmap_lines(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    return ZmapLineReader(input, options, *sign).run();
}

}  // namespace geomend::horizon
