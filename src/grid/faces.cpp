// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/faces.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "grid/connections.h"
#include "grid/pillar_nodes.h"

namespace geomend::grid {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;
using Edge = std::array<double, 2>;

// The plane between two columns: its number and its pillars.
struct Between {
    std::size_t plane;
    std::size_t pillar_a, pillar_b;  // without the shift of the set of coordinate lines
};

struct Crossing {
    double u;
    std::uint32_t node;
};

class Maker {
public:
    explicit Maker(const CornerPointGrid& grid)
        : grid_(grid), present_(present_cells(grid)), nodes_(grid, present_), set_size_(pillar_count(grid.dims)) {
        out_.present = present_;
        out_.points = nodes_.points(grid);
    }

    GridFaces make() {
        for (std::uint32_t j = 0; j <= grid_.dims[1]; ++j) {
            for (std::uint32_t i = 0; i <= grid_.dims[0]; ++i) {
                if (j < grid_.dims[1]) plane_across_i(i, j);
                if (i < grid_.dims[0]) plane_across_j(i, j);
            }
        }
        for (std::uint32_t j = 0; j < grid_.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < grid_.dims[0]; ++i) stack(i, j);
        }
        return std::move(out_);
    }

private:
    std::size_t plane_i(std::uint32_t i, std::uint32_t j) const { return i + (std::size_t{grid_.dims[0]} + 1) * j; }
    std::size_t plane_j(std::uint32_t i, std::uint32_t j) const {
        return (std::size_t{grid_.dims[0]} + 1) * grid_.dims[1] + i + std::size_t{grid_.dims[0]} * j;
    }

    void plane_across_i(std::uint32_t i, std::uint32_t j) {
        const std::size_t lines = std::size_t{grid_.dims[0]} + 1, a = i + lines * j;
        const Between between{plane_i(i, j), a, a + lines};
        if (i > 0 && i < grid_.dims[0])
            return pair({i - 1, j, true, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a + lines)}, between);
        border(i > 0 ? i - 1 : 0, j, i > 0 ? CellFace::i_plus : CellFace::i_minus, between);
    }

    void plane_across_j(std::uint32_t i, std::uint32_t j) {
        const std::size_t a = i + (std::size_t{grid_.dims[0]} + 1) * j;
        const Between between{plane_j(i, j), a, a + 1};
        if (j > 0 && j < grid_.dims[1])
            return pair({i, j - 1, false, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a + 1)}, between);
        border(i, j > 0 ? j - 1 : 0, j > 0 ? CellFace::j_plus : CellFace::j_minus, between);
    }

    // The sides of a column at the edge of the grid, whole.
    void border(std::uint32_t i, std::uint32_t j, CellFace face, const Between& between) {
        sides_.first.resize(grid_.dims[2]);
        column_sides(grid_, i, j, face, sides_.first);
        for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
            const auto cell = static_cast<std::uint32_t>(grid_.cell(i, j, k));
            if (out_.present[cell] != 0) whole_side(cell, k, face, sides_.first[k], between);
        }
    }

    void whole_side(std::uint32_t cell, std::uint32_t k, CellFace face, const Side& side, const Between& between) {
        const std::size_t a = between.pillar_a + shift(k), b = between.pillar_b + shift(k);
        polygon_.clear();
        polygon_.push_back(nodes_.id(a, side.top_a));
        polygon_.push_back(nodes_.id(b, side.top_b));
        down(b, side.top_b, side.bottom_b);
        if (side.bottom_b != side.top_b) polygon_.push_back(nodes_.id(b, side.bottom_b));
        if (side.bottom_a != side.top_a) polygon_.push_back(nodes_.id(a, side.bottom_a));
        up(a, side.bottom_a, side.top_a);
        add(cell, nobody, face);
    }

    void pair(const ColumnPair& columns, const Between& between) {
        load(grid_, out_.present, columns, sides_);
        const auto first = static_cast<std::uint32_t>(grid_.cell(columns.i, columns.j, 0));
        const std::uint32_t second = first + (columns.along_i ? 1 : grid_.dims[0]), layer = grid_.dims[0] * grid_.dims[1];
        const CellFace face = columns.along_i ? CellFace::i_plus : CellFace::j_plus;
        const CellFace back = columns.along_i ? CellFace::i_minus : CellFace::j_minus;
        if (!sides_.ordered || !grid_.reservoirs.empty()) return unmatched(first, second, face, back, between);
        each_contact(sides_, [&](std::uint32_t k, std::uint32_t m) {
            shared(sides_.first[k], sides_.second[m], first + k * layer, second + m * layer, face, between);
        });
        voids(sides_.second, sides_.second_active, sides_.first, sides_.first_active, open_);
        free_sides(sides_.first, sides_.first_active, first, face, between);
        voids(sides_.first, sides_.first_active, sides_.second, sides_.second_active, open_);
        free_sides(sides_.second, sides_.second_active, second, back, between);
    }

    void unmatched(std::uint32_t first, std::uint32_t second, CellFace face, CellFace back, const Between& between) {
        ++out_.unmatched_columns;
        const std::uint32_t layer = grid_.dims[0] * grid_.dims[1];
        for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
            if (sides_.first_active[k] != 0) whole_side(first + k * layer, k, face, sides_.first[k], between);
            if (sides_.second_active[k] != 0) whole_side(second + k * layer, k, back, sides_.second[k], between);
        }
    }

    // Where a column turns nothing to its neighbour: above, between and below its cells.
    static void voids(std::span<const Side> sides, std::span<const std::uint8_t> active, std::span<const Side> others,
                      std::span<const std::uint8_t> others_active, std::vector<Side>& open) {
        double least = 0, most = 0;
        bool any = false;
        const auto widen = [&](const Side& s) {
            const double low = std::min(s.top_a, s.top_b), high = std::max(s.bottom_a, s.bottom_b);
            least = any ? std::min(least, low) : low;
            most = any ? std::max(most, high) : high;
            any = true;
        };
        for (std::size_t k = 0; k < sides.size(); ++k) {
            if (active[k] != 0) widen(sides[k]);
            if (others_active[k] != 0) widen(others[k]);
        }
        open.clear();
        if (!any) return;
        const double beyond = most - least + 1;
        Edge above{least - beyond, least - beyond};
        for (std::size_t k = 0; k < sides.size(); ++k) {
            if (active[k] == 0) continue;
            const Side& s = sides[k];
            if (above[0] != s.top_a || above[1] != s.top_b) open.push_back({above[0], above[1], s.top_a, s.top_b});
            above = {s.bottom_a, s.bottom_b};
        }
        open.push_back({above[0], above[1], most + beyond, most + beyond});
    }

    void free_sides(std::span<const Side> sides, std::span<const std::uint8_t> active, std::uint32_t column, CellFace face,
                    const Between& between) {
        const std::uint32_t layer = grid_.dims[0] * grid_.dims[1];
        std::size_t start = 0;
        for (std::uint32_t k = 0; k < sides.size(); ++k) {
            if (active[k] == 0) continue;
            const Side& s = sides[k];
            while (start < open_.size() && open_[start].bottom_a <= s.top_a && open_[start].bottom_b <= s.top_b) ++start;
            for (std::size_t v = start; v < open_.size(); ++v) {
                if (open_[v].top_a >= s.bottom_a && open_[v].top_b >= s.bottom_b) break;
                shared(s, open_[v], column + k * layer, nobody, face, between);
            }
        }
    }

    // The share of two sides becomes a face.
    void shared(const Side& one, const Side& two, std::uint32_t first, std::uint32_t second, CellFace face, const Between& between) {
        const Overlap share = overlap(one, two);
        if (share.count == 0) return;
        polygon_.clear();
        for (std::uint32_t c = 0; c < share.count; ++c) {
            const OverlapCorner& corner = share.corners[c];
            const OverlapCorner& next = share.corners[(c + 1) % share.count];
            polygon_.push_back(node_of(corner, between));
            if (corner.u == 1 && next.u == 1) down(between.pillar_b, corner.first[1], next.first[1]);
            if (corner.u == 0 && next.u == 0) up(between.pillar_a, corner.first[0], next.first[0]);
        }
        add(first, second, face);
    }

    std::uint32_t node_of(const OverlapCorner& corner, const Between& between) {
        if (corner.u == 0) return nodes_.id(between.pillar_a, corner.first[0]);
        if (corner.u == 1) return nodes_.id(between.pillar_b, corner.first[1]);
        const auto [at, fresh] =
            crossings_.try_emplace({between.plane, corner.first, corner.second}, static_cast<std::uint32_t>(out_.points.size()));
        if (!fresh) return at->second;
        const Vec3 p = position(corner, [&](int pillar, double depth) {
            return pillar_point(grid_.pillars.data() + 6 * (pillar == 0 ? between.pillar_a : between.pillar_b), depth, grid_.cylindrical);
        });
        out_.points.push_back({p[0], p[1], 0.0 - p[2]});
        for (const Edge& edge : {corner.first, corner.second}) on_edge_[{between.plane, edge}].push_back({corner.u, at->second});
        return at->second;
    }

    // Points of a pillar between two corners, downwards or upwards.
    void down(std::size_t pillar, double upper, double lower) {
        const auto inner = nodes_.between(pillar, upper, lower);
        for (std::uint32_t n = 0; n < inner.count; ++n) polygon_.push_back(inner.first + n);
    }
    void up(std::size_t pillar, double lower, double upper) {
        const auto inner = nodes_.between(pillar, upper, lower);
        for (std::uint32_t n = inner.count; n-- > 0;) polygon_.push_back(inner.first + n);
    }

    void add(std::uint32_t first, std::uint32_t second, CellFace side) {
        if (polygon_.size() < 3) return;
        // As gathered a side runs along +J (or +I) above and back below: outwards for i_plus and j_minus.
        if (side == CellFace::i_minus || side == CellFace::j_plus) std::ranges::reverse(polygon_);
        out_.nodes.insert(out_.nodes.end(), polygon_.begin(), polygon_.end());
        out_.offsets.push_back(out_.nodes.size());
        out_.faces.push_back({first, second, side});
    }

    // Tops and bottoms of a column.
    void stack(std::uint32_t i, std::uint32_t j) {
        std::uint32_t above = nobody;
        for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
            const auto cell = static_cast<std::uint32_t>(grid_.cell(i, j, k));
            if (out_.present[cell] == 0) continue;
            const bool touching = above != nobody && stacked(grid_, above, cell);
            if (above != nobody) level(above, touching ? cell : nobody, CellFace::k_plus);
            if (!touching) level(cell, nobody, CellFace::k_minus);
            above = cell;
        }
        if (above != nobody) level(above, nobody, CellFace::k_plus);
    }

    void level(std::uint32_t cell, std::uint32_t other, CellFace side) {
        const auto [i, j, k] = grid_.ijk(cell);
        const unsigned base = side == CellFace::k_plus ? 4 : 0;
        std::array<std::uint32_t, 4> corner;
        std::array<double, 4> depth;
        for (unsigned c = 0; c < 4; ++c) {
            depth[c] = grid_.depths[corner_index(grid_.dims, i, j, k, c + base)];
            corner[c] = nodes_.id(pillar_of(grid_, i, j, k, c), depth[c]);
        }
        polygon_.clear();
        polygon_.push_back(corner[0]);
        along(plane_j(i, j), {depth[0], depth[1]}, true);
        polygon_.push_back(corner[1]);
        along(plane_i(i + 1, j), {depth[1], depth[3]}, true);
        polygon_.push_back(corner[3]);
        along(plane_j(i, j + 1), {depth[2], depth[3]}, false);
        polygon_.push_back(corner[2]);
        along(plane_i(i, j), {depth[0], depth[2]}, false);
        if (side == CellFace::k_minus) std::ranges::reverse(polygon_);
        out_.nodes.insert(out_.nodes.end(), polygon_.begin(), polygon_.end());
        out_.offsets.push_back(out_.nodes.size());
        out_.faces.push_back({cell, other, side});
    }

    // Crossings on an edge between two pillars, from a to b or back.
    void along(std::size_t plane, const Edge& edge, bool forward) {
        const auto found = on_edge_.find({plane, edge});
        if (found == on_edge_.end()) return;
        auto& list = found->second;
        std::ranges::sort(list, [](const Crossing& p, const Crossing& q) { return std::pair(p.u, p.node) < std::pair(q.u, q.node); });
        if (forward)
            for (const Crossing& c : list) polygon_.push_back(c.node);
        else
            for (auto c = list.rbegin(); c != list.rend(); ++c) polygon_.push_back(c->node);
    }

    std::size_t shift(std::uint32_t k) const { return grid_.reservoirs.empty() ? 0 : set_size_ * pillar_set(grid_, k); }

    const CornerPointGrid& grid_;
    std::vector<std::uint8_t> present_;
    GridFaces out_;
    PillarNodes nodes_;
    std::size_t set_size_;
    PairSides sides_;
    std::vector<Side> open_;
    std::vector<std::uint32_t> polygon_;
    std::map<std::tuple<std::size_t, Edge, Edge>, std::uint32_t> crossings_;
    std::map<std::pair<std::size_t, Edge>, std::vector<Crossing>> on_edge_;
};

}  // namespace

GridFaces conforming_faces(const CornerPointGrid& grid) { return Maker(grid).make(); }

}  // namespace geomend::grid
