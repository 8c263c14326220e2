// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/leftovers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "base/vectors.h"
#include "geometry/cell_volume.h"
#include "hexes/flat_cavity.h"
#include "hexes/split_cells.h"
#include "model/cell_faces.h"
#include "volume/improve.h"

namespace geomend::hexes {

namespace {

using Tet = std::array<std::uint32_t, 4>;
using Corners3 = std::array<std::uint32_t, 3>;

constexpr double flat = 1e-10, nearly_flat = 1e-5;  // volumes over the cube of the longest edge

Tet ascending(Tet t) {
    std::ranges::sort(t);
    return t;
}

/// The side of a facet that a tetrahedron has: its corners wound outwards, the least first.
Corners3 side_of(Corners3 c) {
    std::ranges::rotate(c, std::ranges::min_element(c));
    return c;
}

/// A facet of the first tetrahedra that lies on a wall and is one of a tetrahedron still.
struct WallSide {
    Corners3 side;
    std::uint32_t facet;
    auto operator<=>(const WallSide&) const = default;
};

class Leftovers {
public:
    Leftovers(MixedMesh& mesh, const TetMesh& tets, LeftoverCounts& counts) : mesh_(mesh), m_(tets), counts_(counts) { take_out(); }

    void run(const Monitor* monitor) {
        const std::uint32_t regions = left_.region.empty() ? 0 : *std::ranges::max_element(left_.region) + 1;
        std::vector<std::vector<std::uint32_t>> by_region(regions);
        for (std::uint32_t t = 0; t < left_.tets.size(); ++t) by_region[left_.region[t]].push_back(t);
        TetMesh better;
        better.positions = std::move(left_.positions);
        for (const auto& own : by_region) {
            if (!own.empty()) improve_region(own, better, monitor);
        }
        left_ = std::move(better);
        find_across(left_);
        replace_flats();
    }

    /// Cells of other types beside those that are nearly flat; where these are many, as in thin layers, beside those that are flat.
    std::vector<std::uint32_t> beside_flats() const {
        std::vector<std::uint32_t> found = beside_flats(nearly_flat);
        const std::size_t many = std::max<std::size_t>(20, mesh_.cells.size() / 500);
        return found.size() > many ? beside_flats(flat) : found;
    }

    std::vector<std::uint32_t> beside_flats(double least) const {
        std::vector<std::uint8_t> is_near(mesh_.positions.size(), 0);
        std::vector<Tet> flats;
        for (const Tet& t : left_.tets) {
            if (!is_flat(t, least)) continue;
            flats.push_back(t);
            for (const std::uint32_t v : t) is_near[v] = 1;
        }
        std::vector<std::uint32_t> found;
        std::vector<Tet> bases;
        const auto touches = [&](const MixedMesh::Cell& cell) {
            const auto corners = std::span(cell.corners).first(node_count(cell.type));
            if (std::ranges::count_if(corners, [&](std::uint32_t v) { return is_near[v] != 0; }) < 2) return false;
            return std::ranges::any_of(flats, [&](const Tet& t) {
                return std::ranges::count_if(t, [&](std::uint32_t v) { return std::ranges::find(corners, v) != corners.end(); }) >= 2;
            });
        };
        for (const auto& cell : mesh_.cells) {
            if (!flats.empty() && cell.type == CellType::pyramid && touches(cell))
                bases.push_back(ascending({cell.corners[0], cell.corners[1], cell.corners[2], cell.corners[3]}));
        }
        std::ranges::sort(bases);
        const auto has_base = [&](const MixedMesh::Cell& cell) {
            return std::ranges::any_of(faces_of(cell.type), [&](const LocalFace& face) {
                const auto c = face.corners();
                return c.size() == 4 && std::ranges::binary_search(bases, ascending({cell.corners[c[0]], cell.corners[c[1]],
                                                                                     cell.corners[c[2]], cell.corners[c[3]]}));
            });
        };
        for (std::uint32_t c = 0; c < mesh_.cells.size() && !flats.empty(); ++c) {
            const auto& cell = mesh_.cells[c];
            if (cell.type != CellType::hexahedron && cell.type != CellType::wedge) continue;
            if (touches(cell) || (!bases.empty() && has_base(cell))) found.push_back(c);
        }
        return found;
    }

    /// The tetrahedra stand behind all other cells.
    void put_back() {
        for (std::uint32_t t = 0; t < left_.tets.size(); ++t) {
            const Tet& c = left_.tets[t];
            const auto cell = static_cast<std::uint32_t>(mesh_.cells.size());
            mesh_.cells.push_back(
                {CellType::tetrahedron, {c[0], c[1], c[2], c[3], no_index, no_index, no_index, no_index}, left_.region[t], left_.cells[t]});
            for (std::uint32_t k = 0; k < 4; ++k) {
                if (const WallSide* wall = wall_at(left_.facet(4 * t + k))) mesh_.facet_places[wall->facet] = {cell, face_opposite(k)};
            }
        }
        counts_.flat = static_cast<std::uint64_t>(std::ranges::count_if(left_.tets, [&](const Tet& t) { return is_flat(t, flat); }));
    }

private:
    void take_out() {
        std::vector<std::uint32_t> new_of(mesh_.cells.size(), no_index);
        std::vector<MixedMesh::Cell> others;
        for (std::uint32_t c = 0; c < mesh_.cells.size(); ++c) {
            const auto& cell = mesh_.cells[c];
            if (cell.type != CellType::tetrahedron) {
                new_of[c] = static_cast<std::uint32_t>(others.size());
                others.push_back(cell);
                continue;
            }
            left_.tets.push_back({cell.corners[0], cell.corners[1], cell.corners[2], cell.corners[3]});
            left_.region.push_back(cell.region);
            left_.cells.push_back(cell.tet);
        }
        for (std::uint32_t f = 0; f < mesh_.facet_places.size(); ++f) {
            CellFaceRef& place = mesh_.facet_places[f];
            if (place.cell == no_index) continue;
            const auto& cell = mesh_.cells[place.cell];
            if (cell.type == CellType::tetrahedron) {
                const auto c = faces_of(cell.type)[place.face].corners();
                walls_.push_back({side_of({cell.corners[c[0]], cell.corners[c[1]], cell.corners[c[2]]}), f});
            }
            place.cell = new_of[place.cell];
        }
        std::ranges::sort(walls_);
        mesh_.cells = std::move(others);
        left_.positions = mesh_.positions;
        find_across(left_);
    }

    const WallSide* wall_at(const Corners3& facet) const {
        const WallSide wanted{side_of(facet), 0};
        const auto found = std::ranges::lower_bound(walls_, wanted);
        return found != walls_.end() && found->side == wanted.side ? &*found : nullptr;
    }

    bool is_line(std::uint32_t a, std::uint32_t b) const {
        return a < m_.positions.size() && b < m_.positions.size() && m_.lines.has(a, b);
    }

    std::array<Vec3, 4> corners(const Tet& t) const {
        return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]], mesh_.positions[t[3]]};
    }
    bool is_flat(const Tet& t, double least) const {
        const auto p = corners(t);
        double longest = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) longest = std::max(longest, dot(minus(p[i], p[j]), minus(p[i], p[j])));
        }
        return !(tetrahedron_volume(p[0], p[1], p[2], p[3]) > least * std::pow(longest, 1.5));
    }

    /// \param own tetrahedra of one region \param to gets those that take their place
    void improve_region(const std::vector<std::uint32_t>& own, TetMesh& to, const Monitor* monitor) {
        std::unordered_map<std::uint32_t, std::uint32_t> number;
        std::vector<std::uint32_t> global;
        volumes::RegionFacets facets;
        volumes::RegionCells cells;
        const auto local = [&](std::uint32_t v) {
            const auto [at, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(global.size()));
            if (is_new) {
                global.push_back(v);
                facets.positions.push_back(mesh_.positions[v]);
            }
            return at->second;
        };
        std::vector<std::array<std::uint32_t, 2>> kept;
        for (const std::uint32_t t : own) {
            const Tet& c = left_.tets[t];
            cells.cells.push_back({local(c[0]), local(c[1]), local(c[2]), local(c[3])});
            for (std::uint32_t k = 0; k < 4; ++k) {
                const Corners3 f = left_.facet(4 * t + k);
                if (left_.across[t][k] == no_index || wall_at(f) != nullptr)
                    facets.triangles.push_back({local(f[0]), local(f[1]), local(f[2])});
            }
            for (const auto& e : edges_of(CellType::tetrahedron)) {
                if (is_line(c[e[0]], c[e[1]])) kept.push_back({local(c[e[0]]), local(c[e[1]])});
            }
        }
        const auto before = cells.cells;
        const volumes::Improvement done = volumes::improve(facets, cells, monitor, kept);
        counts_.flips += done.flips;
        const Sources sources(before, facets.positions.size());
        for (const Tet& c : cells.cells) {
            const std::uint32_t source = own[sources.of(c)];
            to.tets.push_back({global[c[0]], global[c[1]], global[c[2]], global[c[3]]});
            to.region.push_back(left_.region[source]);
            to.cells.push_back(left_.cells[source]);
        }
    }

    /// From cells to those that had most of their corners before.
    class Sources {
    public:
        Sources(const std::vector<Tet>& before, std::size_t vertices) : before_(before), offsets_(vertices + 1, 0) {
            for (const Tet& t : before) {
                for (const std::uint32_t v : t) ++offsets_[v + 1];
            }
            std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
            star_.resize(offsets_.back());
            std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
            for (std::uint32_t t = 0; t < before.size(); ++t) {
                for (const std::uint32_t v : before[t]) star_[next[v]++] = t;
            }
        }
        std::uint32_t of(const Tet& cell) const {
            std::ptrdiff_t most = 0;
            std::uint32_t best = star_[offsets_[cell[0]]];
            for (const std::uint32_t v : cell) {
                for (std::uint32_t i = offsets_[v]; i < offsets_[v + 1]; ++i) {
                    const std::ptrdiff_t common =
                        std::ranges::count_if(before_[star_[i]], [&](std::uint32_t w) { return std::ranges::find(cell, w) != cell.end(); });
                    if (common == 4) return star_[i];
                    if (common > most) most = common, best = star_[i];
                }
            }
            return best;
        }

    private:
        const std::vector<Tet>& before_;
        std::vector<std::uint32_t> offsets_, star_;
    };

    void replace_flats() {
        const auto is_wall = [&](std::uint32_t f) { return wall_at(left_.facet(f)) != nullptr; };
        const auto is_kept = [&](std::uint32_t a, std::uint32_t b) { return is_line(a, b); };
        FlatCavities cavities(left_, is_wall, is_kept);
        for (const FlatCavities::Made& made : cavities.replace()) {
            mesh_.positions.push_back(made.position);
            mesh_.new_vertices.push_back({made.near, made.region});
            ++counts_.placed;
        }
    }

    MixedMesh& mesh_;
    const TetMesh& m_;
    LeftoverCounts& counts_;
    TetMesh left_;  ///< tetrahedra, what is across, regions; `cells`: the tetrahedron of `m_` that each has values of
    std::vector<WallSide> walls_;
};

}  // namespace

void improve_leftovers(MixedMesh& mesh, const TetMesh& tets, const Monitor* monitor, LeftoverCounts& counts,
                       std::vector<std::uint32_t>& beside) {
    counts = {};
    beside.clear();
    Leftovers leftovers(mesh, tets, counts);
    leftovers.run(monitor);
    beside = leftovers.beside_flats();
    leftovers.put_back();
}

}  // namespace geomend::hexes
