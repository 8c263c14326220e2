// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/eclipse/arrays.h"
#include "formats/eclipse/cell_arrays.h"
#include "formats/format.h"

// INIT and restart files hold values of cells, but neither corners nor which cells are active: that is in the grid
// file of the same name. Both are read in parts: a part is what stands for one grid (and one report step).

namespace geomend::eclipse {

/// The head of a part: what INTEHEAD and LOGIHEAD say.
struct PropertyHead {
    std::array<std::int32_t, 3> dims{0, 0, 0};  ///< nz counts both porosities
    std::int64_t active = -1;                   ///< values of arrays of active cells; -1: not stated
    std::int32_t unit = 0;                      ///< 1 metric, 2 field, 3 lab, 4 PVT-M
    bool dual = false;
    std::optional<std::array<int, 3>> date;  ///< year, month, day
};

/// Arrays [first, last) of a file that belong to one grid.
struct PropertyPart {
    std::string grid;  ///< name of a local refinement; empty: the global grid
    std::size_t first = 0, last = 0;
};

/// The value of INTEHEAD for a system, "METRIC" ...; empty where there is none.
std::string unit_system_name(std::int32_t unit);

/// Cuts the arrays [first, last) at LGR, and where the main grid goes on behind LGRSGONE or ENDLGR.
Result<std::vector<PropertyPart>> property_parts(const ArrayFile& file, std::size_t first, std::size_t last);

/// Reads INTEHEAD and LOGIHEAD of a part; nothing where there is no INTEHEAD.
Result<std::optional<PropertyHead>> property_head(const ArrayFile& file, const PropertyPart& part);

/// The grids that the values stand on.
class PropertyGrids {
public:
    PropertyGrids(const ArrayFile& file, const ReadOptions& options) : file_(file), options_(options) {}

    /// Reads the grid file of the same name beside the file, where there is one that can be read.
    Result<void> find_companion(const std::vector<PropertyPart>& parts);

    struct Place {
        std::size_t index = 0;  ///< in grids
        CellOrder order;
    };
    /// The grid of a part. Without a companion it has neither pillars nor depths, and its active cells are those of
    /// ACTNUM, those with pore volume (PORV), or all. Failure F010 where that does not give as many as the head says.
    Result<Place> grid_of(const PropertyPart& part);

    std::vector<CornerPointGrid> grids;
    std::vector<Finding> findings;
    std::vector<Annotation> annotations;
    std::vector<Loss> losses;

private:
    Result<void> take_pores_as_activity(const PropertyPart& part, const PropertyHead& head, CornerPointGrid& grid);
    Result<void> make_grid(const PropertyPart& part, const PropertyHead& head, CornerPointGrid& grid) const;

    const ArrayFile& file_;
    const ReadOptions& options_;
};

/// The array with a name in a part, or nullptr.
const Array* find_array(const ArrayFile& file, const PropertyPart& part, std::string_view name);

/// Whether an array of a simulator's output never holds values of cells, however many it has.
bool is_no_cell_array(std::string_view name);

}  // namespace geomend::eclipse
