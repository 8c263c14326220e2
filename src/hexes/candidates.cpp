// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/candidates.h"

#include <algorithm>

#include <tbb/enumerable_thread_specific.h>

#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "hexes/inner_tets.h"
#include "hexes/jacobian.h"

namespace geomend::hexes {

namespace {

using Corner = QuadTable::Corner;
using Corners = std::array<std::uint32_t, 8>;

void add(Candidates& all, CellType type, const Corners& corners, double quality, double volume, std::uint8_t diagonals, std::uint8_t ends,
         std::span<const std::uint32_t> tets) {
    all.types.push_back(type);
    all.corners.push_back(corners);
    all.quality.push_back(quality);
    all.volume.push_back(volume);
    all.diagonals.push_back(diagonals);
    all.ends.push_back(ends);
    all.tets.insert(all.tets.end(), tets.begin(), tets.end());
    all.tet_offsets.push_back(all.tets.size());
}

/// Room for so many, so that no array is moved while it grows.
void reserve(Candidates& all, std::size_t count, std::size_t tets) {
    all.types.reserve(count);
    all.corners.reserve(count);
    all.quality.reserve(count);
    all.volume.reserve(count);
    all.diagonals.reserve(count);
    all.ends.reserve(count);
    all.tet_offsets.reserve(count + 1);
    all.tets.reserve(tets);
}

/// What both searches have: the mesh, where cells go, and the tests that cells have to pass.
class Search {
public:
    Search(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options)
        : m_(mesh), quads_(quads), least_(options.least_quality), taken_(options.taken), inner_(mesh, options.taken) {}
    Candidates found;

protected:
    const Vec3& at(std::uint32_t v) const { return m_.positions[v]; }
    double determinant(std::uint32_t o, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return scaled_determinant(at(o), at(a), at(b), at(c));
    }
    void take(CellType type, const Corners& corners, std::size_t count) {
        std::array<Vec3, 8> points{};
        for (std::size_t k = 0; k < count; ++k) points[k] = at(corners[k]);
        const std::span<const Vec3> used(points.data(), count);
        const double quality = scaled_jacobian(type, used);
        if (!(quality >= least_) || !inner_.find(type, {corners.data(), count}) || !is_valid(type, used)) return;
        add(found, type, corners, quality, inner_.volume(), inner_.diagonals(), inner_.ends(), inner_.tets());
    }

    const TetMesh& m_;
    const QuadTable& quads_;
    double least_;
    std::span<const std::uint8_t> taken_;
    InnerTets inner_;
};

/// Hexahedra by their corners: 0 is the least, 1, 3 and 4 are its neighbours, 1 the least of them.
class HexSearch : public Search {
public:
    using Search::Search;

    void at_vertex(std::uint32_t a) {
        usable_.clear();
        for (const Corner& c : quads_.at(a)) {
            if (c.x > a && c.opposite > a) usable_.push_back(c);
        }
        for (std::size_t i = 0, end = 0; i < usable_.size(); i = end) {
            for (end = i; end < usable_.size() && usable_[end].x == usable_[i].x;) ++end;
            with_first(a, i, end);
        }
    }

private:
    /// All with the neighbour b, the x of usable_[first .. last).
    void with_first(std::uint32_t a, std::size_t first, std::size_t last) {
        const std::uint32_t b = usable_[first].x;
        for (std::size_t i = first; i < last; i = next(i, last)) {
            for (std::size_t k = next(i, last); k < last; k = next(k, last)) {
                const std::uint32_t d = usable_[i].y, e = usable_[k].y;
                const double size = determinant(a, b, d, e);
                if (std::abs(size) < least_) continue;
                const auto [low, high] = between(d, e);
                if (low == high) continue;
                if (size > 0) with_three(a, {b, d, e}, {i, next(i, last)}, {k, next(k, last)}, {low, high});
                else with_three(a, {b, e, d}, {k, next(k, last)}, {i, next(i, last)}, {low, high});
            }
        }
    }

    std::size_t next(std::size_t i, std::size_t last) const {
        const std::uint32_t y = usable_[i].y;
        while (i < last && usable_[i].y == y) ++i;
        return i;
    }

    using Range = std::array<std::size_t, 2>;
    Range between(std::uint32_t x, std::uint32_t y) const {
        const auto first = std::lower_bound(usable_.begin(), usable_.end(), Corner{x, y, 0});
        auto last = first;
        while (last != usable_.end() && last->x == x && last->y == y) ++last;
        return {static_cast<std::size_t>(first - usable_.begin()), static_cast<std::size_t>(last - usable_.begin())};
    }

    void with_three(std::uint32_t a, const std::array<std::uint32_t, 3>& n, Range cs, Range fs, Range hs) {
        const auto [b, d, e] = n;
        for (std::size_t i = cs[0]; i < cs[1]; ++i) {
            const std::uint32_t c = usable_[i].opposite;
            if (c == e) continue;
            for (std::size_t j = fs[0]; j < fs[1]; ++j) {
                const std::uint32_t f = usable_[j].opposite;
                if (f == d || f == c || determinant(b, c, a, f) < least_) continue;
                for (std::size_t k = hs[0]; k < hs[1]; ++k) {
                    const std::uint32_t h = usable_[k].opposite;
                    if (h == b || h == c || h == f || determinant(d, a, c, h) < least_ || determinant(e, h, f, a) < least_) continue;
                    with_seven({a, b, c, d, e, f, no_index, h});
                }
            }
        }
    }

    void with_seven(Corners v) {
        const std::span<const Corner> by_b = quads_.at(v[1], v[2], v[5]);
        if (by_b.empty()) return;
        const std::span<const Corner> by_d = quads_.at(v[3], v[2], v[7]);
        if (by_d.empty()) return;
        const std::span<const Corner> by_e = quads_.at(v[4], v[5], v[7]);
        for (const Corner& one : by_b) {
            const auto is_it = [&](const Corner& other) { return other.opposite == one.opposite; };
            if (one.opposite < v[0] || std::ranges::find(v, one.opposite) != v.end()) continue;
            if (std::ranges::none_of(by_d, is_it) || std::ranges::none_of(by_e, is_it)) continue;
            v[6] = one.opposite;
            take(CellType::hexahedron, v, 8);
            v[6] = no_index;
        }
    }

    std::vector<Corner> usable_;  ///< at the vertex at hand, with higher vertices only
};

/// Prisms by their corners: 0 is the least, its triangle is 0, 1, 2, its upright edge goes to 3.
class PrismSearch : public Search {
public:
    using Search::Search;

    void at_vertex(std::uint32_t a) {
        for (std::uint32_t i = m_.star_offsets[a]; i < m_.star_offsets[a + 1]; ++i) {
            const auto& tet = m_.tets[m_.star[i]];
            if (!taken_.empty() && taken_[m_.star[i]] != 0) continue;
            for (std::uint32_t k = 0; k < 4; ++k) {
                if (tet[k] == a) continue;
                const auto facet = m_.facet(4 * m_.star[i] + k);
                const auto at_a = static_cast<std::size_t>(std::ranges::find(facet, a) - facet.begin());
                // Wound outwards of the tetrahedron inside of the prism.
                const std::uint32_t b = facet[(at_a + 1) % 3], c = facet[(at_a + 2) % 3];
                if (b > a && c > a) with_triangle(a, b, c);
            }
        }
    }

private:
    void with_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        for (const Corner& quad : quads_.at(a)) {
            const std::uint32_t d = quad.x == b ? quad.y : quad.y == b ? quad.x : no_index, e = quad.opposite;
            if (d == no_index || d < a || e < a || d == c || e == c || determinant(a, c, b, d) <= 0) continue;
            for (const Corner& other : quads_.at(a, c, d)) {
                const std::uint32_t f = other.opposite;
                if (f < a || f == b || f == e) continue;
                const auto closing = quads_.at(b, c, e);
                if (std::ranges::any_of(closing, [&](const Corner& q) { return q.opposite == f; }))
                    take(CellType::wedge, {a, b, c, d, e, f, no_index, no_index}, 6);
            }
        }
    }
};

/// Goes through all vertices by parts, whose finds are put together in their order.
template <class Finder>
Candidates search(const TetMesh& m, const QuadTable& quads, const SearchOptions& options, const char* what) {
    constexpr std::size_t grain = 512;
    std::vector<Candidates> parts((m.positions.size() + grain - 1) / grain);
    tbb::enumerable_thread_specific<Finder> finders([&] { return Finder(m, quads, options); });
    parallel_for_each_index(parts.size(), [&](std::size_t part) {
        if (options.monitor != nullptr && options.monitor->stopped()) return;
        Finder& finder = finders.local();
        finder.found = {};
        for (std::size_t v = part * grain; v < std::min((part + 1) * grain, m.positions.size()); ++v)
            finder.at_vertex(static_cast<std::uint32_t>(v));
        parts[part] = std::move(finder.found);
        if (options.monitor != nullptr) options.monitor->progress(what, static_cast<double>(part) / static_cast<double>(parts.size()));
    });
    Candidates all;
    std::size_t count = 0, tets = 0;
    for (const Candidates& part : parts) {
        count += part.size();
        tets += part.tets.size();
    }
    reserve(all, count, tets);
    for (Candidates& part : parts) {
        all.append(part);
        part = {};
    }
    return all;
}

}  // namespace

void Candidates::append(const Candidates& more) {
    const auto put = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    put(types, more.types);
    put(corners, more.corners);
    put(quality, more.quality);
    put(volume, more.volume);
    put(diagonals, more.diagonals);
    put(ends, more.ends);
    const std::uint64_t before = tets.size();
    put(tets, more.tets);
    for (std::size_t i = 1; i < more.tet_offsets.size(); ++i) tet_offsets.push_back(before + more.tet_offsets[i]);
}

void Candidates::keep(const std::vector<std::uint8_t>& kept) {
    Candidates left;
    for (std::size_t i = 0; i < size(); ++i) {
        if (kept[i] != 0) add(left, types[i], corners[i], quality[i], volume[i], diagonals[i], ends[i], tets_of(i));
    }
    *this = std::move(left);
}

Candidates find_hexahedra(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options) {
    return search<HexSearch>(mesh, quads, options, "hexahedra");
}

Candidates find_prisms(const TetMesh& mesh, const QuadTable& quads, const SearchOptions& options) {
    return search<PrismSearch>(mesh, quads, options, "prisms");
}

Candidates find_pyramids(const TetMesh& m, const QuadTable& quads, const SearchOptions& options) {
    Candidates found;
    const auto is_taken = [&](std::uint32_t t) { return !options.taken.empty() && options.taken[t] != 0; };
    for (std::uint32_t f = 0; f < 4 * m.tets.size(); ++f) {
        const std::uint32_t other = m.across[f / 4][f % 4];
        if (other == no_index || other < f || m.wall[f / 4][f % 4] != TetMesh::no_wall || is_taken(f / 4) || is_taken(other / 4)) continue;
        const std::array<std::uint32_t, 3> facet = m.facet(f);
        const std::uint32_t inside = m.tets[f / 4][f % 4], outside = m.tets[other / 4][other % 4];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t apex = facet[k], a = facet[(k + 1) % 3], c = facet[(k + 2) % 3];
            const auto opposite = quads.at(a, inside, outside);
            if (std::ranges::none_of(opposite, [&](const Corner& q) { return q.opposite == c; })) continue;
            const Corners corners{a, outside, c, inside, apex, no_index, no_index, no_index};
            std::array<Vec3, 5> points{};
            for (std::size_t i = 0; i < 5; ++i) points[i] = m.positions[corners[i]];
            const double quality = scaled_jacobian(CellType::pyramid, points);
            if (!(quality >= options.least_quality) || !is_valid(CellType::pyramid, points)) continue;
            double volume = 0;
            for (const std::uint32_t t : {f / 4, other / 4}) {
                const auto& p = m.tets[t];
                volume += tetrahedron_volume(m.positions[p[0]], m.positions[p[1]], m.positions[p[2]], m.positions[p[3]]);
            }
            // Local face 0 runs from corner 0 by 3 and 2 to 1: its first diagonal is the one between the two tetrahedra.
            add(found, CellType::pyramid, corners, quality, volume, 0, 0, std::array{f / 4, other / 4});
        }
    }
    return found;
}

}  // namespace geomend::hexes
