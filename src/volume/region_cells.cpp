// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/region_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/place_words.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "geometry/predicates.h"
#include "volume/cell_quality.h"

namespace geomend::volumes {

namespace {

Failure not_filled(const std::string& why) { return failure(FailureKind::limit, "F026", {}, why); }

Triangle sorted(Triangle t) {
    if (t[0] > t[1]) std::swap(t[0], t[1]);
    if (t[1] > t[2]) std::swap(t[1], t[2]);
    if (t[0] > t[1]) std::swap(t[0], t[1]);
    return t;
}

/// A face of a cell: the one opposite to its corner.
struct CellFace {
    Triangle vertices;  ///< ascending
    std::uint32_t cell, corner;
};

/// The faces of all cells, ascending by their vertices, then by cell: put in place by the lowest vertex, and sorted among those few that
/// have it in common.
std::vector<CellFace> faces_of(std::span<const std::array<std::uint32_t, 4>> cells) {
    std::uint32_t highest = 0;
    for (const auto& c : cells) highest = std::max(highest, std::ranges::max(c));
    const auto each = [&](const auto& visit) {
        for (std::uint32_t c = 0; c < cells.size(); ++c) {
            const auto& v = cells[c];
            for (std::uint32_t k = 0; k < 4; ++k) visit(CellFace{sorted({v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]}), c, k});
        }
    };
    std::vector<std::size_t> begin(std::size_t{highest} + 2, 0);
    each([&](const CellFace& face) { ++begin[face.vertices[0] + 1]; });
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<CellFace> faces(4 * cells.size());
    std::vector<std::size_t> next = begin;
    each([&](const CellFace& face) { faces[next[face.vertices[0]]++] = face; });
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
        std::sort(
            faces.begin() + static_cast<std::ptrdiff_t>(begin[v]), faces.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]),
            [](const CellFace& a, const CellFace& b) { return a.vertices != b.vertices ? a.vertices < b.vertices : a.cell < b.cell; });
    }
    return faces;
}

class RegionSearch {
public:
    RegionSearch(const RegionFacets& facets, Tetrahedra all) : facets_(facets), all_(std::move(all)), sets_(all_.cells.size()) {}

    Result<RegionCells> run() {
        if (auto turned = turn_cells(); !turned) return std::move(turned).why();
        if (auto joined = join_cells(); !joined) return std::move(joined).why();
        return take_inside();
    }

private:
    const RegionFacets& facets_;
    Tetrahedra all_;
    DisjointSets sets_;                                   ///< of cells between which no facet lies
    std::vector<std::pair<std::uint32_t, bool>> beside_;  ///< cells at facets, and whether the region is on their side

    const Vec3& position(std::uint32_t v) const {
        const std::size_t known = facets_.positions.size();
        return v < known ? facets_.positions[v] : all_.new_vertices[v - known];
    }
    std::string place_of_facet(std::uint32_t f) const { return place_words(facets_.positions[facets_.triangles[f][0]]); }

    Result<void> turn_cells() {
        for (auto& c : all_.cells) {
            const int sign = orientation(position(c[0]), position(c[1]), position(c[2]), position(c[3]));
            if (sign == 0) return not_filled("a cell has no volume, at " + place_words(position(c[0])));
            if (sign < 0) std::swap(c[2], c[3]);
        }
        return {};
    }

    Result<void> join_cells() {
        const auto faces = faces_of(all_.cells);
        std::vector<std::pair<Triangle, std::uint32_t>> facets;
        for (std::uint32_t f = 0; f < facets_.triangles.size(); ++f) facets.emplace_back(sorted(facets_.triangles[f]), f);
        std::ranges::sort(facets);
        auto facet = facets.begin();
        for (std::size_t i = 0; i < faces.size();) {
            std::size_t end = i + 1;
            while (end < faces.size() && faces[end].vertices == faces[i].vertices) ++end;
            const std::span<const CellFace> same(faces.data() + i, end - i);
            i = end;
            if (same.size() > 2) return not_filled("more than two cells share a face, at " + place_words(position(same[0].vertices[0])));
            if (facet != facets.end() && facet->first < same[0].vertices) break;  // one that is no face
            if (facet == facets.end() || facet->first != same[0].vertices) {
                if (same.size() == 2) sets_.join(same[0].cell, same[1].cell);
                continue;
            }
            if (auto seen = look_beside(facet->second, same); !seen) return seen;
            ++facet;
        }
        if (facet != facets.end()) return not_filled("a triangle is no face of a cell, at " + place_of_facet(facet->second));
        return {};
    }

    /// Which cells at a facet are of the region: those on the sides where it lies.
    Result<void> look_beside(std::uint32_t f, std::span<const CellFace> cells) {
        const Triangle& t = facets_.triangles[f];
        unsigned found = 0;
        for (const CellFace& face : cells) {
            const Vec3& apex = position(all_.cells[face.cell][face.corner]);
            const int sign = orientation(facets_.positions[t[0]], facets_.positions[t[1]], facets_.positions[t[2]], apex);
            const unsigned side = sign > 0 ? in_front : behind;
            if ((found & side) != 0) return not_filled("two cells lie on one side of a triangle, at " + place_of_facet(f));
            found |= side;
            beside_.emplace_back(face.cell, (facets_.sides[f] & side) != 0);
        }
        if ((facets_.sides[f] & ~found) != 0) return not_filled("no cell lies beside a triangle, at " + place_of_facet(f));
        return {};
    }

    Result<RegionCells> take_inside() {
        const auto root = std::move(sets_).roots();
        enum : std::uint8_t { unknown, inside, outside };
        std::vector<std::uint8_t> where(root.size(), unknown);
        for (const auto& [cell, is_inside] : beside_) {
            std::uint8_t& known = where[root[cell]];
            const std::uint8_t now = is_inside ? inside : outside;
            if (known != unknown && known != now)
                return not_filled("cells inside and outside of it hang together, at " + place_words(position(all_.cells[cell][0])));
            known = now;
        }
        RegionCells region;
        for (std::size_t c = 0; c < all_.cells.size(); ++c) {
            if (where[root[c]] == inside) region.cells.push_back(all_.cells[c]);
        }
        take_vertices(region);
        if (auto there = find_edges(region); !there) return std::move(there).why();
        measure(facets_, region);
        if (!(std::abs(region.volume - facets_.volume) <= 1e-9 * std::abs(facets_.volume)))
            return not_filled("cells have a volume of " + short_number(region.volume) + " where surfaces enclose " +
                              short_number(facets_.volume));
        return region;
    }

    Result<void> find_edges(const RegionCells& region) const {
        if (facets_.edges.empty()) return {};
        std::vector<std::array<std::uint32_t, 2>> edges;
        const auto known = static_cast<std::uint32_t>(facets_.positions.size());
        for (const auto& c : region.cells) {
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t k = i + 1; k < 4; ++k) {
                    if (c[i] < known && c[k] < known) edges.push_back({std::min(c[i], c[k]), std::max(c[i], c[k])});
                }
            }
        }
        std::ranges::sort(edges);
        for (const auto& [a, b] : facets_.edges) {
            if (!std::ranges::binary_search(edges, std::array<std::uint32_t, 2>{std::min(a, b), std::max(a, b)}))
                return not_filled("a piece of a well is no edge of a cell, at " + place_words(facets_.positions[a]));
        }
        return {};
    }

    /// New vertices that the cells use, in the order of their numbers.
    void take_vertices(RegionCells& region) const {
        const auto known = static_cast<std::uint32_t>(facets_.positions.size());
        std::vector<std::uint32_t> number(all_.new_vertices.size(), no_index);
        for (const auto& c : region.cells) {
            for (const std::uint32_t v : c) {
                if (v >= known) number[v - known] = 0;
            }
        }
        for (std::size_t i = 0; i < number.size(); ++i) {
            if (number[i] == no_index) continue;
            number[i] = known + static_cast<std::uint32_t>(region.new_vertices.size());
            region.new_vertices.push_back(all_.new_vertices[i]);
        }
        for (auto& c : region.cells) {
            for (std::uint32_t& v : c) v = v < known ? v : number[v - known];
        }
    }
};

}  // namespace

void measure(const RegionFacets& facets, RegionCells& region) {
    const auto known = facets.positions.size();
    const auto position = [&](std::uint32_t v) { return v < known ? facets.positions[v] : region.new_vertices[v - known]; };
    double six = 0, cosine = -1;
    region.shapes = {};
    for (const auto& c : region.cells) {
        const std::array<Vec3, 4> p{position(c[0]), position(c[1]), position(c[2]), position(c[3])};
        six += six_volumes(p[0], p[1], p[2], p[3]);
        const double own = dihedral_cosines(p).of_least;
        cosine = std::max(cosine, own);
        const double degrees = 180 / std::numbers::pi * std::acos(std::min(own, 1.0));
        ++region.shapes
              .least_dihedral[std::min<std::size_t>(static_cast<std::size_t>(degrees / 5), region.shapes.least_dihedral.size() - 1)];
        ++region.shapes.shape[std::min<std::size_t>(static_cast<std::size_t>(shape(p) * 10), region.shapes.shape.size() - 1)];
    }
    region.volume = six / 6;
    region.least_dihedral = 180 / std::numbers::pi * std::acos(std::min(cosine, 1.0));
}

bool lie_apart(std::span<const std::array<std::uint32_t, 4>> cells) {
    // Seen from its fourth corner a face turns one way for corners 0 and 2, the other way for 1 and 3.
    const auto turns_left = [&](const CellFace& face) {
        const auto& v = cells[face.cell];
        const Triangle own{v[(face.corner + 1) % 4], v[(face.corner + 2) % 4], v[(face.corner + 3) % 4]};
        const auto first = static_cast<std::size_t>(std::ranges::min_element(own) - own.begin());
        return (own[(first + 1) % 3] < own[(first + 2) % 3]) != (face.corner % 2 == 1);
    };
    const auto faces = faces_of(cells);
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].vertices == faces[i - 1].vertices && turns_left(faces[i]) == turns_left(faces[i - 1])) return false;
    }
    return true;
}

Result<RegionCells> cells_of_region(const RegionFacets& facets, Tetrahedra all) { return RegionSearch(facets, std::move(all)).run(); }

}  // namespace geomend::volumes
