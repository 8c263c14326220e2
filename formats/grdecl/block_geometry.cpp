// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "formats/grdecl/deck.h"
#include "formats/grdecl/number_array.h"

namespace geomend::grdecl {

namespace {

/// Sizes of blocks along one axis: an array of cells or a vector of the axis.
struct Sizes {
    std::string name;
    std::vector<double> cells;  ///< empty: `vector` holds for all
    std::vector<double> vector;

    bool given() const { return !cells.empty() || !vector.empty(); }
    double at(const Dims& d, std::size_t axis, std::size_t i, std::size_t j, std::size_t k) const {
        if (!vector.empty()) return vector[axis == 0 ? i : axis == 1 ? j : k];
        return cells[i + d[0] * (j + std::size_t{d[1]} * k)];
    }
};

/// Layers without a value are like the one above. False where the first layer has none.
bool fill_down(std::vector<double>& values, const Dims& d) {
    const std::size_t layer = std::size_t{d[0]} * d[1];
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
        if (values[cell] != unset_real) continue;
        if (cell < layer) return false;
        values[cell] = values[cell - layer];
    }
    return true;
}

Sizes take_sizes(GridText& text, std::initializer_list<const char*> names, std::size_t axis) {
    Sizes sizes;
    for (const char* name : names) {
        auto array = text.take(name);
        if (!array) continue;
        sizes.name = name;
        sizes.cells = std::get<std::vector<double>>(std::move(array->values));
    }
    sizes.vector = std::move(text.widths[axis]);
    if (!sizes.vector.empty()) sizes.cells.clear();
    return sizes;
}

bool has_any(GridText& text, std::initializer_list<const char*> names, std::size_t axis) {
    return !text.widths[axis].empty() || std::ranges::any_of(names, [&](const char* n) { return text.find(n) != nullptr; });
}

/// Positions of the pillars along one horizontal axis, for each line of blocks beside them.
std::vector<double> edges(const Sizes& sizes, const Dims& d, std::size_t axis, double origin) {
    const std::size_t across = axis == 0 ? d[1] : d[0];
    const std::size_t along = d[axis];
    std::vector<double> at((along + 1) * across);
    for (std::size_t line = 0; line < across; ++line) {
        double x = origin;
        for (std::size_t n = 0; n <= along; ++n) {
            at[n + (along + 1) * line] = x;
            if (n < along) x += axis == 0 ? sizes.at(d, axis, n, line, 0) : sizes.at(d, axis, line, n, 0);
        }
    }
    return at;
}

std::uint64_t irregular(const Sizes& x, const Sizes& y, const Dims& d) {
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < d[2]; ++k) {
        for (std::size_t j = 0; j < d[1]; ++j) {
            for (std::size_t i = 0; i < d[0]; ++i) {
                if (x.at(d, 0, i, j, k) != x.at(d, 0, i, 0, 0) || y.at(d, 1, i, j, k) != y.at(d, 1, 0, j, 0)) ++count;
            }
        }
    }
    return count;
}

/// Depths of the tops of all cells: given ones, else the bottom of the cell above.
bool stack_tops(std::vector<double>& tops, const Sizes& dz, const Dims& d) {
    for (std::size_t k = 0; k < d[2]; ++k) {
        for (std::size_t j = 0; j < d[1]; ++j) {
            for (std::size_t i = 0; i < d[0]; ++i) {
                const std::size_t layer = std::size_t{d[0]} * d[1], cell = i + d[0] * j + layer * k;
                if (tops[cell] != unset_real) continue;
                if (k == 0) return false;
                tops[cell] = tops[cell - layer] + dz.at(d, 2, i, j, k - 1);
            }
        }
    }
    return true;
}

void depths_of_blocks(GridText& text, const std::vector<double>& tops, const Sizes& dz, const Dims& d) {
    text.depths.resize(8 * cells_of(d));
    for (std::size_t k = 0; k < d[2]; ++k) {
        for (std::size_t j = 0; j < d[1]; ++j) {
            for (std::size_t i = 0; i < d[0]; ++i) {
                const double top = tops[i + d[0] * (j + std::size_t{d[1]} * k)];
                const double bottom = top + dz.at(d, 2, i, j, k);
                for (unsigned c = 0; c < 8; ++c) text.depths[corner_index(d, i, j, k, c)] = c < 4 ? top : bottom;
            }
        }
    }
}

/// DEPTHZ: a depth at each pillar, below which the layers follow each other.
void depths_of_corners(GridText& text, const Sizes& dz, const Dims& d) {
    text.depths.resize(8 * cells_of(d));
    std::vector<double> top = text.corner_tops;
    for (std::size_t k = 0; k < d[2]; ++k) {
        for (std::size_t j = 0; j < d[1]; ++j) {
            for (std::size_t i = 0; i < d[0]; ++i) {
                for (unsigned c = 0; c < 8; ++c) {
                    const double z = top[i + (c & 1u) + (std::size_t{d[0]} + 1) * (j + ((c >> 1) & 1u))];
                    text.depths[corner_index(d, i, j, k, c)] = c < 4 ? z : z + dz.at(d, 2, i, j, k);
                }
            }
        }
        for (double& z : top) z += dz.at(d, 2, 0, 0, k);
    }
}

/// Straight pillars at the edges of the blocks, from the least to the largest depth beside them.
void pillars_of_blocks(GridText& text, const std::vector<double>& x, const std::vector<double>& y, const Dims& d) {
    text.pillars.resize(6 * pillar_count(d));
    for (std::size_t j = 0; j <= d[1]; ++j) {
        for (std::size_t i = 0; i <= d[0]; ++i) {
            double* p = text.pillars.data() + 6 * (i + (std::size_t{d[0]} + 1) * j);
            p[0] = p[3] = x[i + (std::size_t{d[0]} + 1) * std::min<std::size_t>(j, d[1] - 1)];
            p[1] = p[4] = y[j + (std::size_t{d[1]} + 1) * std::min<std::size_t>(i, d[0] - 1)];
            p[2] = HUGE_VAL;
            p[5] = -HUGE_VAL;
            for (unsigned c = 0; c < 4; ++c) {  // this pillar is corner c of the cell at (i - c&1, j - c>>1)
                if (i < (c & 1u) || j < (c >> 1) || i - (c & 1u) >= d[0] || j - (c >> 1) >= d[1]) continue;
                p[2] = std::min(p[2], text.depths[corner_index(d, i - (c & 1u), j - (c >> 1), 0, c)]);
                p[5] = std::max(p[5], text.depths[corner_index(d, i - (c & 1u), j - (c >> 1), d[2] - 1, c + 4)]);
            }
        }
    }
}

/// Radii and angles of pillars into x and y: the sides of SPIDER grids run straight from pillar to pillar.
void straighten(std::vector<double>& pillars) {
    for (std::size_t p = 0; p + 2 < pillars.size(); p += 3) {
        const double point[6] = {pillars[p], pillars[p + 1], pillars[p + 2], pillars[p], pillars[p + 1], pillars[p + 2]};
        const Vec3 at = pillar_point(point, pillars[p + 2], true);
        pillars[p] = at[0];
        pillars[p + 1] = at[1];
    }
}

Failure lacking(const Input& input, const std::string& what) {
    return unreadable("F012", {input.name()},
                      "expected " + what + " for a grid of blocks, found none in the text, or none for the first layer");
}

}  // namespace

OptionalFailure make_block_geometry(GridText& text, const Input& input, std::uint32_t layers, std::uint64_t& room,
                                    std::vector<Finding>& findings) {
    if (!text.pillars.empty() || !text.depths.empty() || !text.dims) return {};
    const Dims d{(*text.dims)[0], (*text.dims)[1], layers};
    text.radial = text.radial || (text.grid.cylindrical && (text.find("DR") != nullptr || text.find("DTHETA") != nullptr));
    const bool radii = text.radial && text.inner_radius && text.outer_radius && !has_any(text, {"DX", "DR"}, 0);
    if (!radii && !has_any(text, {"DX", "DR"}, 0)) return {};
    if (!has_any(text, {"DY", "DTHETA"}, 1) || !has_any(text, {"DZ"}, 2)) return {};
    if (text.corner_tops.empty() && text.find("TOPS") == nullptr) return lacking(input, "TOPS (or DEPTHZ)");
    const std::uint64_t made = 9 * cells_of(d) + 6 * pillar_count(d);
    if (made > room)
        return unreadable("F014", {input.name()},
                          "a grid of " + std::to_string(cells_of(d)) +
                              " blocks asks for more than a text of this size should: --option max-values=N raises the limit");
    room -= made;

    Sizes dx = take_sizes(text, {"DX", "DR"}, 0), dy = take_sizes(text, {"DY", "DTHETA"}, 1), dz = take_sizes(text, {"DZ"}, 2);
    double inner = text.radial ? text.inner_radius.value_or(0) : 0;
    if (radii) {
        if (inner <= 0 || *text.outer_radius <= inner) return lacking(input, "INRAD above 0 and OUTRAD beyond it");
        for (std::size_t i = 0; i < d[0]; ++i) {
            const auto at = [&](std::size_t n) { return inner * std::pow(*text.outer_radius / inner, static_cast<double>(n) / d[0]); };
            dx.vector.push_back(at(i + 1) - at(i));
        }
    }
    for (Sizes* s : {&dx, &dy, &dz}) {
        if (!s->cells.empty() && !fill_down(s->cells, *text.dims)) return lacking(input, s->name);
    }
    while (!dz.vector.empty() && dz.vector.size() < d[2]) dz.vector.push_back(dz.vector.back());
    if (!text.corner_tops.empty()) {
        depths_of_corners(text, dz, d);
    } else {
        auto tops = std::get<std::vector<double>>(std::move(text.take("TOPS")->values));
        if (!stack_tops(tops, dz, d)) return lacking(input, "TOPS");
        depths_of_blocks(text, tops, dz, d);
    }
    const std::vector<double> along_y = edges(dy, d, 1, 0);
    pillars_of_blocks(text, edges(dx, d, 0, inner), along_y, d);
    if (const double most = along_y.empty() ? 0 : std::ranges::max(along_y); text.spider && most > 360 * (1 + 1e-6)) {
        findings.push_back(
            finding("C31", {input.name()}, "the cells around the axis take " + number_text(most) + " degrees together: more than 360"));
        findings.back().points.push_back({0, 0, text.pillars[2]});  // the axis, where the first pillar begins
    }
    if (text.spider) straighten(text.pillars);
    text.grid.cylindrical = text.radial && !text.spider;
    if (const std::uint64_t odd = irregular(dx, dy, d); odd > 0) {
        findings.push_back(finding("F113", {input.name()},
                                   "blocks of one column or row differ in size: the pillars stand where the first layer has them; the "
                                   "sizes are kept as properties",
                                   odd));
        for (Sizes* s : {&dx, &dy}) {
            if (!s->cells.empty()) text.arrays.push_back({s->name, std::move(s->cells), Section::grid});
        }
    }
    return {};
}

}  // namespace geomend::grdecl
