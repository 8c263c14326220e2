// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

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

constexpr auto everywhere = [](const Vec3&) { return true; };

/// All sets of tetrahedra that fill a body in the unit cube, by its corners, by exact cover of points inside.
class Cuts {
public:
    explicit Cuts(std::vector<Vec3> corners = test::lattice({1, 1, 1}).points,
                  const std::function<bool(const Vec3&)>& is_inside = everywhere)
        : points(std::move(corners)) {
        take_samples(is_inside);
        const auto count = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t a = 0; a < count; ++a) {
            for (std::uint32_t b = a + 1; b < count; ++b) {
                for (std::uint32_t c = b + 1; c < count; ++c) {
                    for (std::uint32_t d = c + 1; d < count; ++d) add({a, b, c, d});
                }
            }
        }
        std::vector<std::size_t> chosen;
        cover({}, chosen);
    }
    std::vector<test::Tets> cuts;
    const std::vector<Vec3> points;

private:
    static constexpr std::size_t samples = 3000;
    using Inside = std::bitset<samples>;

    void take_samples(const std::function<bool(const Vec3&)>& is_inside) {
        std::uint32_t random = 7;
        while (samples_.size() < samples) {
            Vec3 x{};
            for (double& c : x) {
                random = random * 1664525u + 1013904223u;
                c = (random >> 8) / double(1 << 24);
            }
            if (is_inside(x)) samples_.push_back(x);
        }
    }

    double six(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
        return dot(minus(b, a), cross(minus(c, a), minus(d, a)));
    }
    void add(std::array<std::uint32_t, 4> t) {
        const auto p = [&](std::size_t k) { return points[t[k]]; };
        const double whole = six(p(0), p(1), p(2), p(3));
        if (whole == 0) return;
        if (whole < 0) std::swap(t[2], t[3]);
        Inside inside;
        for (std::size_t s = 0; s < samples; ++s) {
            const Vec3& x = samples_[s];
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

    std::vector<Vec3> samples_;
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

/// A name of a cut of the cube that it shares with those that are it turned or mirrored. Corners are numbered by x, y and z as bits.
std::vector<std::uint32_t> kind_of(const test::Tets& cut) {
    std::vector<std::uint32_t> least;
    std::array<std::uint32_t, 3> axes{0, 1, 2};
    do {
        for (std::uint32_t mirror = 0; mirror < 8; ++mirror) {
            std::vector<std::uint32_t> name;
            for (const auto& t : cut) {
                std::uint32_t corners = 0;
                for (const std::uint32_t v : t) {
                    std::uint32_t to = 0;
                    for (std::uint32_t k = 0; k < 3; ++k) to |= (v >> k & 1u) << axes[k];
                    corners |= 1u << (to ^ mirror);
                }
                name.push_back(corners);
            }
            std::ranges::sort(name);
            if (least.empty() || name < least) least = name;
        }
    } while (std::ranges::next_permutation(axes).found);
    return least;
}

/// How many kinds there are of so many cuts each.
std::map<int, int> kinds_by_size(const std::map<std::vector<std::uint32_t>, int>& cuts_of) {
    std::map<int, int> kinds;
    for (const auto& [kind, cuts] : cuts_of) ++kinds[cuts];
    return kinds;
}

// Tables 3.1 and 3.2: six kinds of cuts that conform, and four with a flat tetrahedron between two prisms.
TEST(CubeCuts, ThereAreSixKindsAndFourWithAFlatTetrahedron) {
    const Cuts all;
    std::map<std::vector<std::uint32_t>, int> conforming, with_flat;
    for (const test::Tets& cut : all.cuts) ++(corners_of_gaps(cut, all.points).empty() ? conforming : with_flat)[kind_of(cut)];
    EXPECT_EQ(kinds_by_size(conforming), (std::map<int, int>{{2, 1}, {8, 1}, {4, 1}, {24, 2}, {12, 1}}));
    EXPECT_EQ(kinds_by_size(with_flat), (std::map<int, int>{{12, 1}, {48, 1}, {24, 2}}));
}

/// Whether an edge between two corners is one of the tetrahedra's.
bool has_edge(const test::Tets& cut, std::uint32_t a, std::uint32_t b) {
    const auto has = [](const auto& t, std::uint32_t v) { return std::ranges::find(t, v) != t.end(); };
    return std::ranges::any_of(cut, [&](const auto& t) { return has(t, a) && has(t, b); });
}

// Of the eight ways to cut the quadrangles of a prism, six are those of tetrahedra: all but the two that go around it.
TEST(PrismCuts, SixOfEightDiagonalsMakeOnePrismEach) {
    const Cuts all({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, [](const Vec3& x) { return x[0] + x[1] < 1; });
    ASSERT_EQ(all.cuts.size(), 6u);
    std::set<unsigned> rising;  // bit k: the quadrangle between corners k and k + 1 is cut from the lower k to the upper k + 1
    for (const test::Tets& cut : all.cuts) {
        EXPECT_EQ(cut.size(), 3u);
        unsigned diagonals = 0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = (k + 1) % 3;
            EXPECT_NE(has_edge(cut, k, next + 3), has_edge(cut, next, k + 3));
            if (has_edge(cut, k, next + 3)) diagonals |= 1u << k;
        }
        rising.insert(diagonals);
        const Found f = find(test::mesh_data(all.points, cut));
        ASSERT_EQ(f.prisms.size(), 1u);
        EXPECT_EQ(f.prisms.tets_of(0).size(), 3u);
        EXPECT_NEAR(f.prisms.volume[0], 0.5, 1e-12);
        EXPECT_EQ(f.hexahedra.size(), 0u);
    }
    EXPECT_EQ(rising, (std::set<unsigned>{1, 2, 3, 4, 5, 6}));
    for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(std::ranges::count_if(rising, [&](unsigned d) { return (d >> k & 1u) != 0; }), 3);
}

TEST(PyramidCuts, BothMakeOnePyramid) {
    const Cuts all({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                   [](const Vec3& x) { return x[0] + x[2] < 1 && x[1] + x[2] < 1; });
    ASSERT_EQ(all.cuts.size(), 2u);
    for (const test::Tets& cut : all.cuts) {
        const Found f = find(test::mesh_data(all.points, cut));
        ASSERT_EQ(f.pyramids.size(), 1u);
        EXPECT_EQ(f.pyramids.tets_of(0).size(), 2u);
        EXPECT_NEAR(f.pyramids.volume[0], 1.0 / 3, 1e-12);
        EXPECT_EQ(f.prisms.size() + f.hexahedra.size(), 0u);
    }
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
