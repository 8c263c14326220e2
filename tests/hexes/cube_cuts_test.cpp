// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <set>

#include "hexes/candidates.h"
#include "hexes/conflicts.h"
#include "hexes/lattice_meshes.h"
#include "hexes/selection.h"
#include "model/cell_faces.h"

// What tetrahedra make of cubes, by numbers that were worked out otherwise (Botella 2016, tables 3.1 and 3.2, and enumeration).

namespace geomend::hexes {
namespace {

constexpr double any_quality = 1e-3;

struct Found {
    TetMesh tets;
    Candidates hexahedra, prisms, pyramids;
};

/// Whether all quadrangles of a candidate are flat.
bool is_flat(const TetMesh& m, const Candidates& all, std::size_t i) {
    for (const LocalFace& face : faces_of(all.types[i])) {
        const auto c = face.corners();
        if (c.size() != 4) continue;
        const auto at = [&](std::size_t k) { return m.positions[all.corners[i][c[k]]]; };
        const Vec3 n = cross(minus(at(1), at(0)), minus(at(2), at(0)));
        if (std::abs(dot(n, minus(at(3), at(0)))) > 1e-9) return false;
    }
    return true;
}

void keep_flat(const TetMesh& m, Candidates& all) {
    std::vector<std::uint8_t> kept;
    for (std::size_t i = 0; i < all.size(); ++i) kept.push_back(is_flat(m, all, i) ? 1 : 0);
    all.keep(kept);
}

Found find(VolumeMeshData data) {
    const auto mesh = VolumeMesh::make(std::move(data));
    EXPECT_TRUE(mesh) << mesh.why().error.message;
    Found f;
    f.tets = tet_mesh_of(*mesh);
    const QuadTable quads(f.tets, any_quality);
    const SearchOptions options{any_quality, {}, nullptr};
    f.hexahedra = find_hexahedra(f.tets, quads, options);
    f.prisms = find_prisms(f.tets, quads, options);
    f.pyramids = find_pyramids(f.tets, quads, options);
    for (Candidates* all : {&f.hexahedra, &f.prisms, &f.pyramids}) keep_flat(f.tets, *all);
    return f;
}

/// All sets of tetrahedra that fill the unit cube, by exact cover of points inside.
class Cuts {
public:
    Cuts() {
        for (std::uint32_t a = 0; a < 8; ++a) {
            for (std::uint32_t b = a + 1; b < 8; ++b) {
                for (std::uint32_t c = b + 1; c < 8; ++c) {
                    for (std::uint32_t d = c + 1; d < 8; ++d) add({a, b, c, d});
                }
            }
        }
        std::vector<std::size_t> chosen;
        cover({}, chosen);
    }
    std::vector<test::Tets> cuts;
    const std::vector<Vec3> points = test::lattice({1, 1, 1}).points;

private:
    static constexpr std::size_t samples = 3000;
    using Inside = std::bitset<samples>;

    double six(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
        return dot(minus(b, a), cross(minus(c, a), minus(d, a)));
    }
    void add(std::array<std::uint32_t, 4> t) {
        const auto p = [&](std::size_t k) { return points[t[k]]; };
        const double whole = six(p(0), p(1), p(2), p(3));
        if (whole == 0) return;
        if (whole < 0) std::swap(t[2], t[3]);
        Inside inside;
        std::uint32_t random = 7;
        for (std::size_t s = 0; s < samples; ++s) {
            Vec3 x{};
            for (double& c : x) {
                random = random * 1664525u + 1013904223u;
                c = (random >> 8) / double(1 << 24);
            }
            inside[s] = six(x, p(1), p(2), p(3)) > 0 && six(p(0), x, p(2), p(3)) > 0 && six(p(0), p(1), x, p(3)) > 0 &&
                        six(p(0), p(1), p(2), x) > 0;
        }
        tets_.push_back(t);
        inside_.push_back(inside);
    }
    void cover(const Inside& done, std::vector<std::size_t>& chosen) {
        std::size_t first = 0;
        while (first < samples && done[first]) ++first;
        if (first == samples) {
            test::Tets cut;
            for (const std::size_t t : chosen) cut.push_back(tets_[t]);
            cuts.push_back(cut);
            return;
        }
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            if (!inside_[t][first] || (inside_[t] & done).any()) continue;
            chosen.push_back(t);
            cover(done | inside_[t], chosen);
            chosen.pop_back();
        }
    }

    test::Tets tets_;
    std::vector<Inside> inside_;
};

/// Facets inside of the cube that have nothing on their other side.
std::set<std::uint32_t> corners_of_gaps(const test::Tets& cut, const std::vector<Vec3>& points) {
    std::map<std::array<std::uint32_t, 3>, int> count;
    for (const auto& t : cut) {
        for (const auto& f : facet_corners) {
            std::array<std::uint32_t, 3> key{t[f[0]], t[f[1]], t[f[2]]};
            std::ranges::sort(key);
            ++count[key];
        }
    }
    std::set<std::uint32_t> corners;
    for (const auto& [key, n] : count) {
        bool outside = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
            outside = outside || (points[key[0]][axis] == points[key[1]][axis] && points[key[1]][axis] == points[key[2]][axis]);
        if (n == 1 && !outside) corners.insert(key.begin(), key.end());
    }
    return corners;
}

TEST(CubeCuts, EveryCutOfACubeMakesOneHexahedron) {
    const Cuts all;
    ASSERT_EQ(all.cuts.size(), 182u);
    std::map<std::size_t, int> conforming, with_flat;
    for (test::Tets cut : all.cuts) {
        const auto gap = corners_of_gaps(cut, all.points);
        ++(gap.empty() ? conforming : with_flat)[cut.size()];
        if (!gap.empty()) {
            ASSERT_EQ(gap.size(), 4u);
            std::vector<std::uint32_t> v(gap.begin(), gap.end());
            cut.push_back({v[0], v[1], v[2], v[3]});
            if (!VolumeMesh::make(test::mesh_data(all.points, cut))) std::swap(cut.back()[0], cut.back()[1]);
        }
        const Found f = find(test::mesh_data(all.points, cut));
        ASSERT_EQ(f.hexahedra.size(), 1u) << cut.size();
        EXPECT_NEAR(f.hexahedra.quality[0], 1, 1e-12);
        EXPECT_NEAR(f.hexahedra.volume[0], 1, 1e-12);
        EXPECT_EQ(f.hexahedra.tets_of(0).size(), cut.size());
    }
    EXPECT_EQ(conforming, (std::map<std::size_t, int>{{5, 2}, {6, 72}}));
    EXPECT_EQ(with_flat, (std::map<std::size_t, int>{{6, 108}}));
}

// By kind of cut (table 3.1): those of five tetrahedra, those with a core of three, those about a diagonal in six like parts, and the
// others of two prisms. P_I/P_II and P_II/P_II (b) have the same numbers.
TEST(CubeCuts, EachKindOfCutHasTheCellsThatWereCounted) {
    const Cuts all;
    std::map<std::array<std::size_t, 3>, int> kinds;
    for (const test::Tets& cut : all.cuts) {
        if (!corners_of_gaps(cut, all.points).empty()) continue;
        const Found f = find(test::mesh_data(all.points, cut));
        ++kinds[{f.hexahedra.size(), f.prisms.size(), f.pyramids.size()}];
    }
    EXPECT_EQ(kinds, (std::map<std::array<std::size_t, 3>, int>{
                         {{1, 0, 0}, 2}, {{1, 0, 3}, 8}, {{1, 6, 6}, 4}, {{1, 4, 6}, 24 + 12}, {{1, 2, 5}, 24}}));
}

struct BrickRow {
    std::array<std::uint32_t, 3> n;
    std::size_t hexahedra, prisms, pyramids;
    std::uint64_t conflicts;
};

Candidates all_of(const Found& f) {
    Candidates all = f.hexahedra;
    all.append(f.prisms);
    all.append(f.pyramids);
    return all;
}

TEST(CubeCuts, BricksHaveTheCandidatesAndConflictsThatWereCounted) {
    for (const BrickRow& row : {BrickRow{{1, 1, 1}, 1, 6, 6, 66}, BrickRow{{2, 1, 1}, 4, 16, 14, 355},
                                BrickRow{{2, 2, 1}, 13, 42, 32, 1712}, BrickRow{{2, 2, 2}, 38, 108, 72, 7320}}) {
        const test::Lattice l = test::lattice(row.n);
        const Found f = find(test::mesh_data(l.points, test::kuhn_tets(l)));
        EXPECT_EQ(f.hexahedra.size(), row.hexahedra);
        EXPECT_EQ(f.prisms.size(), row.prisms);
        EXPECT_EQ(f.pyramids.size(), row.pyramids);
        const Candidates all = all_of(f);
        const Conflicts conflicts(all, f.tets.tets.size());
        EXPECT_EQ(conflicts.count(), row.conflicts);
        std::uint64_t apart = 0;
        for (std::uint32_t a = 0; a < all.size(); ++a) {
            for (std::uint32_t b = a + 1; b < all.size(); ++b) apart += stand_together(all, a, b) ? 0u : 1u;
        }
        EXPECT_EQ(apart, row.conflicts);
    }
}

/// What greedy rules take is independent, and nothing more fits.
TEST(CubeCuts, GreedyRulesTakeWhatStandsTogether) {
    test::Lattice l = test::lattice({3, 3, 3});
    test::jitter(l, 0.2);
    const Found f = find(test::mesh_data(l.points, test::kuhn_tets(l)));
    const Candidates all = all_of(f);
    const Conflicts conflicts(all, f.tets.tets.size());
    for (const Greedy rule :
         {Greedy::weight, Greedy::weight_by_degree, Greedy::weight_by_sum, Greedy::weight_less_sum, Greedy::least_degree}) {
        const auto selected = select_greedily(conflicts, all.quality, rule);
        for (std::size_t a = 0; a < selected.size(); ++a) {
            for (std::size_t b = a + 1; b < selected.size(); ++b) ASSERT_TRUE(stand_together(all, selected[a], selected[b]));
        }
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            const bool fits = std::ranges::all_of(selected, [&](std::uint32_t s) { return s != i && stand_together(all, s, i); });
            EXPECT_FALSE(fits);
        }
    }
}

}  // namespace
}  // namespace geomend::hexes
