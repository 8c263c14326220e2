// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/cps3_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/horizon/common.h"
#include "formats/horizon/lattice.h"

namespace geomend::horizon {

namespace {

bool is_name(std::string_view name) { return name.find_first_of("\n\r") == std::string_view::npos && trimmed(name) == name; }

constexpr GridRules rules{"CPS-3 grids", false, false, 1e30, true, is_name};
constexpr int numbers_per_line = 5;

struct Cps3Header {
    double null = rules.no_data;
    std::optional<std::array<double, 4>> limits;
    std::optional<std::array<std::uint32_t, 2>> counts;  // rows, columns
    std::optional<std::array<double, 2>> steps;
    std::string name;
    std::vector<Annotation> annotations;
};

bool begins_number(std::string_view line) {
    return !line.empty() && (line[0] == '-' || line[0] == '+' || line[0] == '.' || (line[0] >= '0' && line[0] <= '9'));
}

template <std::size_t N>
std::optional<Failure> take_numbers(const Input& input, TextCursor& cursor, std::string_view what, std::array<double, N>& values) {
    for (double& value : values) {
        if (auto failed = finite_number(input, cursor, cursor.token(), what, value)) return failed;
    }
    return std::nullopt;
}

std::optional<Failure> take_counts(const Input& input, TextCursor& cursor, Cps3Header& header) {
    std::array<std::uint32_t, 2> counts{};
    for (std::uint32_t& count : counts) {
        const std::string_view token = cursor.token();
        std::int64_t value = 0;
        if (parse_integer(token, value) != NumberStatus::ok || value < 1 || value > std::numeric_limits<std::int32_t>::max()) {
            return unreadable("F012", location_of(input, cursor, token),
                              "expected the numbers of rows and columns, from 1, found " + shown(token));
        }
        count = static_cast<std::uint32_t>(value);
    }
    header.counts = counts;
    return std::nullopt;
}

/// The null value is the fifth number of FSASCI, behind a word that may be quoted.
std::optional<Failure> take_null(const Input& input, TextCursor& cursor, Cps3Header& header) {
    for (int i = 0; i < 4; ++i) cursor.quoted_token();
    const std::string_view token = cursor.token();
    if (token.empty()) return std::nullopt;
    return finite_number(input, cursor, token, "the null value of FSASCI", header.null);
}

std::optional<Failure> take_record(const Input& input, TextCursor& cursor, Cps3Header& header) {
    const std::string_view line = cursor.line_text();
    const std::string_view word = cursor.token();
    if (same_word(word, "FSASCI")) return take_null(input, cursor, header);
    if (same_word(word, "FSNROW")) return take_counts(input, cursor, header);
    if (same_word(word, "FSLIMI")) {
        header.limits.emplace();
        return take_numbers(input, cursor, "xmin, xmax, ymin and ymax of FSLIMI", *header.limits);
    }
    if (same_word(word, "FSXINC")) {
        header.steps.emplace();
        return take_numbers(input, cursor, "the steps of FSXINC", *header.steps);
    }
    header.annotations.push_back({word.starts_with('!') ? "horizon.cps3_comment" : "horizon.cps3_record", std::string(line)});
    return std::nullopt;
}

/// Reads all lines before the heights; the cursor then stands in the last of them.
std::optional<Failure> read_header(const Input& input, TextCursor& cursor, Cps3Header& header) {
    for (;;) {
        const char* before = cursor.next_line_begin();
        const std::uint64_t line_before = cursor.line();
        if (!cursor.next_line())
            return unreadable("F004", {input.name(), cursor.line()},
                              "expected the header and the heights of a CPS-3 grid, found the end of the file");
        const std::string_view line = trimmed(cursor.line_text());
        if (line.starts_with("->")) {
            header.name = trimmed(line.substr(2));
            return std::nullopt;
        }
        if (begins_number(line)) {  // no "->" line: give the line back
            cursor.jump(before, line_before + 1);
            return std::nullopt;
        }
        if (line.empty()) continue;
        if (auto failed = take_record(input, cursor, header)) return failed;
    }
}

Result<GridFrame> frame_of(const Cps3Header& header, const Input& input, std::vector<Finding>& findings) {
    if (!header.counts || !header.limits) return unreadable("F012", {input.name()}, "expected FSLIMI and FSNROW before the heights");
    const auto& [xmin, xmax, ymin, ymax] = *header.limits;
    GridFrame frame;
    frame.ny = (*header.counts)[0];
    frame.nx = (*header.counts)[1];
    frame.x0 = xmin;
    frame.y0 = ymin;
    const auto by_limits = [](double low, double high, std::uint32_t count) { return count > 1 ? (high - low) / (count - 1.0) : 1.0; };
    const std::array<double, 2> limits{by_limits(xmin, xmax, frame.nx), by_limits(ymin, ymax, frame.ny)};
    std::array<double, 2> steps = header.steps.value_or(limits);
    const auto disagrees = [](double step, double limit, std::uint32_t count) {
        return count > 1 && std::abs(step - limit) * (count - 1.0) > 1e-3 * std::abs(limit);
    };
    if (disagrees(steps[0], limits[0], frame.nx) || disagrees(steps[1], limits[1], frame.ny)) {
        Finding finding =
            make_finding("F113", "the steps of FSXINC disagree with the limits of FSLIMI; the limits are taken", {input.name()}, 0);
        findings.push_back(std::move(finding));
        steps = limits;
    }
    if (steps[0] <= 0 || steps[1] <= 0) return unreadable("F012", {input.name()}, "expected limits that ascend and steps above 0");
    frame.xinc = steps[0];
    frame.yinc = steps[1];
    return frame;
}

void write_header(OutputFile& file, const FileGrid& grid) {
    const GridFrame& f = grid.frame;
    for (const Annotation& a : grid.raster->info.annotations) {
        if (a.key == "horizon.cps3_comment" && is_name(a.value)) file << a.value << '\n';
    }
    file << "FSASCI 0 1 \"COMPUTED\" 0 ";
    file.number(grid.no_data) << '\n';
    bool any = false;
    for (const Annotation& a : grid.raster->info.annotations) {
        if (a.key != "horizon.cps3_record" || !is_name(a.value)) continue;
        file << a.value << '\n';
        any = true;
    }
    if (!any) file << "FSATTR 0 0\n";
    const auto range = height_range(grid);
    file << "FSLIMI";
    for (const double limit : {f.x0, f.x0 + (f.nx - 1.0) * f.xinc, f.y0, f.y0 + (f.ny - 1.0) * f.yinc, range[0], range[1]})
        (file << ' ').number(limit);
    file << "\nFSNROW ";
    file.number(f.ny) << ' ';
    file.number(f.nx) << "\nFSXINC ";
    file.number(f.xinc) << ' ';
    file.number(f.yinc) << "\n->" << (is_name(grid.name) ? grid.name : "") << '\n';
}

}  // namespace

int sniff_cps3_grid(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty() || word.starts_with('!')) continue;
        for (const std::string_view record : {"FSASCI", "FSATTR", "FSLIMI", "FSNROW", "FSXINC"}) {
            if (same_word(word, record)) return 98;
        }
        return 0;
    }
    return 0;
}

Result<Dataset> read_cps3_grid(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    TextCursor cursor(text_of(input));
    Cps3Header header;
    if (auto failed = read_header(input, cursor, header)) return std::move(*failed);
    std::vector<Finding> findings;
    const auto frame = frame_of(header, input, findings);
    if (!frame) return frame.why();
    const auto left = static_cast<std::uint64_t>(cursor.text_end() - cursor.next_line_begin());
    if (!could_hold(left, std::uint64_t{frame->nx} * frame->ny)) {
        return unreadable("F014", {input.name(), cursor.line()},
                          "the header asks for " + std::to_string(frame->ny) + " x " + std::to_string(frame->nx) +
                              " heights, more than the file can hold");
    }
    // What is left of the "->" line is its name.
    cursor.rest();
    NumberStream numbers(input, cursor);
    std::vector<double> columns(std::size_t{frame->nx} * frame->ny);
    if (!numbers.fill("heights of a CPS-3 grid", options.monitor, columns)) return numbers.why();
    if (!numbers.at_end(std::to_string(columns.size()) + " heights")) return numbers.why();

    Raster raster = make_horizon(*frame, rows_from_columns(columns, frame->nx, frame->ny), header.null,
                                 sign->value_or(ZPositive::elevation), sign->has_value());
    raster.info.name = header.name.empty() ? name_of(input) : header.name;
    raster.info.annotations.insert(raster.info.annotations.end(), header.annotations.begin(), header.annotations.end());
    Dataset dataset = dataset_of("CPS-3 grid", std::move(raster));
    dataset.findings = std::move(findings);
    tell_missing_line_end(input, dataset);
    return dataset;
}

Result<std::vector<Loss>> write_cps3_grid(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const auto grid = grid_for_writing(dataset, rules, out, options, losses);
    if (!grid) return grid.why();

    OutputFile& file = out.main_file();
    write_header(file, *grid);
    const GridFrame& f = grid->frame;
    for (std::size_t i = 0; i < f.nx; ++i) {
        int in_line = 0;
        for (std::size_t j = f.ny; j-- > 0;) {
            file.number(grid->heights[j * f.nx + i]);
            const bool ends = ++in_line == numbers_per_line || j == 0;
            file << (ends ? '\n' : ' ');
            if (ends) in_line = 0;
        }
    }
    return losses;
}

}  // namespace geomend::horizon
