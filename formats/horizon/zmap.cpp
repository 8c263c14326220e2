// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/zmap.h"

#include <algorithm>
#include <cmath>

#include "formats/horizon/common.h"
#include "formats/horizon/lattice_fit.h"
#include "formats/horizon/zmap_header.h"

namespace geomend::horizon {

namespace {

bool is_title(std::string_view name) {
    return !name.empty() && name.find_first_of(",@!\n\r") == std::string_view::npos && trimmed(name) == name;
}

constexpr GridRules rules{"ZMAP+ grids", false, false, 1e30, true, is_title};
constexpr std::size_t nodes_per_line = 5;
constexpr std::size_t least_width = 15;

/// Reads the heights of the data section in the order of the file.
class ZmapHeights {
public:
    ZmapHeights(const Input& input, TextCursor cursor, const ZmapHeader& header)
        : input_(&input), cursor_(cursor), header_(&header), count_(std::size_t{header.rows} * header.columns) {
        null_ = header.null_number.value_or(rules.no_data);
    }

    std::optional<Failure> read(const Monitor* monitor);
    std::vector<double> values;
    bool any_point = false;
    double null() const { return null_; }

private:
    bool take(std::string_view field);
    bool by_width(std::string_view line);
    bool by_blanks(std::string_view line);
    Failure malformed(std::string_view line) const;

    const Input* input_;
    TextCursor cursor_;
    const ZmapHeader* header_;
    std::size_t count_;
    double null_ = 0;
    bool not_finite_ = false;
};

bool ZmapHeights::take(std::string_view field) {
    if (!header_->null_text.empty() && field == header_->null_text) {
        values.push_back(null_);
        return true;
    }
    double value = 0;
    const NumberStatus status = parse_real(field, value);
    if (status == NumberStatus::malformed) return false;
    if (status != NumberStatus::ok || !std::isfinite(value)) {
        not_finite_ = true;
        return false;
    }
    // The null value is often written without the point that heights have.
    if (value != null_ && field.find_first_of(".eEdD") != std::string_view::npos) any_point = true;
    values.push_back(value);
    return true;
}

bool ZmapHeights::by_width(std::string_view line) {
    const std::size_t width = header_->width, skip = header_->start - 1;
    if (width == 0 || line.size() <= skip || (line.size() - skip) % width != 0) return false;
    const std::size_t before = values.size();
    for (std::size_t at = skip; at < line.size(); at += width) {
        if (!take(trimmed(line.substr(at, width)))) {
            values.resize(before);
            return false;
        }
    }
    return true;
}

bool ZmapHeights::by_blanks(std::string_view line) {
    const std::size_t before = values.size();
    TextCursor cursor(line);
    cursor.next_line();
    for (std::string_view token = cursor.token(); !token.empty(); token = cursor.token()) {
        if (!take(token)) {
            values.resize(before);
            return false;
        }
    }
    return true;
}

Failure ZmapHeights::malformed(std::string_view line) const {
    TextCursor cursor(line);
    cursor.next_line();
    double value = 0;
    std::string_view token = cursor.token();
    while (!token.empty() && parse_real(token, value) == NumberStatus::ok && std::isfinite(value)) token = cursor.token();
    return unreadable(
        not_finite_ ? "F006" : "F005", location_of(*input_, cursor_, token),
        "expected heights in fields of " + std::to_string(header_->width) + " characters, found " + shown(token.empty() ? line : token));
}

std::optional<Failure> ZmapHeights::read(const Monitor* monitor) {
    constexpr std::uint64_t often = 4096;
    values.reserve(count_);
    while (cursor_.next_line()) {
        if (cursor_.line() % often == 0 && monitor != nullptr && monitor->stopped()) return stopped(*input_);
        std::string_view line = cursor_.line_text();
        if (line.starts_with('!')) continue;
        while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r')) line.remove_suffix(1);
        if (line.empty()) continue;
        if (by_width(line) || by_blanks(line)) {
            if (values.size() <= count_) continue;
            return unreadable("F008", {input_->name(), cursor_.line()}, "expected " + std::to_string(count_) + " heights, found more");
        }
        // RMS writes a line that begins with + between header and heights.
        if (!line.starts_with('+') || !values.empty()) return malformed(line);
    }
    if (values.size() < count_) {
        return unreadable(
            "F004", {input_->name(), cursor_.line()},
            "expected " + std::to_string(count_) + " heights, found " + std::to_string(values.size()) + " and the end of the file");
    }
    return std::nullopt;
}

void apply_decimals(ZmapHeights& heights, const ZmapHeader& header, const Input& input, std::vector<Finding>& findings) {
    if (heights.any_point || header.decimals == 0) return;
    std::uint64_t scaled = 0;
    const double divisor = std::pow(10.0, static_cast<double>(header.decimals));
    for (double& v : heights.values) {
        if (v == heights.null()) continue;
        v /= divisor;
        ++scaled;
    }
    if (scaled == 0) return;
    Finding finding = make_finding(
        "F113",
        "no height has a decimal point: the last " + std::to_string(header.decimals) + " digits are taken for decimals, as the header says",
        {input.name()}, scaled);
    findings.push_back(std::move(finding));
}

/// A number with a decimal point: some readers take one without for implied decimals.
void append_with_point(std::string& text, double value) {
    const std::size_t begin = text.size();
    append_number(text, value);
    if (text.find('.', begin) != std::string::npos) return;
    const std::size_t exponent = text.find('e', begin);
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
}

std::size_t widest(const FileGrid& grid) {
    std::size_t width = least_width - 1;
    std::string text;
    for (const double height : grid.heights) {
        text.clear();
        append_with_point(text, height);
        width = std::max(width, text.size());
    }
    return width + 1;  // a blank in front keeps fields apart
}

void write_header(OutputFile& file, const FileGrid& grid, std::size_t width) {
    for (const Annotation& a : grid.raster->info.annotations) {
        if (a.key == "horizon.zmap_comment" && a.value.find_first_of("\n\r") == std::string::npos) file << a.value << '\n';
    }
    const GridFrame& f = grid.frame;
    file << '@' << (is_title(grid.name) ? std::string_view(grid.name) : std::string_view("unnamed")) << " HEADER, GRID, ";
    file.number(std::uint64_t{nodes_per_line}) << '\n';
    file.number(std::uint64_t{width}) << ", ";
    std::string null;
    append_with_point(null, grid.no_data);
    file << null << ", , 7, 1\n";
    file.number(f.ny) << ", ";
    file.number(f.nx) << ", ";
    file.number(f.x0) << ", ";
    file.number(last_of(f.x0, f.xinc, f.nx - 1)) << ", ";
    file.number(f.y0) << ", ";
    file.number(last_of(f.y0, f.yinc, f.ny - 1)) << "\n0.0, 0.0, 0.0\n@\n";
}

void write_heights(OutputFile& file, const FileGrid& grid, std::size_t width) {
    const GridFrame& f = grid.frame;
    std::string text;
    for (std::size_t i = 0; i < f.nx; ++i) {
        std::size_t in_line = 0;
        for (std::size_t j = f.ny; j-- > 0;) {
            text.clear();
            append_with_point(text, grid.heights[j * f.nx + i]);
            text.insert(0, width - text.size(), ' ');
            file << text;
            if (++in_line == nodes_per_line || j == 0) {
                file << '\n';
                in_line = 0;
            }
        }
    }
}

/// The header states limits, not steps: their last digits can differ.
void tell_rounded_steps(const FileGrid& grid, std::vector<Loss>& losses) {
    const GridFrame& f = grid.frame;
    ZmapHeader header;
    header.rows = f.ny;
    header.columns = f.nx;
    header.xmin = f.x0;
    header.xmax = last_of(f.x0, f.xinc, f.nx - 1);
    header.ymin = f.y0;
    header.ymax = last_of(f.y0, f.yinc, f.ny - 1);
    const double moved = corner_distance(f, frame_of(header));
    if (moved > 0) {
        add_loss(losses, {LossClass::identity, grid.name, "last digits of the nodes' places, by up to " + number_text(moved),
                          "ZMAP+ grids state limits, not steps"});
    }
}

}  // namespace

int sniff_zmap(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view line = cursor.line_text();
        if (line.starts_with('!') || line.starts_with('+') || trimmed(line).empty()) continue;
        if (!line.starts_with('@')) return 0;
        const std::size_t comma = line.find(',');
        if (comma == std::string_view::npos) return 0;
        const std::string_view kind = trimmed(line.substr(comma + 1, line.find(',', comma + 1) - comma - 1));
        return same_word(kind, "GRID") ? 98 : 0;
    }
    return 0;
}

Result<Dataset> read_zmap(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    TextCursor cursor(text_of(input));
    const auto header = read_zmap_header(input, cursor);
    if (!header) return header.why();
    const auto left = static_cast<std::uint64_t>(cursor.text_end() - cursor.next_line_begin());
    // Fields of one digit can stand side by side.
    if (std::uint64_t{header->rows} * header->columns > left) {
        return unreadable("F014", {input.name(), cursor.line()},
                          "the header asks for " + std::to_string(header->rows) + " x " + std::to_string(header->columns) +
                              " heights, more than the file can hold");
    }
    ZmapHeights heights(input, cursor, *header);
    if (auto failed = heights.read(options.monitor)) return std::move(*failed);

    std::vector<Finding> findings;
    apply_decimals(heights, *header, input, findings);
    Raster raster = make_horizon(frame_of(*header), rows_from_columns(heights.values, header->columns, header->rows), heights.null(),
                                 sign->value_or(ZPositive::elevation), sign->has_value());
    const bool named = !header->title.empty() && !same_word(header->title, "unnamed") && !same_word(header->title, "GRID FILE");
    raster.info.name = named ? header->title : name_of(input);
    for (const std::string& comment : header->comments) raster.info.annotations.push_back({"horizon.zmap_comment", comment});
    Dataset dataset = dataset_of("ZMAP+ grid", std::move(raster));
    dataset.findings = std::move(findings);
    return dataset;
}

Result<std::vector<Loss>> write_zmap(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const auto grid = grid_for_writing(dataset, rules, out, options, losses);
    if (!grid) return grid.why();
    tell_rounded_steps(*grid, losses);

    OutputFile& file = out.main_file();
    const std::size_t width = widest(*grid);
    write_header(file, *grid, width);
    write_heights(file, *grid, width);
    return losses;
}

}  // namespace geomend::horizon
