// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/irap_grid.h"

#include "formats/horizon/common.h"
#include "formats/horizon/irap_header.h"

namespace geomend::horizon {

namespace {

constexpr GridRules rules{"IRAP classic grids", true, false, 9999900.0, false};
constexpr int numbers_per_line = 6;

/// Line breaks of the ASCII header come after these numbers.
constexpr std::array<std::size_t, 4> line_ends = {4, 8, 12, 19};

}  // namespace

int sniff_irap_grid(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        if (cursor.at_line_end()) continue;
        std::int64_t mark = 0;
        double number = 0;
        if (cursor.integer(mark) != NumberStatus::ok || mark != -996) return 0;
        for (int i = 0; i < 3; ++i) {
            if (cursor.real(number) != NumberStatus::ok) return 40;
        }
        return 95;
    }
    return 0;
}

Result<Dataset> read_irap_grid(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    NumberStream numbers(input, TextCursor(text_of(input)));
    IrapHeader header{};
    for (std::size_t i = 0; i < header.size(); ++i) {
        if (!numbers.next("number " + std::to_string(i + 1) + " of the 19 of an IRAP header", header[i])) return numbers.why();
        if (i == 0 && header[0] != irap_mark) break;
    }
    const auto stated = irap_frame(header, numbers.bytes_left() / 2 + 1, numbers.here());
    if (!stated) return stated.why();
    std::vector<double> heights(std::size_t{stated->frame.nx} * stated->frame.ny);
    if (!numbers.fill("heights of an IRAP grid", options.monitor, heights)) return numbers.why();
    if (!numbers.at_end(std::to_string(heights.size()) + " heights")) return numbers.why();

    Raster raster = make_horizon(stated->frame, std::move(heights), rules.no_data, sign->value_or(ZPositive::elevation), sign->has_value());
    raster.info.name = name_of(input);
    Dataset dataset = dataset_of("IRAP classic grid ASCII", std::move(raster));
    if (!stated->warning.empty()) dataset.findings.push_back(irap_warning(stated->warning, {input.name(), 1}));
    tell_missing_line_end(input, dataset);
    return dataset;
}

Result<std::vector<Loss>> write_irap_grid(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const auto grid = grid_for_writing(dataset, rules, out, options, losses);
    if (!grid) return grid.why();

    OutputFile& file = out.main_file();
    const IrapHeader header = irap_header(*grid);
    std::size_t line = 0;
    for (std::size_t i = 0; i < header.size(); ++i) {
        file.number(header[i]);
        const bool ends = i + 1 == line_ends[line];
        file << (ends ? '\n' : ' ');
        if (ends) ++line;
    }
    int in_line = 0;
    for (const double height : grid->heights) {
        if (in_line == numbers_per_line) {
            file << '\n';
            in_line = 0;
        }
        if (in_line++ > 0) file << ' ';
        file.number(height);
    }
    file << '\n';
    return losses;
}

}  // namespace geomend::horizon
