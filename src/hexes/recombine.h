// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "hexes/closing.h"
#include "hexes/heuristics.h"
#include "hexes/leftovers.h"
#include "hexes/numbering.h"
#include "hexes/selection.h"
#include "hexes/thin_cells.h"
#include "model/volume_mesh.h"

namespace geomend::hexes {

struct RecombineOptions {
    bool thin_only = false;      ///< prisms and pyramids in parts that are thin for their size, and nothing else: see thin_cells()
    double least_quality = 0.3;  ///< scaled Jacobian of every hexahedron; also of prisms
    std::uint64_t steps = 0;     ///< of the local search; 0: 1000 for each candidate, 200 million at most
    Closing closing = Closing::open;
    Heuristic select = Heuristic::search;
    int passes = 8;   ///< of smoothing
    CellCheck check;  ///< that prisms and pyramids of thin parts have to pass; empty: none. Others stand where one does not.
    const Monitor* monitor = nullptr;
};

/// The cells of one type in one region of the mesh made.
struct TypeShare {
    std::uint32_t region = 0;
    CellType type = CellType::tetrahedron;
    std::uint64_t count = 0;
    double volume = 0;
};

struct RecombineReport {
    std::uint64_t tetrahedra = 0;  ///< of the mesh given
    std::uint64_t candidates = 0;  ///< hexahedra
    std::uint64_t selected = 0;    ///< of them
    double first_share = 0;        ///< of the volume that those have which were selected first, before any had to give way
    ClosingCounts closing;
    LeftoverCounts leftovers;
    ThinCounts thin;                                     ///< where only thin parts were asked for
    std::uint64_t moves = 0;                             ///< of vertices, by which the worst cell around became better
    std::vector<TypeShare> shares;                       ///< of the mesh made, by region, then type
    std::vector<TypeShare> there;                        ///< of them, those of the mesh given that stay: all but tetrahedra
    double least_jacobian = 1;                           ///< scaled, of hexahedra
    std::array<std::uint64_t, 10> jacobian_by_tenths{};  ///< how many hexahedra
    std::uint64_t not_taken = 0;                         ///< prisms and pyramids that do not pass the check
    std::uint64_t folded = 0;                            ///< cells whose Jacobian is not positive throughout
    /// How many cells of a type the mesh has, and their part of its volume.
    std::uint64_t count_of(CellType type) const;
    std::uint64_t cell_count() const;
    double volume_share_of(CellType type) const;

    struct Part {
        std::uint64_t count = 0;
        double share = 0;
    };
    /// What was made of tetrahedra or is left of them, with its part of their volume.
    Part made_of(CellType type) const;
    /// What was there beside the tetrahedra, with its part of the whole volume.
    Part there_of(CellType type) const;
};

/// Makes hexahedra of the tetrahedra of a mesh, as many as can stand beside each other by volume and shape; what is left over becomes
/// prisms, and pyramids where quadrangles meet triangles. Surfaces, lines, regions and sets stay: where two triangles of a surface become
/// a quadrangle they do so on both sides. Cells of other types stay as they are. A mesh that is split along surfaces has to be joined
/// before. Failure (cannot_hold, F021) where there are no tetrahedra of the first order. The same for any number of threads. Cost: some 10
/// microseconds a candidate, of which there are as many as tetrahedra where points lie in lattices; and the local search.
Result<VolumeMesh> recombine(const VolumeMesh& mesh, const RecombineOptions& options, RecombineReport& report);

}  // namespace geomend::hexes
