// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/block_model.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "base/disjoint_sets.h"
#include "topology/model_maker.h"

namespace geomend::testing {

namespace {

using Cell = std::array<int, 3>;
using Corners = std::array<std::uint32_t, 3>;

/// A triangle of a wall: position numbers, and what lies before and behind it.
struct WallTriangle {
    Corners at;
    std::uint32_t surface;
    int back, front;
};

class Assembler {
public:
    explicit Assembler(const Blocks& blocks) : blocks_(blocks) {}

    BlockModel make() {
        collect_walls();
        find_uncut_edges();
        orient_sheets();
        number_parts();
        BlockModel made;
        add_surfaces(made.data);
        add_regions(made.data.models.front());
        made.volumes = volumes();
        return made;
    }

private:
    bool is_inside(const Cell& c) const {
        for (std::size_t a = 0; a < 3; ++a) {
            if (c[a] < 0 || c[a] >= blocks_.size[a]) return false;
        }
        return true;
    }
    int region(const Cell& c) const { return is_inside(c) ? blocks_.region(c[0], c[1], c[2]) : 0; }
    Vec3 position(const Cell& n) const { return blocks_.node(n[0], n[1], n[2]); }
    bool has_height(const Cell& c) const {
        for (int di = 0; di < 2; ++di) {
            for (int dj = 0; dj < 2; ++dj) {
                if (position({c[0] + di, c[1] + dj, c[2]}) != position({c[0] + di, c[1] + dj, c[2] + 1})) return true;
            }
        }
        return false;
    }
    /// The four nodes of the face at the lower end of a cell along an axis; their normal points along the axis, and the face is
    /// cut from the first to the third.
    std::array<Cell, 4> face_nodes(Cell low, std::size_t axis) const {
        const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
        std::array<Cell, 4> q{low, low, low, low};
        ++q[1][b];
        ++q[2][b];
        ++q[2][c];
        ++q[3][c];
        if (blocks_.other_diagonal && blocks_.other_diagonal(static_cast<int>(axis), low)) std::ranges::rotate(q, q.begin() + 1);
        return q;
    }
    std::uint32_t number(const Vec3& p) {
        const auto [at, is_new] = known_.emplace(p, static_cast<std::uint32_t>(positions_.size()));
        if (is_new) positions_.push_back(p);
        return at->second;
    }

    void collect_walls() {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
            Cell cell{};
            for (cell[b] = 0; cell[b] < blocks_.size[b]; ++cell[b]) {
                for (cell[c] = 0; cell[c] < blocks_.size[c]; ++cell[c]) {
                    Cell low = cell;
                    low[axis] = -1;
                    for (int n = 0; n <= blocks_.size[axis]; ++n) {
                        Cell high = cell;
                        high[axis] = n;
                        if (axis == 2 && is_inside(high) && !has_height(high)) continue;
                        add_wall({static_cast<int>(axis), low, high, region(low), region(high)});
                        low = high;
                    }
                }
            }
        }
    }
    void add_wall(const BlockWall& wall) {
        if (wall.low_region == 0 && wall.high_region == 0) return;
        const bool inside = wall.low_region == wall.high_region;
        if (inside && !blocks_.sheet) return;
        const std::string name = inside ? blocks_.sheet(wall) : blocks_.surface(wall);
        if (name.empty()) return;
        auto found = std::ranges::find(names_, name);
        if (found == names_.end()) found = names_.insert(names_.end(), name);
        const bool turned = wall.high_region != 0 && (wall.low_region == 0 || wall.low_region > wall.high_region);
        const auto nodes = face_nodes(wall.high, static_cast<std::size_t>(wall.axis));
        std::array<std::uint32_t, 4> q{};
        for (std::size_t i = 0; i < 4; ++i) q[i] = number(position(nodes[i]));
        for (Corners t : {Corners{q[0], q[1], q[2]}, Corners{q[0], q[2], q[3]}}) {
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            if (turned) std::swap(t[1], t[2]);
            triangles_.push_back({t, static_cast<std::uint32_t>(found - names_.begin()), turned ? wall.high_region : wall.low_region,
                                  turned ? wall.low_region : wall.high_region});
        }
    }

    /// Edges with two triangles, both of one surface between the same regions, are no contacts.
    void find_uncut_edges() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_edge;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) at_edge[std::minmax(triangles_[t].at[i], triangles_[t].at[(i + 1) % 3])].push_back(t);
        }
        for (const auto& [edge, around] : at_edge) {
            if (around.size() != 2) continue;
            const auto &a = triangles_[around[0]], &b = triangles_[around[1]];
            if (a.surface == b.surface && a.back == b.back && a.front == b.front)
                uncut_.push_back({around[0], around[1], edge.first, edge.second});
        }
    }
    struct Uncut {
        std::uint32_t a, b, from, to;
    };
    bool runs(std::uint32_t t, std::uint32_t from, std::uint32_t to) const {
        const Corners& at = triangles_[t].at;
        for (std::size_t i = 0; i < 3; ++i) {
            if (at[i] == from && at[(i + 1) % 3] == to) return true;
        }
        return false;
    }
    /// Sheets with one region on both sides get one sense of rotation (where they have two sides).
    void orient_sheets() {
        std::vector<std::vector<Uncut>> at(triangles_.size());
        for (const Uncut& u : uncut_) {
            at[u.a].push_back(u);
            at[u.b].push_back(u);
        }
        std::vector<std::uint8_t> seen(triangles_.size(), 0);
        for (std::uint32_t start = 0; start < triangles_.size(); ++start) {
            if (seen[start] != 0 || triangles_[start].back != triangles_[start].front) continue;
            std::vector<std::uint32_t> stack{start};
            seen[start] = 1;
            while (!stack.empty()) {
                const std::uint32_t t = stack.back();
                stack.pop_back();
                for (const Uncut& u : at[t]) {
                    const std::uint32_t other = u.a == t ? u.b : u.a;
                    if (seen[other] != 0) continue;
                    seen[other] = 1;
                    if (runs(t, u.from, u.to) == runs(other, u.from, u.to)) std::swap(triangles_[other].at[1], triangles_[other].at[2]);
                    stack.push_back(other);
                }
            }
        }
    }

    std::uint32_t corner_at(std::uint32_t t, std::uint32_t position) const {
        for (std::uint32_t i = 0; i < 3; ++i) {
            if (triangles_[t].at[i] == position) return 3 * t + i;
        }
        throw std::logic_error("no such corner");
    }
    void number_parts() {
        DisjointSets parts(triangles_.size()), points(3 * triangles_.size());
        for (const Uncut& u : uncut_) {
            parts.join(u.a, u.b);
            for (const std::uint32_t p : {u.from, u.to}) points.join(corner_at(u.a, p), corner_at(u.b, p));
        }
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) part_.push_back(parts.root(t));
        for (std::uint32_t c = 0; c < 3 * triangles_.size(); ++c) point_.push_back(points.root(c));
    }

    void add_surfaces(Dataset& data) {
        StatedModel& model = data.models.emplace_back();
        model.name = "blocks";
        for (std::uint32_t s = 0; s < names_.size(); ++s) {
            std::vector<std::uint32_t> parts;
            for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
                if (triangles_[t].surface == s && std::ranges::find(parts, part_[t]) == parts.end()) parts.push_back(part_[t]);
            }
            Surface surface;
            surface.info.name = names_[s];
            const auto role = blocks_.roles.find(names_[s]);
            surface.info.role = role == blocks_.roles.end() ? FeatureRole::boundary : role->second;
            for (std::uint32_t p = 0; p < parts.size(); ++p) {
                if (parts.size() > 1) surface.parts.push_back({static_cast<std::uint32_t>(surface.points.size()), surface.polygons.size()});
                StatedModel::Face face = add_part(surface, parts[p]);
                face.number = static_cast<std::int64_t>(model.faces.size()) + 1;
                face.object = static_cast<std::uint32_t>(data.objects.size());
                face.part = p;
                face.interface_name = names_[s];
                face.role = surface.info.role;
                model.faces.push_back(face);
            }
            data.objects.emplace_back(std::move(surface));
        }
    }
    StatedModel::Face add_part(Surface& surface, std::uint32_t part) {
        std::map<std::uint32_t, std::uint32_t> made;
        StatedModel::Face face;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (part_[t] != part) continue;
            Corners corners{};
            std::array<Vec3, 3> key{};
            for (std::uint32_t i = 0; i < 3; ++i) {
                key[i] = positions_[triangles_[t].at[i]];
                const auto [at, is_new] = made.emplace(point_[3 * t + i], static_cast<std::uint32_t>(surface.points.size()));
                if (is_new) surface.points.push_back(key[i]);
                corners[i] = at->second;
            }
            surface.polygons.push_back(corners);
            if (!face.key) face.key = key;
            back_front_[part] = {triangles_[t].back, triangles_[t].front};
        }
        part_of_face_.push_back(part);
        return face;
    }

    int regions() const {
        int most = 0;
        for (const auto& t : triangles_) most = std::max({most, t.back, t.front});
        return most;
    }
    void add_regions(StatedModel& model) {
        for (int r = 0; r <= regions(); ++r) {
            StatedModel::Region region;
            region.name = r == 0 ? "Universe" : "R" + std::to_string(r);
            region.universe = r == 0;
            for (std::uint32_t f = 0; f < part_of_face_.size(); ++f) {
                const auto [back, front] = back_front_.at(part_of_face_[f]);
                if (back == r) region.sides.push_back({f, false});
                if (front == r) region.sides.push_back({f, true});
            }
            model.regions.push_back(std::move(region));
        }
    }

    /// Of each cell by the triangles around it, as seen from one of its nodes.
    std::vector<double> volumes() const {
        std::vector<double> sum(static_cast<std::size_t>(regions()), 0);
        Cell c{};
        for (c[0] = 0; c[0] < blocks_.size[0]; ++c[0]) {
            for (c[1] = 0; c[1] < blocks_.size[1]; ++c[1]) {
                for (c[2] = 0; c[2] < blocks_.size[2]; ++c[2]) {
                    if (region(c) > 0) sum.at(static_cast<std::size_t>(region(c)) - 1) += cell_volume(c);
                }
            }
        }
        return sum;
    }
    double cell_volume(const Cell& c) const {
        const Vec3 o = position(c);
        double six = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (int end = 0; end < 2; ++end) {
                Cell low = c;
                low[axis] += end;
                const auto n = face_nodes(low, axis);
                const double sign = end == 1 ? 1 : -1;
                six += sign * (six_cone(o, position(n[0]), position(n[1]), position(n[2])) +
                               six_cone(o, position(n[0]), position(n[2]), position(n[3])));
            }
        }
        if (six < 0) throw std::logic_error("a cell is inside out");
        return six / 6;
    }
    static double six_cone(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c) {
        const double u[3] = {a[0] - o[0], a[1] - o[1], a[2] - o[2]};
        const double v[3] = {b[0] - o[0], b[1] - o[1], b[2] - o[2]};
        const double w[3] = {c[0] - o[0], c[1] - o[1], c[2] - o[2]};
        return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
    }

    const Blocks& blocks_;
    std::map<Vec3, std::uint32_t> known_;
    std::vector<Vec3> positions_;
    std::vector<std::string> names_;
    std::vector<WallTriangle> triangles_;
    std::vector<Uncut> uncut_;
    std::vector<std::uint32_t> part_;   // per triangle
    std::vector<std::uint32_t> point_;  // per corner of a triangle
    std::vector<std::uint32_t> part_of_face_;
    std::map<std::uint32_t, std::pair<int, int>> back_front_;
};

}  // namespace

Surface& BlockModel::surface(const std::string& name) {
    for (Object& object : data.objects) {
        if (info_of(object).name == name) return std::get<Surface>(object);
    }
    throw std::out_of_range(name);
}

std::string box_side(const BlockWall& wall) {
    static const std::array<std::array<const char*, 2>, 3> names{{{"west", "east"}, {"south", "north"}, {"bottom", "top"}}};
    return names.at(static_cast<std::size_t>(wall.axis)).at(wall.low_region == 0 ? 0 : 1);
}

std::string box_side_or(const BlockWall& wall, const std::string& name) {
    return wall.low_region == 0 || wall.high_region == 0 ? box_side(wall) : name;
}

BlockModel make_block_model(const Blocks& blocks) { return Assembler(blocks).make(); }

Dataset without_lists(Dataset data) {
    for (StatedModel& model : data.models) {
        model.regions.clear();
        model.layers.clear();
    }
    return data;
}

Dataset loose_surfaces(const Dataset& data) {
    Dataset loose;
    for (const Object& object : data.objects) {
        const auto& from = std::get<Surface>(object);
        Surface to;
        to.info.name = from.info.name;
        to.info.role = from.info.role;
        std::map<Vec3, std::uint32_t> known;
        for (std::size_t p = 0; p < from.polygons.size(); ++p) {
            Corners corners{};
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& position = from.points[from.polygons[p][i]];
                const auto [at, is_new] = known.emplace(position, static_cast<std::uint32_t>(to.points.size()));
                if (is_new) to.points.push_back(position);
                corners[i] = at->second;
            }
            to.polygons.push_back(corners);
        }
        loose.objects.emplace_back(std::move(to));
    }
    return loose;
}

}  // namespace geomend::testing
