// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/hexahedron_cuts.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "hexes/candidates.h"

// J. Pellerin, K. Verhetsel, J.-F. Remacle (2018): there are 174 kinds of cuts of a hexahedron into 5 to 15 tetrahedra. They are made
// here by another way than that of the search, which has to know none of them.

namespace geomend::hexes {
namespace {

/// The 48 ways to turn and mirror a cube, by where its corners go.
std::vector<std::array<std::uint32_t, 8>> symmetries() {
    const auto at = [](std::uint32_t v) { return std::array<std::uint32_t, 3>{(v ^ v >> 1) & 1, v >> 1 & 1, v >> 2}; };
    std::vector<std::array<std::uint32_t, 8>> all;
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
        for (std::uint32_t mirror = 0; mirror < 8; ++mirror) {
            std::array<std::uint32_t, 8> to{};
            for (std::uint32_t v = 0; v < 8; ++v) {
                for (std::uint32_t w = 0; w < 8; ++w) {
                    bool is_it = true;
                    for (std::size_t k = 0; k < 3; ++k) is_it = is_it && at(w)[k] == (at(v)[axes[k]] ^ (mirror >> k & 1));
                    if (is_it) to[v] = w;
                }
            }
            all.push_back(to);
        }
    } while (std::ranges::next_permutation(axes).found);
    return all;
}

/// A name of a cut that it shares with those that are it turned or mirrored.
std::vector<std::uint32_t> kind_of(const test::HexahedronCut& cut, const std::vector<std::array<std::uint32_t, 8>>& symmetries) {
    std::vector<std::uint32_t> least;
    for (const auto& to : symmetries) {
        std::vector<std::uint32_t> name;
        for (const auto& t : cut.tets) name.push_back(1u << to[t[0]] | 1u << to[t[1]] | 1u << to[t[2]] | 1u << to[t[3]]);
        std::ranges::sort(name);
        if (least.empty() || name < least) least = name;
    }
    return least;
}

/// The tetrahedra as a mesh of their own, whether they have volumes or not.
TetMesh mesh_of(const test::HexahedronCut& cut) {
    TetMesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    m.tets = cut.tets;
    m.region.assign(m.tets.size(), 0);
    m.wall.assign(m.tets.size(), {0, 0, 0, 0});
    find_across(m);
    m.star_offsets.push_back(0);
    for (std::uint32_t v = 0; v < 8; ++v) {
        for (std::uint32_t t = 0; t < m.tets.size(); ++t) {
            if (std::ranges::find(m.tets[t], v) != m.tets[t].end()) m.star.push_back(t);
        }
        m.star_offsets.push_back(static_cast<std::uint32_t>(m.star.size()));
    }
    m.wall_edges = PairSet({}, 8);
    m.lines = PairSet({}, 8);
    return m;
}

TEST(HexahedronCuts, EachOf174KindsIsFoundAsOneHexahedron) {
    const test::HexahedronCuts all;
    const auto turns = symmetries();
    std::map<std::size_t, std::set<std::vector<std::uint32_t>>> kinds;
    for (const test::HexahedronCut& cut : all.cuts) {
        kinds[cut.tets.size()].insert(kind_of(cut, turns));
        const TetMesh m = mesh_of(cut);
        const Candidates found = find_hexahedra(m, QuadTable(m, 0.9), {0.9, {}, nullptr});
        ASSERT_EQ(found.size(), 1u) << cut.tets.size();
        EXPECT_EQ(found.tets_of(0).size(), cut.tets.size());
        EXPECT_NEAR(found.volume[0], 1, 1e-12);  // with signs: those that are inside out count against the others
    }
    std::size_t sum = 0;
    for (const auto& [size, names] : kinds) sum += names.size();
    EXPECT_EQ(sum, 174u);
    EXPECT_EQ(kinds.begin()->first, 5u);
    EXPECT_EQ(kinds.rbegin()->first, 15u);
}

}  // namespace
}  // namespace geomend::hexes
