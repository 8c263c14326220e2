// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hexes/conflicts.h"
#include "hexes/tet_mesh.h"

namespace geomend::hexes {

/// How candidates are selected: by the search of this house, or by a heuristic of A. Botella, "Génération de maillages non structurés
/// volumiques de modèles géologiques pour la simulation de phénomènes physiques" (2016), 3.4, by the name it has there.
enum class Heuristic : std::uint8_t {
    search,             ///< search_selection()
    gmax1,              ///< the heaviest first
    gmax2,              ///< weight by number of conflicts and one
    gmax3,              ///< weight by its sum with those in conflict
    gmax4,              ///< weight less that of those in conflict
    gtet,               ///< from tetrahedron to neighbouring tetrahedron, of each the heaviest
    cograph_rand,       ///< the conflicts with more of them, so that the best selection is known: candidates put in at random,
    cograph_max,        ///< the heaviest first,
    cograph_min,        ///< the lightest first
    comp_cograph_rand,  ///< the same with fewer conflicts; what does not go together then is left out, the lightest first
    comp_cograph_max,
    comp_cograph_min,
};

inline constexpr std::array<std::string_view, 12> heuristic_names{
    "search",      "GMax1",      "GMax2",      "GMax3",           "GMax4",          "GTet",
    "CographRAND", "CographMAX", "CographMIN", "CompCographRAND", "CompCographMAX", "CompCographMIN"};

/// Nothing for an unknown name.
std::optional<Heuristic> heuristic_named(std::string_view name);

/// The weights of the same source: 10 for a hexahedron and 4 for a prism, and the mean sine of the corners of its quadrangles.
std::vector<double> weights_by_angles(const TetMesh& mesh, const Candidates& candidates);

/// \pre not Heuristic::search \return the selected, ascending; what is random is the same each time. Cost: as select_greedily(), linear in
/// conflicts for GTet, and that times the depth of a tree for the others, which may be a thousand.
std::vector<std::uint32_t> select_by(Heuristic rule, const TetMesh& mesh, const Conflicts& conflicts, std::span<const double> weights);

}  // namespace geomend::hexes
