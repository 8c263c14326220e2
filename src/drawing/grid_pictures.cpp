// SPDX-License-Identifier: AGPL-3.0-or-later
#include "drawing/grid_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/wording.h"
#include "drawing/canvas.h"
#include "gridding/horizon_reader.h"

namespace geomend {

namespace {

using gridding::Point;

constexpr Colour white{255, 255, 255}, black{0, 0, 0}, red{200, 20, 20}, edge{150, 150, 150}, grey{70, 70, 70}, blue{20, 60, 200};
constexpr double margin = 60, line_height = 18;
constexpr std::array<Colour, 8> zone_colours{Colour{246, 207, 143}, Colour{164, 203, 234}, Colour{178, 214, 160}, Colour{232, 178, 178},
                                             Colour{204, 186, 224}, Colour{240, 232, 150}, Colour{170, 216, 210}, Colour{214, 196, 170}};

/// A box in the axes of what is drawn.
struct Extent {
    Point low{1e300, 1e300}, high{-1e300, -1e300};
    void add(const Point& p) {
        for (std::size_t a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    double size(std::size_t a) const { return high[a] > low[a] ? high[a] - low[a] : 1; }
};

/// Where things come in a picture.
struct View {
    Point low{};
    std::array<double, 2> scale{1, 1};
    Canvas::Place corner{};  ///< where `low` is
    Canvas::Place at(const Point& p) const { return {corner[0] + scale[0] * (p[0] - low[0]), corner[1] + scale[1] * (p[1] - low[1])}; }
};

/// The four corners of a column in plan at a depth, in cyclic order.
std::array<Point, 4> column_corners(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, double level) {
    const auto at = [&](std::size_t pi, std::size_t pj) {
        const Vec3 p = pillar_point(grid.pillars.data() + 6 * (pi + (std::size_t{grid.dims[0]} + 1) * pj), level);
        return Point{p[0], p[1]};
    };
    return {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
}

std::optional<std::uint32_t> first_active(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j) {
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        if (grid.is_active(grid.cell(i, j, k))) return k;
    }
    return std::nullopt;
}

double top_depth(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    double sum = 0;
    for (unsigned c = 0; c < 4; ++c) sum += grid.depths[corner_index(grid.dims, i, j, k, c)] / 4;
    return sum;
}

/// Blue below, green, yellow above: share 0 to 1 downwards.
Colour by_depth(double share) {
    constexpr std::array<std::array<double, 3>, 4> stops{{{250, 235, 140}, {150, 205, 130}, {70, 160, 170}, {60, 90, 160}}};
    const double at = std::clamp(share, 0.0, 1.0) * 3;
    const auto below = std::min<std::size_t>(2, static_cast<std::size_t>(at));
    Colour c{};
    for (std::size_t a = 0; a < 3; ++a)
        c[a] = static_cast<std::uint8_t>(stops[below][a] + (at - static_cast<double>(below)) * (stops[below + 1][a] - stops[below][a]));
    return c;
}

/// A length of one, two or five times a power of ten, at most the one given.
double round_length(double most) {
    const double power = std::pow(10, std::floor(std::log10(most)));
    for (const double n : {5.0, 2.0})
        if (n * power <= most) return n * power;
    return power;
}

/// A bar with its length below the picture.
void draw_scale(Canvas& canvas, const Canvas::Place& at, double scale, double most_pixels, const std::string& unit) {
    const double length = round_length(most_pixels / scale);
    canvas.line(at, {at[0] + length * scale, at[1]}, 3, black);
    canvas.text({at[0], at[1] + 5}, short_number(length) + unit, 1.5, black);
}

std::string unit_of(const CornerPointGrid& grid) {
    const std::string& unit = grid.info.crs.axis_units[0];
    return unit.empty() ? std::string() : " " + unit;
}

/// Columns on a side of a face of a fault get `mark` called with the column and the side.
template <class Mark>
void each_fault_side(const CornerPointGrid& grid, const Mark& mark) {
    for (const auto& fault : grid.faults) {
        for (const auto& box : fault.boxes) {
            for (std::uint32_t j = box.first[1]; j <= box.last[1]; ++j) {
                for (std::uint32_t i = box.first[0]; i <= box.last[0]; ++i) mark(i, j, box.face);
            }
        }
    }
}

void draw_columns(const CornerPointGrid& grid, double level, const View& view, Canvas& canvas, std::array<double, 2>& range) {
    range = {1e300, -1e300};
    for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            if (const auto k = first_active(grid, i, j)) {
                range[0] = std::min(range[0], top_depth(grid, i, j, *k));
                range[1] = std::max(range[1], top_depth(grid, i, j, *k));
            }
        }
    }
    const bool flat = !(range[1] - range[0] > 1e-6 * std::abs(range[1]));
    const bool edges = std::max(grid.dims[0], grid.dims[1]) <= 250;
    for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            const auto k = first_active(grid, i, j);
            if (!k) continue;
            std::array<Canvas::Place, 4> places{};
            const auto corners = column_corners(grid, i, j, level);
            for (std::size_t c = 0; c < 4; ++c) places[c] = view.at(corners[c]);
            canvas.fill(places, by_depth(flat ? 0.5 : (top_depth(grid, i, j, *k) - range[0]) / (range[1] - range[0])));
            if (edges) canvas.path(places, 0.6, edge, true);
        }
    }
}

void draw_fault_sides(const CornerPointGrid& grid, double level, const View& view, Canvas& canvas) {
    each_fault_side(grid, [&](std::uint32_t i, std::uint32_t j, CellFace face) {
        const auto c = column_corners(grid, i, j, level);
        switch (face) {
            case CellFace::i_minus:
                return canvas.line(view.at(c[0]), view.at(c[3]), 4, red);
            case CellFace::i_plus:
                return canvas.line(view.at(c[1]), view.at(c[2]), 4, red);
            case CellFace::j_minus:
                return canvas.line(view.at(c[0]), view.at(c[1]), 4, red);
            case CellFace::j_plus:
                return canvas.line(view.at(c[3]), view.at(c[2]), 4, red);
            default:
                return;
        }
    });
}

void draw_path(const gridding::Path& path, const View& view, Canvas& canvas, double thickness, Colour colour, bool closed) {
    std::vector<Canvas::Place> places;
    for (const Point& p : path) places.push_back(view.at(p));
    canvas.path(places, thickness, colour, closed);
}

/// The columns of a row, in order.
std::vector<std::array<std::uint32_t, 2>> columns_of(const CornerPointGrid& grid, const GridRow& row) {
    std::vector<std::array<std::uint32_t, 2>> columns;
    for (std::uint32_t n = 0; n < grid.dims[row.along_i ? 0 : 1]; ++n)
        columns.push_back(row.along_i ? std::array{n, row.number} : std::array{row.number, n});
    return columns;
}

/// The two ends of a cell along its row, at the pillars of lower J or I: upper and lower point of each.
std::array<std::array<Vec3, 2>, 2> ends_of(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k, bool along_i) {
    const auto c = cell_corners(grid, i, j, k);
    const std::size_t far = along_i ? 1 : 2;
    return {std::array{c[0], c[4]}, std::array{c[far], c[far + 4]}};
}

/// A line in plan with the length along it.
struct SectionLine {
    Point from{}, direction{};
    double length = 0;
    double along(const Vec3& p) const { return (p[0] - from[0]) * direction[0] + (p[1] - from[1]) * direction[1]; }
    double beside(const Vec3& p) const { return (p[1] - from[1]) * direction[0] - (p[0] - from[0]) * direction[1]; }
    Point at(double s) const { return {from[0] + s * direction[0], from[1] + s * direction[1]}; }
};

SectionLine line_of(const CornerPointGrid& grid, const GridRow& row) {
    const auto columns = columns_of(grid, row);
    const std::uint32_t k = grid.dims[2] / 2;
    const Vec3 a = ends_of(grid, columns.front()[0], columns.front()[1], k, row.along_i)[0][0];
    const Vec3 b = ends_of(grid, columns.back()[0], columns.back()[1], k, row.along_i)[1][0];
    SectionLine line{{a[0], a[1]}, {b[0] - a[0], b[1] - a[1]}, 0};
    line.length = std::hypot(line.direction[0], line.direction[1]);
    if (line.length > 0) line.direction = {line.direction[0] / line.length, line.direction[1] / line.length};
    return line;
}

void draw_sheet(const gridding::Sheet& sheet, const SectionLine& line, const View& view, Canvas& canvas, Colour colour) {
    for (const Triangle& t : sheet.triangles) {
        std::vector<Canvas::Place> cut;
        for (std::size_t e = 0; e < 3; ++e) {
            const Vec3 &p = sheet.vertices[t[e]], &q = sheet.vertices[t[(e + 1) % 3]];
            const double a = line.beside(p), b = line.beside(q);
            if ((a < 0) == (b < 0)) continue;
            const double share = a / (a - b), along = line.along(p) + share * (line.along(q) - line.along(p));
            cut.push_back(view.at({along, p[2] + share * (q[2] - p[2])}));
        }
        if (cut.size() == 2) canvas.line(cut[0], cut[1], 2, colour);
    }
}

void draw_map_horizon(const gridding::HorizonMap& map, const SectionLine& line, const View& view, Canvas& canvas) {
    const gridding::MapReader reader(map);
    const auto samples = static_cast<std::size_t>(std::clamp(line.length / reader.step() * 2, 200.0, 20000.0));
    std::vector<gridding::Hit> hits;
    std::optional<Canvas::Place> before;
    for (std::size_t n = 0; n <= samples; ++n) {
        const double along = line.length * static_cast<double>(n) / static_cast<double>(samples);
        hits.clear();
        reader.hits(line.at(along), hits);
        if (hits.empty()) {
            before.reset();
            continue;
        }
        const Canvas::Place here = view.at({along, hits[0].depth});
        if (before) canvas.line(*before, here, 2, black);
        before = here;
    }
}

Extent section_extent(const CornerPointGrid& grid, const GridRow& row, const SectionLine& line) {
    Extent extent;
    for (const auto& [i, j] : columns_of(grid, row)) {
        for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
            if (!grid.is_active(grid.cell(i, j, k))) continue;
            for (const auto& end : ends_of(grid, i, j, k, row.along_i)) {
                for (const Vec3& p : end) extent.add({line.along(p), p[2]});
            }
        }
    }
    if (extent.low[0] > extent.high[0]) return {{0, 0}, {1, 1}};
    return extent;
}

void draw_section_cells(const GridDrawing& drawing, const GridRow& row, const SectionLine& line, const View& view, Canvas& canvas) {
    const CornerPointGrid& grid = drawing.grid;
    for (std::size_t z = 0; z < drawing.zones.size(); ++z) {
        for (std::uint32_t k = drawing.zones[z].first_layer; k <= drawing.zones[z].last_layer; ++k) {
            for (const auto& [i, j] : columns_of(grid, row)) {
                if (!grid.is_active(grid.cell(i, j, k))) continue;
                const auto ends = ends_of(grid, i, j, k, row.along_i);
                const auto at = [&](const Vec3& p) { return view.at({line.along(p), p[2]}); };
                const std::array<Canvas::Place, 4> places{at(ends[0][0]), at(ends[1][0]), at(ends[1][1]), at(ends[0][1])};
                canvas.fill(places, zone_colours[z % zone_colours.size()]);
                canvas.path(places, 0.6, edge, true);
            }
        }
    }
}

void draw_depth_axis(const Extent& extent, const View& view, Canvas& canvas) {
    const double step = round_length(extent.size(1) / 4);
    for (double depth = std::ceil(extent.low[1] / step) * step; depth <= extent.high[1]; depth += step) {
        const Canvas::Place at = view.at({extent.low[0], depth});
        canvas.line({at[0] - 6, at[1]}, at, 1, black);
        const std::string words = short_number(std::abs(depth) < 1e-9 * step ? 0 : depth);
        canvas.text({at[0] - 10 - Canvas::text_width(words, 1.5), at[1] - 5}, words, 1.5, black);
    }
}

std::string row_name(const GridRow& row) { return std::string(row.along_i ? "J = " : "I = ") + std::to_string(row.number + 1); }

}  // namespace

GridRow telling_row(const CornerPointGrid& grid) {
    std::array<std::vector<std::uint64_t>, 2> crossed{std::vector<std::uint64_t>(grid.dims[1]), std::vector<std::uint64_t>(grid.dims[0])};
    each_fault_side(grid, [&](std::uint32_t i, std::uint32_t j, CellFace face) {
        if (!first_active(grid, i, j)) return;
        if (face == CellFace::i_minus || face == CellFace::i_plus) ++crossed[0][j];
        if (face == CellFace::j_minus || face == CellFace::j_plus) ++crossed[1][i];
    });
    GridRow best;
    std::array<double, 3> most{-1, 0, 0};
    for (const bool along_i : {true, false}) {
        const auto& own = crossed[along_i ? 0 : 1];
        for (std::uint32_t n = 0; n < own.size(); ++n) {
            const GridRow row{along_i, n};
            double active = 0;
            for (const auto& [i, j] : columns_of(grid, row)) active += first_active(grid, i, j) ? 1 : 0;
            const double off = std::abs(n + 0.5 - static_cast<double>(own.size()) / 2) / static_cast<double>(own.size());
            const std::array<double, 3> score{static_cast<double>(own[n]), active, -off};
            if (score <= most) continue;
            most = score;
            best = row;
        }
    }
    return best;
}

std::string grid_map(const GridDrawing& drawing, const GridRow& row) {
    const CornerPointGrid& grid = drawing.grid;
    const double level = gridding::mid_level(drawing.structure);  // where traces of faults are
    Extent extent;
    for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            if (first_active(grid, i, j))
                for (const Point& p : column_corners(grid, i, j, level)) extent.add(p);
        }
    }
    if (extent.low[0] > extent.high[0]) extent = {{0, 0}, {1, 1}};
    const double scale = 1100 / std::max(extent.size(0), extent.size(1));
    const double width = std::max(480.0, extent.size(0) * scale), height = std::max(60.0, extent.size(1) * scale);
    Canvas canvas(static_cast<std::uint32_t>(width + 2 * margin), static_cast<std::uint32_t>(height + 2 * margin + 3 * line_height), white);
    const View view{{extent.low[0], extent.high[1]}, {scale, -scale}, {margin, margin}};
    std::array<double, 2> range{};
    draw_columns(grid, level, view, canvas, range);
    draw_fault_sides(grid, level, view, canvas);
    for (const auto& fault : drawing.structure.faults) {
        draw_path(fault.trace, view, canvas, 1.5, black, false);
        for (const auto& polygon : fault.polygons) draw_path(polygon, view, canvas, 1, black, true);
    }
    const SectionLine line = line_of(grid, row);
    canvas.line(view.at(line.at(0)), view.at(line.at(line.length)), 1.5, blue);
    canvas.text({margin, margin / 2 - 6}, "faces of faults red, faults of the model black, section " + row_name(row) + " blue", 1.5, grey);
    const double below = margin + height + 20;
    draw_scale(canvas, {margin, below}, scale, 250, unit_of(grid));
    for (int n = 0; n < 100; ++n) {
        const double left = margin + 2 * n;
        const std::array<Canvas::Place, 4> box{
            Canvas::Place{left, below + 30}, {left + 2, below + 30}, {left + 2, below + 42}, {left, below + 42}};
        canvas.fill(box, by_depth(n / 99.0));
    }
    canvas.text({margin, below + 46}, "top from " + short_number(range[0]) + " to " + short_number(range[1]) + " deep", 1.5, black);
    return canvas.png();
}

std::string grid_section(const GridDrawing& drawing, const GridRow& row) {
    const CornerPointGrid& grid = drawing.grid;
    const SectionLine line = line_of(grid, row);
    const Extent extent = section_extent(grid, row, line);
    const double width = 1300, height = 520, left = 100;
    const double names = line_height * static_cast<double>(drawing.zones.size() + 1);
    Canvas canvas(static_cast<std::uint32_t>(left + width + margin), static_cast<std::uint32_t>(height + 2 * margin + names + 20), white);
    const View view{extent.low, {width / extent.size(0), height / extent.size(1)}, {left, margin}};
    draw_section_cells(drawing, row, line, view, canvas);
    for (const auto& horizon : drawing.structure.horizons) {
        if (const auto* map = std::get_if<gridding::HorizonMap>(&horizon.shape)) draw_map_horizon(*map, line, view, canvas);
        else draw_sheet(std::get<gridding::Sheet>(horizon.shape), line, view, canvas, black);
    }
    for (const auto& fault : drawing.structure.faults) draw_sheet(fault.sheet, line, view, canvas, red);
    draw_depth_axis(extent, view, canvas);
    canvas.text({left, margin / 2 - 6},
                "section " + row_name(row) + ": horizons of the model black, its faults red; depths " +
                    rounded(view.scale[1] / view.scale[0]) + " times as high",
                1.5, grey);
    const double below = margin + height + 20;
    draw_scale(canvas, {left, below}, view.scale[0], 250, unit_of(grid));
    for (std::size_t z = 0; z < drawing.zones.size(); ++z) {
        const double top = below + 30 + line_height * static_cast<double>(z);
        const std::array<Canvas::Place, 4> box{Canvas::Place{left, top}, {left + 24, top}, {left + 24, top + 12}, {left, top + 12}};
        canvas.fill(box, zone_colours[z % zone_colours.size()]);
        canvas.text({left + 32, top + 1}, drawing.zones[z].name, 1.5, black);
    }
    return canvas.png();
}

}  // namespace geomend
