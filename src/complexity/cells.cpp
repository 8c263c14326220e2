// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "complexity/parts.h"
#include "geometry/site_grid.h"

// What lies in each Voronoi cell: surfaces and lines are clipped by the planes between sites, and pieces of one surface
// are joined where the edge between them passes through the cell, too.

namespace geomend::complexity {

namespace {

// The sites around each one, the nearest first: those whose planes can cut what is near it.
class Neighbours {
public:
    explicit Neighbours(std::span<const Vec3> sites) : sites_(sites), grid_(sites), lists_(sites.size()) {
        const double spacing = typical_spacing();
        parallel_blocks(sites.size(), 64, [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> near;
            for (std::size_t s = first; s < last; ++s) {
                double reach = 3 * spacing;
                for (grid_.within(sites[s], reach, near); near.size() < std::min<std::size_t>(kept, sites.size()); reach *= 2)
                    grid_.within(sites[s], 2 * reach, near);
                lists_[s] = sorted(s, near);
                if (lists_[s].size() > kept) lists_[s].resize(kept);
            }
        });
    }

    const SiteGrid& grid() const { return grid_; }
    const Vec3& site(std::uint32_t s) const { return sites_[s]; }

    /// Calls cut(n) for the sites around s in the order of their distance, up to reach(): beyond that no plane can cut. It may
    /// shrink with each cut, and is negative where nothing is left to cut.
    template <class Reach, class Cut>
    void around(std::uint32_t s, const Reach& reach, const Cut& cut) const {
        for (const std::uint32_t n : lists_[s]) {
            if (length(minus(sites_[n], sites_[s])) > reach()) return;
            cut(n);
        }
        if (lists_[s].size() + 1 >= sites_.size() || reach() < 0) return;
        std::vector<std::uint32_t> further;  // something large in a cell
        grid_.within(sites_[s], reach(), further);
        further = sorted(s, further);
        for (std::size_t i = lists_[s].size(); i < further.size(); ++i) {
            if (length(minus(sites_[further[i]], sites_[s])) > reach()) return;
            cut(further[i]);
        }
    }

private:
    static constexpr std::size_t kept = 80;

    double typical_spacing() const {
        double longest = 0;
        Vec3 low = sites_[0], high = sites_[0];
        for (const Vec3& s : sites_) {
            for (std::size_t a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], s[a]);
                high[a] = std::max(high[a], s[a]);
            }
        }
        for (std::size_t a = 0; a < 3; ++a) longest = std::max(longest, high[a] - low[a]);
        return std::max(longest / std::cbrt(static_cast<double>(sites_.size())), std::numeric_limits<double>::min());
    }

    std::vector<std::uint32_t> sorted(std::size_t s, const std::vector<std::uint32_t>& near) const {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (const std::uint32_t n : near) {
            if (n != s) order.emplace_back(length(minus(sites_[n], sites_[s])), n);
        }
        std::ranges::sort(order);
        std::vector<std::uint32_t> list;
        for (const auto& [distance, n] : order) list.push_back(n);
        return list;
    }

    std::span<const Vec3> sites_;
    SiteGrid grid_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

// How much nearer a point is to site s than to n: positive on the side of s, linear along any segment.
double nearer(const Vec3& p, const Vec3& s, const Vec3& n) {
    const Vec3 away = minus(n, s), middle{(s[0] + n[0]) / 2, (s[1] + n[1]) / 2, (s[2] + n[2]) / 2};
    return dot(minus(middle, p), away);
}

// The part of a segment in the cell of s, as parameters; empty where from >= to.
struct Interval {
    double from = 0, to = 1;
    bool empty() const { return !(from < to); }
};

Interval clipped_segment(const Neighbours& around, std::uint32_t s, const Vec3& a, const Vec3& b) {
    const Vec3& site = around.site(s);
    Interval part;
    const auto reach = [&] {
        const Vec3 along = minus(b, a);
        return part.empty() ? -1
                            : 2 * std::max(length(minus(moved(a, along, part.from), site)), length(minus(moved(a, along, part.to), site)));
    };
    around.around(s, reach, [&](std::uint32_t n) {
        const double at_a = nearer(a, site, around.site(n)), at_b = nearer(b, site, around.site(n));
        if (at_a >= 0 && at_b >= 0) return;
        if (at_a < 0 && at_b < 0) part.to = part.from;
        else if (at_a < 0) part.from = std::max(part.from, at_a / (at_a - at_b));
        else part.to = std::min(part.to, at_a / (at_a - at_b));
    });
    return part;
}

// The part of a triangle in the cell of s: its area.
double clipped_area(const Neighbours& around, std::uint32_t s, const std::array<Vec3, 3>& triangle) {
    const Vec3& site = around.site(s);
    std::vector<Vec3> polygon(triangle.begin(), triangle.end()), next;
    const auto measured = [&] {
        double most = polygon.empty() ? -1 : 0;
        for (const Vec3& p : polygon) most = std::max(most, 2 * length(minus(p, site)));
        return most;
    };
    double reach = measured();
    around.around(
        s, [&] { return reach; },
        [&](std::uint32_t n) {
            next.clear();
            bool cut = false;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
                const double at_p = nearer(p, site, around.site(n)), at_q = nearer(q, site, around.site(n));
                if (at_p >= 0) next.push_back(p);
                else cut = true;
                if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) next.push_back(moved(p, minus(q, p), at_p / (at_p - at_q)));
            }
            if (!cut) return;
            if (next.size() < 3) next.clear();
            polygon.swap(next);
            reach = measured();
        });
    Vec3 twice{};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        twice = moved(twice, cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0])));
    return length(twice) / 2;
}

// Sites whose cells a ball may reach.
void sites_near(const Neighbours& around, const Vec3& centre, double radius, std::vector<std::uint32_t>& found) {
    const std::uint32_t nearest = around.grid().nearest(centre);
    const double distance = length(minus(around.site(nearest), centre));
    around.grid().within(centre, (distance + 2 * radius) * (1 + 1e-12), found);
    if (found.empty()) found.push_back(nearest);
}

// A piece of a surface: what of a triangle lies in one cell. Bit e of `edges`: so does a part of its edge e.
struct Piece {
    std::uint32_t site;
    std::uint8_t edges = 0;
};

struct Pieces {
    std::vector<std::uint64_t> first;  ///< per triangle, and the end
    std::vector<Piece> all;
};

class Clipper {
public:
    Clipper(const MeasuredModel& model, std::span<const Vec3> sites) : model_(model), around_(sites) {}

    Pieces pieces(const SurfaceTriangles& surface) const {
        const std::size_t count = surface.triangles.size();
        std::vector<std::vector<Piece>> of_triangle(count);
        parallel_blocks(count, 256, [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> near;
            for (std::size_t t = first; t < last; ++t) of_triangle[t] = pieces(surface.triangles[t], near);
        });
        Pieces pieces;
        for (const auto& some : of_triangle) {
            pieces.first.push_back(pieces.all.size());
            pieces.all.insert(pieces.all.end(), some.begin(), some.end());
        }
        pieces.first.push_back(pieces.all.size());
        return pieces;
    }

    /// The cells that a line passes through, in its order; each run of one site once.
    std::vector<std::uint32_t> cells_along(const BrepData::Line& line) const {
        std::vector<std::uint32_t> cells, near;
        std::vector<std::pair<double, std::uint32_t>> parts;
        for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i) {
            const Vec3 &a = model_.points[line.vertices[i].value], &b = model_.points[line.vertices[i + 1].value];
            const Vec3 half = moved(a, minus(b, a), 0.5);
            sites_near(around_, half, length(minus(half, a)), near);
            parts.clear();
            for (const std::uint32_t s : near) {
                const Interval part = clipped_segment(around_, s, a, b);
                if (!part.empty()) parts.emplace_back(part.from, s);
            }
            std::ranges::sort(parts);
            for (const auto& [from, s] : parts) {
                if (cells.empty() || cells.back() != s) cells.push_back(s);
            }
        }
        if (line.closed() && cells.size() > 1 && cells.front() == cells.back()) cells.pop_back();
        return cells;
    }

    std::uint32_t cell_of(const Vec3& p) const { return around_.grid().nearest(p); }

private:
    std::vector<Piece> pieces(const std::array<std::uint32_t, 3>& t, std::vector<std::uint32_t>& near) const {
        std::vector<Piece> found;
        const double area = model_.area(t);
        if (!(area > 0)) return found;
        const std::array<Vec3, 3> corners{model_.points[t[0]], model_.points[t[1]], model_.points[t[2]]};
        const Vec3 centre{(corners[0][0] + corners[1][0] + corners[2][0]) / 3, (corners[0][1] + corners[1][1] + corners[2][1]) / 3,
                          (corners[0][2] + corners[1][2] + corners[2][2]) / 3};
        double radius = 0;
        for (const Vec3& c : corners) radius = std::max(radius, length(minus(c, centre)));
        sites_near(around_, centre, radius, near);
        for (const std::uint32_t s : near) {
            if (near.size() > 1 && !(clipped_area(around_, s, corners) > 1e-12 * area)) continue;
            Piece piece{s, 7};
            for (std::size_t e = 0; e < 3 && near.size() > 1; ++e) {
                // The same way round for both triangles of an edge, so that they agree.
                const std::uint32_t a = std::min(t[e], t[(e + 1) % 3]), b = std::max(t[e], t[(e + 1) % 3]);
                if (clipped_segment(around_, s, model_.points[a], model_.points[b]).empty())
                    piece.edges = static_cast<std::uint8_t>(piece.edges & ~(1u << e));
            }
            found.push_back(piece);
        }
        return found;
    }

    const MeasuredModel& model_;
    Neighbours around_;
};

// Adds one to the surfaces of a cell for each connected piece in it.
void count_connected(const SurfaceTriangles& surface, const Pieces& pieces, std::vector<CellComplexity::Counts>& counts) {
    DisjointSets connected(pieces.all.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        for (std::uint64_t p = pieces.first[t]; p < pieces.first[t + 1]; ++p) {
            for (std::size_t e = 0; e < 3; ++e) {
                const std::uint32_t next = surface.across[t][e];
                if (next == no_index || next < t || (pieces.all[p].edges >> e & 1u) == 0) continue;
                for (std::uint64_t q = pieces.first[next]; q < pieces.first[next + 1]; ++q) {
                    if (pieces.all[q].site == pieces.all[p].site)
                        connected.join(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(q));
                }
            }
        }
    }
    for (std::uint32_t p = 0; p < connected.size(); ++p) {
        if (connected.root(p) == p) ++counts[pieces.all[p].site].surfaces;
    }
}

}  // namespace

std::vector<CellComplexity::Counts> counts_in_cells(const MeasuredModel& model, std::span<const Vec3> sites, const Monitor* monitor) {
    const Clipper clipper(model, sites);
    std::vector<CellComplexity::Counts> counts(sites.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> regions;  // (site, region)
    for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
        if (monitor != nullptr && monitor->stopped()) return counts;
        const Pieces pieces = clipper.pieces(model.surfaces[s]);
        if (model.surface_in_box[s] == 0) count_connected(model.surfaces[s], pieces, counts);
        for (const RegionId region : model.brep.surfaces[s].regions) {
            if (!region.valid()) continue;
            for (const Piece& piece : pieces.all) regions.emplace_back(piece.site, region.value);
        }
        std::ranges::sort(regions);
        regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
    }
    for (const auto& [site, region] : regions) ++counts[site].regions;
    for (auto& c : counts) c.regions = std::max(c.regions, 1u);  // no boundary in it: all of it lies in one region
    for (std::size_t l = 0; l < model.brep.lines.size(); ++l) {
        if (model.line_in_box[l] != 0) continue;
        for (const std::uint32_t s : clipper.cells_along(model.brep.lines[l])) ++counts[s].lines;
    }
    for (std::size_t c = 0; c < model.brep.corners.size(); ++c) {
        if (model.corner_left_out[c] == 0) ++counts[clipper.cell_of(model.points[model.brep.corners[c].vertex.value])].corners;
    }
    return counts;
}

}  // namespace geomend::complexity
