// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/zmap_header.h"

#include <cmath>
#include <limits>

#include "formats/horizon/common.h"

namespace geomend::horizon {

namespace {

using Fields = std::vector<std::string_view>;

Fields split_at_commas(std::string_view line) {
    Fields fields;
    for (;;) {
        const std::size_t comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

/// One line of the header and what is read from it; keeps the first failure.
class HeaderLine {
public:
    HeaderLine(const Input& input, TextCursor& cursor) : input_(&input), cursor_(&cursor), fields_(split_at_commas(cursor.line_text())) {}

    std::string_view text(std::size_t i) const { return i < fields_.size() ? fields_[i] : std::string_view{}; }

    double number(std::size_t i, std::string_view what) {
        double value = 0;
        if (failure_) return 0;
        failure_ = finite_number(*input_, *cursor_, text(i), what, value);
        return value;
    }
    std::uint64_t count(std::size_t i, std::string_view what, std::uint64_t least, std::uint64_t most) {
        const double value = number(i, what);
        if (failure_) return least;
        if (value != std::floor(value) || value < static_cast<double>(least) || value > static_cast<double>(most)) {
            failure_ = unreadable("F012", location_of(*input_, *cursor_, text(i)),
                                  "expected " + std::string(what) + " from " + std::to_string(least) + " to " + std::to_string(most) +
                                      ", found " + shown(text(i)));
            return least;
        }
        return static_cast<std::uint64_t>(value);
    }
    std::optional<Failure>& failed() { return failure_; }

private:
    const Input* input_;
    TextCursor* cursor_;
    Fields fields_;
    std::optional<Failure> failure_;
};

bool is_remark(std::string_view line) { return line.starts_with('!') || line.starts_with('+'); }

/// Goes to the next line that is no comment; comments are kept.
bool next_header_line(TextCursor& cursor, ZmapHeader& header) {
    while (cursor.next_line()) {
        if (!is_remark(cursor.line_text())) return true;
        header.comments.emplace_back(cursor.line_text());
    }
    return false;
}

Failure ended(const Input& input, const TextCursor& cursor) {
    return unreadable("F004", {input.name(), cursor.line()}, "expected the five lines of a ZMAP+ header, found the end of the file");
}

std::optional<Failure> read_title(const Input& input, TextCursor& cursor, ZmapHeader& header) {
    HeaderLine line(input, cursor);
    std::string_view title = line.text(0);
    if (!title.starts_with('@'))
        return unreadable("F012", {input.name(), cursor.line(), 1}, "expected '@' at the start of a ZMAP+ header, found " + shown(title));
    if (!same_word(line.text(1), "GRID")) {
        return unreadable("F013", location_of(input, cursor, line.text(1)),
                          "expected a ZMAP+ file of kind GRID, found " + shown(line.text(1)));
    }
    title = trimmed(title.substr(1));
    constexpr std::string_view tail = " HEADER";
    if (title.size() > tail.size() && same_word(title.substr(title.size() - tail.size()), tail)) title.remove_suffix(tail.size());
    header.title = trimmed(title);
    header.nodes_per_line = line.count(2, "a number of nodes per line", 1, 1000000);
    return line.failed();
}

std::optional<Failure> read_fields(const Input& input, TextCursor& cursor, ZmapHeader& header) {
    HeaderLine line(input, cursor);
    header.width = line.count(0, "a field width", 0, 1000);
    if (!line.text(1).empty()) header.null_number = line.number(1, "a null value");
    header.null_text = line.text(2);
    if (!line.text(3).empty()) header.decimals = line.count(3, "a number of decimals", 0, 300);
    if (!line.text(4).empty()) header.start = line.count(4, "a first column", 1, 100000);
    return line.failed();
}

std::optional<Failure> read_lattice(const Input& input, TextCursor& cursor, ZmapHeader& header) {
    HeaderLine line(input, cursor);
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    header.rows = static_cast<std::uint32_t>(line.count(0, "a number of rows", 1, most));
    header.columns = static_cast<std::uint32_t>(line.count(1, "a number of columns", 1, most));
    header.xmin = line.number(2, "the smallest x");
    header.xmax = line.number(3, "the largest x");
    header.ymin = line.number(4, "the smallest y");
    header.ymax = line.number(5, "the largest y");
    if (line.failed()) return line.failed();
    const bool flat_x = header.columns > 1 && header.xmax <= header.xmin, flat_y = header.rows > 1 && header.ymax <= header.ymin;
    if (flat_x || flat_y)
        return unreadable("F012", {input.name(), cursor.line(), 1},
                          "expected the smallest x and y before the largest, found " + shown(cursor.line_text()));
    return std::nullopt;
}

}  // namespace

Result<ZmapHeader> read_zmap_header(const Input& input, TextCursor& cursor) {
    ZmapHeader header;
    for (const auto& read : {read_title, read_fields, read_lattice}) {
        if (!next_header_line(cursor, header)) return ended(input, cursor);
        if (auto failed = read(input, cursor, header)) return std::move(*failed);
    }
    // The fourth line is there in practice, but holds nothing.
    for (int more = 0; more < 2; ++more) {
        if (!next_header_line(cursor, header)) return ended(input, cursor);
        if (trimmed(cursor.line_text()).starts_with('@')) return header;
    }
    return unreadable("F012", {input.name(), cursor.line(), 1},
                      "expected '@' at the end of the header, found " + shown(cursor.line_text()));
}

GridFrame frame_of(const ZmapHeader& header) {
    GridFrame frame;
    frame.nx = header.columns;
    frame.ny = header.rows;
    frame.x0 = header.xmin;
    frame.y0 = header.ymin;
    if (frame.nx > 1) frame.xinc = (header.xmax - header.xmin) / (frame.nx - 1.0);
    if (frame.ny > 1) frame.yinc = (header.ymax - header.ymin) / (frame.ny - 1.0);
    return frame;
}

double last_of(double first, double step, std::uint32_t intervals) {
    if (intervals == 0) return first;
    const double last = first + intervals * step;
    double below = last, above = last;
    for (int i = 0; i < 4; ++i) {
        if ((below - first) / intervals == step) return below;
        if ((above - first) / intervals == step) return above;
        below = std::nextafter(below, -HUGE_VAL);
        above = std::nextafter(above, HUGE_VAL);
    }
    return last;
}

}  // namespace geomend::horizon
