// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/lines_formats.h"

#include <algorithm>

#include "formats/horizon/common.h"
#include "formats/horizon/irap_points.h"
#include "formats/horizon/losses.h"
#include "formats/horizon/point_table.h"
#include "formats/horizon/polylines.h"

namespace geomend::horizon {

namespace {

constexpr std::string_view polygons_title = "IRAP polygons", lines_title = "CPS-3 lines";
constexpr std::string_view separator = "999.0 999.0 999.0\n";

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('!'); }

/// x, y and z of the current line, and nothing else.
std::optional<Failure> read_position(const Input& input, TextCursor& cursor, Vec3& p) {
    constexpr std::string_view axes[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string_view token = cursor.token();
        if (token.empty())
            return unreadable("F012", location_of(input, cursor, token),
                              "expected x, y and z, found the end of the line after " + std::to_string(axis));
        if (auto failed = finite_number(input, cursor, token, axes[axis], p[axis])) return failed;
    }
    if (const std::string_view more = cursor.token(); !more.empty()) {
        return unreadable("F012", location_of(input, cursor, more), "expected the end of the line after x, y and z, found " + shown(more));
    }
    return std::nullopt;
}

/// Collects the points of one line after the other.
struct LineCollector {
    PolylineSet set;
    std::vector<Vec3> points;
    std::string name;
    std::uint64_t empty_lines = 0;
    bool begun = false;

    void end_line() {
        if (points.empty() && begun) ++empty_lines;
        add_line(set, name, points);
        points.clear();
        begun = false;
    }
};

Dataset finish(const Input& input, LineCollector& lines, std::string variant, const std::optional<ZPositive>& sign) {
    ObjectInfo& info = lines.set.info;
    info.name = name_of(input);
    info.crs.z_positive = sign.value_or(ZPositive::elevation);
    info.crs.z_positive_stated = sign.has_value();
    Dataset dataset = dataset_of(std::move(variant), std::move(lines.set));
    if (lines.empty_lines > 0) {
        Finding finding = make_finding("F119", "lines without points are left out", {input.name()}, lines.empty_lines);
        dataset.findings.push_back(std::move(finding));
    }
    tell_missing_line_end(input, dataset);
    return dataset;
}

bool poll(const Monitor* monitor, std::uint64_t line) {
    constexpr std::uint64_t often = 16384;
    return line % often == 0 && monitor != nullptr && monitor->stopped();
}

/// What both writers share: the set, its lines and the losses.
struct WrittenLines {
    const PolylineSet* set = nullptr;
    std::vector<Chain> chains;
    ZPositive sign = ZPositive::elevation;
    std::vector<Loss> losses;
};

Result<WrittenLines> lines_for_writing(const Dataset& dataset, OutputSet& out, const WriteOptions& options, std::string_view title,
                                       bool part_names) {
    const auto asked_sign = z_option(options.options);
    if (!asked_sign) return asked_sign.why();
    const auto index = polylines_for_writing(dataset, title);
    if (!index) return index.why();
    WrittenLines lines;
    lines.set = &std::get<PolylineSet>(dataset.objects[*index]);
    const ObjectInfo& info = lines.set->info;
    lines.chains = chains_of(*lines.set);
    if (lines.chains.empty())
        return failure(FailureKind::cannot_hold, "F021", {}, std::string(title) + " hold lines: there is none to write");
    lines.sign = asked_sign->value_or(info.crs.z_positive);
    add_other_losses(dataset, *index, title, lines.losses);
    add_info_losses(info, {.title = title}, out, lines.losses);
    const auto named =
        static_cast<std::uint64_t>(std::ranges::count_if(lines.set->parts, [](const auto& part) { return !part.name.empty(); }));
    if (named > 0 && !part_names) {
        add_loss(lines.losses, {LossClass::identity, info.name, "names of parts", std::string(title) + " have no place for it", named});
    }
    const std::size_t parts = std::max<std::size_t>(lines.set->parts.size(), 1);
    if (lines.chains.size() > parts) {
        add_loss(lines.losses, {LossClass::identity, info.name, "which lines make a part", std::string(title) + " hold single lines",
                                lines.chains.size() - parts});
    }
    return lines;
}

void write_position(OutputFile& file, const Vec3& p) {
    file.number(p[0]) << ' ';
    file.number(p[1]) << ' ';
    file.number(p[2]) << '\n';
}

}  // namespace

int sniff_irap_polygons(std::string_view head, std::string_view base_name) {
    TextCursor cursor(head);
    bool any_separator = false;
    while (cursor.next_line()) {
        if (cursor.next_line_begin() == cursor.text_end() && !head.ends_with('\n')) break;  // may be cut
        if (cursor.at_line_end() || is_comment(cursor.peek_rest())) continue;
        Vec3 p{};
        for (double& x : p) {
            if (cursor.real(x) != NumberStatus::ok) return 0;
        }
        if (!cursor.at_line_end()) return 0;
        any_separator = any_separator || is_separator(p);
    }
    // RMS ends points, too, with 999 999 999: the extension says what they are.
    return any_separator && !has_points_extension(base_name) ? 60 : 0;
}

Result<Dataset> read_irap_polygons(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    LineCollector lines;
    TextCursor cursor(text_of(input));
    while (cursor.next_line()) {
        if (poll(options.monitor, cursor.line())) return stopped(input);
        if (cursor.at_line_end() || is_comment(cursor.peek_rest())) continue;
        Vec3 p{};
        if (auto failed = read_position(input, cursor, p)) return std::move(*failed);
        if (is_separator(p)) {
            lines.begun = true;
            lines.end_line();
        } else {
            lines.points.push_back(file_position(p, sign->value_or(ZPositive::elevation)));
        }
    }
    lines.end_line();
    if (lines.set.parts.empty()) return unreadable("F017", {input.name(), cursor.line()}, "expected polygons, found none");
    return finish(input, lines, "IRAP polygons", *sign);
}

Result<std::vector<Loss>> write_irap_polygons(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    auto lines = lines_for_writing(dataset, out, options, polygons_title, false);
    if (!lines) return std::move(lines).why();
    OutputFile& file = out.main_file();
    for (const Chain& chain : lines->chains) {
        for (const std::uint32_t point : chain.points) {
            const Vec3 p = file_position(lines->set->points[point], lines->sign);
            if (is_separator(p))
                add_loss(lines->losses,
                         {LossClass::substance, lines->set->info.name, "a point at 999 999 999", "this ends a polygon in IRAP polygons"});
            write_position(file, p);
        }
        file << separator;
    }
    return std::move(lines->losses);
}

int sniff_cps3_lines(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty() || word.starts_with('!')) continue;
        return same_word(word, "FFASCI") || same_word(word, "FFATTR") ? 98 : 0;
    }
    return 0;
}

Result<Dataset> read_cps3_lines(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    LineCollector lines;
    bool in_header = true;
    TextCursor cursor(text_of(input));
    while (cursor.next_line()) {
        if (poll(options.monitor, cursor.line())) return stopped(input);
        const std::string_view line = trimmed(cursor.line_text());
        if (line.empty() || is_comment(line)) continue;
        if (line.starts_with("->")) {
            lines.end_line();
            lines.name = trimmed(line.substr(2));
            lines.begun = true;
            in_header = false;
        } else if (in_header) {
            if (!line.starts_with('F') && !line.starts_with('f')) {
                return unreadable("F012", {input.name(), cursor.line(), 1}, "expected FFASCI, FFATTR or '->', found " + shown(line));
            }
        } else {
            Vec3 p{};
            if (auto failed = read_position(input, cursor, p)) return std::move(*failed);
            lines.points.push_back(file_position(p, sign->value_or(ZPositive::elevation)));
        }
    }
    lines.end_line();
    if (in_header)
        return unreadable("F004", {input.name(), cursor.line()}, "expected '->' before the first line, found the end of the file");
    return finish(input, lines, "CPS-3 lines", *sign);
}

Result<std::vector<Loss>> write_cps3_lines(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    auto lines = lines_for_writing(dataset, out, options, lines_title, true);
    if (!lines) return std::move(lines).why();
    OutputFile& file = out.main_file();
    file << "FFASCI 0 1 \"LINES\" 0 1e+30\nFFATTR 0 1\n";
    for (const Chain& chain : lines->chains) {
        const std::string_view name =
            chain.part < lines->set->parts.size() ? std::string_view(lines->set->parts[chain.part].name) : std::string_view{};
        file << "->" << (name.find_first_of("\n\r") == std::string_view::npos ? trimmed(name) : std::string_view{}) << '\n';
        for (const std::uint32_t point : chain.points) write_position(file, file_position(lines->set->points[point], lines->sign));
    }
    return std::move(lines->losses);
}

}  // namespace geomend::horizon
