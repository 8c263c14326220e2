// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "model/object_info.h"

namespace geomend {

/// The six faces of a cell (i,j,k). k grows downwards, so k_minus is the top.
enum class CellFace : std::uint8_t { i_minus, i_plus, j_minus, j_plus, k_minus, k_plus };

/// A corner-point grid: coordinate lines (pillars), on which each cell has its own eight corner depths. Depth-down,
/// in the file's own axes and unit of length; map axes are kept beside, never applied by reading. Cells are numbered
/// g = i + nx (j + ny k) from 0. Whole in memory: also the geometry of inactive cells.
struct CornerPointGrid {
    ObjectInfo info;                             ///< attributes of cells have one value (or `components`) per cell, inactive ones included
    std::array<std::uint32_t, 3> dims{1, 1, 1};  ///< numbers of cells nx, ny, nz, each at least 1

    /// Six values a pillar: x y z of its upper and of its lower point; pillar (i,j) is number i + (nx+1) j. With
    /// several sets of coordinate lines (reservoirs) one set after the other. 6 (nx+1)(ny+1) max(1, reservoirs.size()).
    std::vector<double> pillars;
    /// Corner depths (ZCORN), 8 nx ny nz; see corner_index().
    std::vector<double> depths;
    /// 0 inactive, 1 active; with two porosities 1 matrix, 2 fracture, 3 both. Empty: all are active.
    std::vector<std::uint8_t> activity;

    bool single_precision = false;  ///< the file stores float32
    bool cylindrical = false;       ///< pillars hold radius, angle in degrees and depth

    /// Layers that a set of coordinate lines is for (COORDSYS); first and last count from 0.
    struct Reservoir {
        std::uint32_t first_layer = 0, last_layer = 0;
        bool complete_circle = false;
        bool joined = false;
    };
    std::vector<Reservoir> reservoirs;  ///< empty: one set for all layers

    enum class Porosity : std::uint8_t { single, dual_porosity, dual_permeability };
    Porosity porosity = Porosity::single;

    /// Point on the map's Y axis of the grid, origin, point on its X axis: x1 y1 x2 y2 x3 y3 (MAPAXES).
    std::optional<std::array<double, 6>> map_axes;
    std::string map_unit;                  ///< METRES, FEET, CM; empty: not stated. The grid's own unit is in info.crs
    bool map_relative = false;             ///< the coordinates are in map axes already (GRIDUNIT ... MAP)
    std::vector<std::string> orientation;  ///< GDORIENT, five words; empty: not stated
    std::string unit_system;               ///< METRIC, FIELD, LAB, PVT-M; empty: not stated

    /// A fault as stated: boxes of cells (from 0, inclusive) one of whose faces lies on it.
    struct Fault {
        struct Box {
            std::array<std::uint32_t, 3> first, last;
            CellFace face;
        };
        std::string name;
        std::vector<Box> boxes;
        std::optional<double> multiplier;            ///< of transmissibility (MULTFLT)
        std::optional<double> edit_multiplier = {};  ///< MULTFLT of section EDIT, which OPM Flow takes instead
    };
    std::vector<Fault> faults;

    /// A stated non-neighbour connection; cells by number from 0. In grids of two porosities numbers from
    /// nx ny nz on mean the fracture.
    struct Connection {
        std::uint64_t first = 0, second = 0;
        std::optional<double> transmissibility;
    };
    std::vector<Connection> connections;
    /// What section EDIT does to an array that simulators compute (TRANX, TRANY, TRANZ, PORV), in a box of cells from 0,
    /// inclusive. Values that an attribute of that name holds are those that are left when all was done.
    struct EditOperation {
        enum class Kind : std::uint8_t { add, multiply, at_least, at_most };
        std::string array;
        Kind kind = Kind::multiply;
        double value = 1;
        std::array<std::uint32_t, 3> first{0, 0, 0}, last{0, 0, 0};
    };
    std::vector<EditOperation> edit_operations;  ///< in their order
    /// A factor on the connections of two cells, computed or stated (EDITNNC).
    struct ConnectionFactor {
        std::uint64_t first = 0, second = 0;
        double value = 1;
    };
    std::vector<ConnectionFactor> connection_factors;
    /// Stated connections with another grid of the same file: `first` is a cell of this grid, `second` one of that.
    struct Link {
        std::string grid;
        std::vector<Connection> connections;
    };
    std::vector<Link> links;

    /// How thin layers and gaps are bridged (PINCH).
    struct Pinch {
        double threshold = 0.001;
        bool gap = true;
        double largest_gap = 1e20;
        bool all_layers = false;         ///< ALL: transmissibility from all cells between, else TOPBOT
        bool multiplier_of_all = false;  ///< ALL: least MULTZ of the cells between, else that of the top
    };
    std::optional<Pinch> pinch;
    std::optional<double> least_pore_volume;  ///< MINPV

    /// A multiplier between regions (MULTREGT); an unset region means every one.
    struct RegionMultiplier {
        std::optional<int> from, to;
        double value = 1;
        std::string directions = "XYZ";
        std::string connections = "ALL";  ///< ALL, NNC, NONNC, NOAQUNNC
        char regions = 'M';               ///< M MULTNUM, F FLUXNUM, O OPERNUM
    };
    std::vector<RegionMultiplier> region_multipliers;

    /// Set for a local refinement: it refines these cells of the grid with that name.
    struct Host {
        std::string grid;                                            ///< name of the refined grid; empty: the global one
        std::array<std::uint32_t, 3> first{0, 0, 0}, last{0, 0, 0};  ///< box of host cells, from 0, inclusive
        std::vector<std::uint64_t> cells;                            ///< host of each own cell, or empty
    };
    std::optional<Host> host;

    std::size_t cell_count() const { return std::size_t{dims[0]} * dims[1] * dims[2]; }
    std::size_t cell(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return i + std::size_t{dims[0]} * (j + std::size_t{dims[1]} * k);
    }
    std::array<std::uint32_t, 3> ijk(std::size_t cell) const {
        const std::size_t row = cell / dims[0];
        return {static_cast<std::uint32_t>(cell % dims[0]), static_cast<std::uint32_t>(row % dims[1]),
                static_cast<std::uint32_t>(row / dims[1])};
    }
    bool is_active(std::size_t cell) const { return activity.empty() || activity[cell] != 0; }
};

/// Place in `depths` of corner c of cell (i,j,k): c is 0 (I-,J-), 1 (I+,J-), 2 (I-,J+), 3 (I+,J+) of the top, 4 to 7
/// the same of the bottom.
inline std::size_t corner_index(const std::array<std::uint32_t, 3>& dims, std::size_t i, std::size_t j, std::size_t k, unsigned c) {
    const std::size_t nx = dims[0], ny = dims[1];
    return 2 * i + (c & 1u) + 2 * nx * (2 * j + ((c >> 1) & 1u)) + 4 * nx * ny * (2 * k + (c >> 2));
}

/// Number of pillars of one set of coordinate lines.
inline std::size_t pillar_count(const std::array<std::uint32_t, 3>& dims) {
    return (std::size_t{dims[0]} + 1) * (std::size_t{dims[1]} + 1);
}

/// The set of coordinate lines that layer k uses.
std::size_t pillar_set(const CornerPointGrid& grid, std::uint32_t k);

/// Point of a pillar (its six values) at a depth: linear in depth, and straight down from the upper point where both
/// points have the same depth. Cylindrical pillars give x and y, too.
Vec3 pillar_point(const double* pillar, double depth, bool cylindrical = false);

/// The eight corners of a cell, in the order of corner_index; z is depth.
/// \pre i < nx, j < ny, k < nz
std::array<Vec3, 8> cell_corners(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k);

/// Number of cells that are active.
std::size_t active_count(const CornerPointGrid& grid);

/// Empty where the arrays have the lengths that the dims ask for; else what is wrong.
std::string misfit(const CornerPointGrid& grid);

}  // namespace geomend
