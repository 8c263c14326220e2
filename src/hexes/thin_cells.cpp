// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/thin_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/vectors.h"

namespace geomend::hexes {

namespace {

using Corners3 = std::array<std::uint32_t, 3>;

Corners3 ascending(Corners3 t) {
    std::ranges::sort(t);
    return t;
}

/// A side of a triangle of a surface: the region on it.
struct WallFacet {
    Corners3 corners;  ///< ascending
    std::uint32_t region;
    auto operator<=>(const WallFacet&) const = default;
};

/// The thin parts of regions: tetrahedra with all corners on surfaces.
class ThinParts {
public:
    explicit ThinParts(const TetMesh& mesh) : m_(mesh), on_wall_(mesh.positions.size(), 0), thick_(mesh.tets.size(), 0) {
        for (std::uint32_t f = 0; f < 4 * m_.tets.size(); ++f) {
            if (m_.wall[f / 4][f % 4] == TetMesh::no_wall) continue;
            facets_.push_back({ascending(m_.facet(f)), m_.region[f / 4]});
            for (const std::uint32_t v : m_.facet(f)) on_wall_[v] = 1;
        }
        std::ranges::sort(facets_);
        for (std::size_t t = 0; t < m_.tets.size(); ++t)
            thick_[t] = std::ranges::all_of(m_.tets[t], [&](std::uint32_t v) { return on_wall_[v] != 0; }) ? 0 : 1;
    }

    const std::vector<std::uint8_t>& thick() const { return thick_; }
    bool is_facet(const Corners3& corners, std::uint32_t region) const {
        return std::ranges::binary_search(facets_, WallFacet{ascending(corners), region});
    }

    /// The vertex of another surface that is closest to one along an edge through a region; itself where lines pass through it and there
    /// is none; no_index where there is none at all.
    std::uint32_t counterpart(std::uint32_t v, std::uint32_t region) const {
        std::pair<double, std::uint32_t> best{HUGE_VAL, no_index};
        for (std::uint32_t i = m_.star_offsets[v]; i < m_.star_offsets[v + 1]; ++i) {
            const std::uint32_t t = m_.star[i];
            if (m_.region[t] != region) continue;
            for (const std::uint32_t w : m_.tets[t]) {
                if (w == v || on_wall_[w] == 0 || m_.wall_edges.has(v, w)) continue;
                const Vec3 d = minus(m_.positions[w], m_.positions[v]);
                best = std::min(best, {dot(d, d), w});
            }
        }
        if (best.second == no_index && m_.lines.has(v)) return v;
        return best.second;
    }

private:
    const TetMesh& m_;
    std::vector<std::uint8_t> on_wall_, thick_;
    std::vector<WallFacet> facets_;
};

/// The two pairs of opposite sides of a pyramid.
bool joins_surfaces(const ThinParts& parts, std::span<const std::uint32_t> c, CellType type, std::uint32_t region) {
    if (type == CellType::wedge) return parts.is_facet({c[0], c[1], c[2]}, region) && parts.is_facet({c[3], c[4], c[5]}, region);
    return (parts.is_facet({c[0], c[1], c[4]}, region) && parts.is_facet({c[2], c[3], c[4]}, region)) ||
           (parts.is_facet({c[1], c[2], c[4]}, region) && parts.is_facet({c[3], c[0], c[4]}, region));
}

}  // namespace

Candidates thin_cells(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options) {
    const ThinParts parts(mesh);
    SearchOptions thin = options;
    std::vector<std::uint8_t> taken = parts.thick();
    for (std::size_t t = 0; t < options.taken.size(); ++t) taken[t] |= options.taken[t];
    thin.taken = taken;
    Candidates all = find_prisms(mesh, quads, thin);
    all.append(find_pyramids(mesh, quads, thin));
    std::vector<std::uint8_t> kept(all.size(), 0);
    for (std::size_t i = 0; i < all.size(); ++i)
        kept[i] = joins_surfaces(parts, all.corners_of(i), all.types[i], mesh.region[all.tets_of(i)[0]]) ? 1 : 0;
    all.keep(kept);
    return all;
}

ThinCounts count_thin(const TetMesh& mesh, const MixedMesh& made) {
    ThinCounts counts;
    const ThinParts parts(mesh);
    for (std::uint32_t f = 0; f < 4 * mesh.tets.size(); ++f) {
        if (mesh.wall[f / 4][f % 4] == TetMesh::no_wall || parts.thick()[f / 4] != 0) continue;
        ++counts.triangles;
        const CellFaceRef place = made.facet_places[f];
        const CellType type = place.cell == no_index ? CellType::tetrahedron : made.cells[place.cell].type;
        if (type == CellType::wedge || type == CellType::pyramid) {
            ++(type == CellType::wedge ? counts.prisms : counts.pyramids);
            continue;
        }
        const std::uint32_t region = mesh.region[f / 4];
        const Corners3 corners = mesh.facet(f);
        Corners3 others{};
        unsigned common = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            others[k] = parts.counterpart(corners[k], region);
            if (others[k] == corners[k]) ++common;
        }
        if (std::ranges::find(others, no_index) != others.end()) ++counts.undefined;
        else if (common == 3) ++counts.ignored;
        else if (common == 2) ++counts.tetrahedra;
        else if (!parts.is_facet(others, region)) ++counts.unmatched;
        else ++counts.invalid;
    }
    return counts;
}

}  // namespace geomend::hexes
