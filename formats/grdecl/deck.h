// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vector_variant.h"
#include "formats/grdecl/deck_text.h"
#include "formats/grdecl/keywords.h"
#include "model/dataset.h"

// What the text of a deck says of its grids, before it is made into geometry.

namespace geomend::grdecl {

using Dims = std::array<std::uint32_t, 3>;
/// A failure, or nothing.
using OptionalFailure = std::optional<Failure>;

/// Cells from first to last, counted from 0, both inclusive.
struct CellBox {
    Dims first{0, 0, 0}, last{0, 0, 0};

    std::uint64_t count() const {
        std::uint64_t n = 1;
        for (std::size_t a = 0; a < 3; ++a) n *= std::uint64_t{last[a]} - first[a] + 1;
        return n;
    }
};

/// One value per cell (of the deck's layers: with two porosities twice those of the geometry).
struct CellArray {
    std::string name;
    VectorVariant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::string>> values;
    Section section = Section::grid;
};

/// Everything that is said of one grid, the global one or a local refinement.
struct GridText {
    CornerPointGrid grid;  ///< header, faults, connections, multipliers and annotations; geometry comes at the end
    std::optional<Dims> dims;
    bool dims_stated = false;  ///< by DIMENS, SPECGRID or CARFIN
    bool dims_used = false;    ///< arrays of that size were read: they stay
    std::uint32_t coordinate_sets = 1;
    std::vector<double> pillars, depths;               ///< COORD, ZCORN
    std::vector<CellArray> arrays;                     ///< in the order in which they appear
    std::array<std::vector<double>, 3> widths;         ///< DXV or DRV, DYV or DTHETAV, DZV
    std::vector<double> corner_tops;                   ///< DEPTHZ
    std::optional<double> inner_radius, outer_radius;  ///< INRAD, OUTRAD
    bool radial = false;
    bool spider = false;                                   ///< radial, with straight sides between its pillars
    std::array<std::vector<std::uint32_t>, 3> fine_cells;  ///< NXFIN ...: fine cells of each host cell
    std::array<std::vector<double>, 3> fine_widths;        ///< HXFIN ...: their relative widths
    std::optional<std::string> geometry_file;              ///< GDFILE
    std::optional<char> usual_regions;                     ///< M or F, as RUNSPEC has it; see letter_of_regions()

    CellArray* find(std::string_view name) {
        for (CellArray& a : arrays) {
            if (a.name == name) return &a;
        }
        return nullptr;
    }
    /// Takes an array out; nothing where it is not there.
    std::optional<CellArray> take(std::string_view name) {
        for (auto a = arrays.begin(); a != arrays.end(); ++a) {
            if (a->name != name) continue;
            CellArray taken = std::move(*a);
            arrays.erase(a);
            return taken;
        }
        return {};
    }
};

/// Whose numbers count where a record names no kind of regions: those of MULTNUM (M) where GRIDOPTS has room for them, else of FLUXNUM (F),
/// as in OPM Flow. Without RUNSPEC: those that are there.
inline char letter_of_regions(GridText& g) {
    if (g.usual_regions) return *g.usual_regions;
    return g.find("MULTNUM") == nullptr && g.find("FLUXNUM") != nullptr ? 'F' : 'M';
}

/// Number of cells of a box of that size.
inline std::uint64_t cells_of(const Dims& d) { return std::uint64_t{d[0]} * d[1] * d[2]; }

/// A finding of the reader, of the severity that the catalogue gives the code.
Finding finding(std::string code, Location where, std::string message, std::uint64_t count = 0);

/// Item `i` as a number; `value` stays as it is where the item is defaulted. Failure F005 or F006.
OptionalFailure take_real(const Scanner& in, const Record& record, std::size_t i, std::string_view what, double& value);
OptionalFailure take_whole(const Scanner& in, const Record& record, std::size_t i, std::string_view what, std::int64_t& value);
/// Item `i` as a number that must be given. Failure F012 where it is not.
OptionalFailure need_real(const Scanner& in, const Record& record, std::size_t i, std::string_view what, double& value);
OptionalFailure need_whole(const Scanner& in, const Record& record, std::size_t i, std::string_view what, std::int64_t& value);

/// Six items I1 I2 J1 J2 K1 K2 from item `i` on into a box; items that are defaulted stay as they are.
/// Failure F012 where it is empty or not within the dims (dims 0: not known).
OptionalFailure take_box(const Scanner& in, const Record& record, std::size_t i, const Dims& dims, CellBox& box);

/// The next record of a keyword, by item_counts(). A '/' that is missing after all items of an operation on
/// arrays is taken as read, with a finding F147. Failure F004, F008, F012.
Result<Record> take_record(Scanner& in, std::string_view keyword, std::vector<Finding>& findings);

// ---- records of the grid's head, each with the scanner behind its keyword (head_records.cpp) ----

OptionalFailure read_map_axes(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_map_units(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_grid_unit(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_orientation(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_reservoirs(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_pinch(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_least_pore_volume(Scanner& in, GridText& g, std::vector<Finding>& findings);

// ---- lists (list_records.cpp) ----

/// Calls `each` for the records of a list up to its lone '/'. A list that ends with the file, its last line with a
/// line end, is taken with a finding F101.
template <class Each>
OptionalFailure read_list(Scanner& in, std::string_view keyword, std::vector<Finding>& findings, const Each& each);
bool list_ends(Scanner& in, std::string_view keyword, std::vector<Finding>& findings, OptionalFailure& trouble);

OptionalFailure read_faults(Scanner& in, GridText& g, std::vector<Finding>& findings);
/// \param in_edit they stand in section EDIT
OptionalFailure read_fault_multipliers(Scanner& in, GridText& g, bool in_edit, std::vector<Finding>& findings);
/// EDITNNC.
OptionalFailure read_connection_factors(Scanner& in, GridText& g, std::vector<Finding>& findings);
OptionalFailure read_connections(Scanner& in, GridText& g, std::vector<Finding>& findings, std::vector<Loss>& losses);
OptionalFailure read_region_multipliers(Scanner& in, GridText& g, std::vector<Finding>& findings);

template <class Each>
OptionalFailure read_list(Scanner& in, std::string_view keyword, std::vector<Finding>& findings, const Each& each) {
    OptionalFailure trouble;
    while (!list_ends(in, keyword, findings, trouble)) {
        auto record = take_record(in, keyword, findings);
        if (!record) return std::move(record).why();
        if (auto failed = each(*record)) return failed;
    }
    return trouble;
}

// ---- operations on arrays (array_edits.cpp) ----

struct EditResult {
    OptionalFailure trouble;
    bool applied = true;              ///< false: an array that it needs is not there
    std::string missing;              ///< that array
    std::string without_effect = {};  ///< why it is not applied although all is there; empty: it is
};

/// Whether PORV is stated or changed: simulators have computed pore volumes then, and what comes after does not enter.
bool has_pore_volumes(const GridText& g);

/// Whether a keyword is an operation on arrays (EQUALS, COPY, MULTIREG, OPERATE, ...).
bool is_edit(std::string_view keyword);
/// Does what one record of an operation says. `box` is the current box and becomes that of the record.
/// \param room cells that may still be made; new arrays are taken off it
/// Names and words that OPM Flow does not take are findings (F146, F149).
EditResult apply_edit(const Scanner& in, std::string_view keyword, const Record& record, GridText& g, CellBox& box, Section section,
                      std::uint64_t& room, std::vector<Finding>& findings);

// ---- into the model (build_grid.cpp, block_geometry.cpp, local_grids.cpp) ----

/// Makes the grid of a text; `dual` says that the deck's layers are those of two porosities. Arrays move out of it.
/// \param room values that may still be made
Result<CornerPointGrid> build_grid(GridText&& text, const Input& input, bool dual, std::uint64_t& room, std::vector<Finding>& findings,
                                   std::vector<Loss>& losses);

/// Pillars and corner depths from block sizes (DX DY DZ TOPS and their like), Cartesian or radial; takes those arrays
/// out of the text. Nothing is done where there are none.
OptionalFailure make_block_geometry(GridText& text, const Input& input, std::uint32_t layers, std::uint64_t& room,
                                    std::vector<Finding>& findings);

/// The geometry of a local grid that has none of its own: its host's cells cut evenly. Sets host cells and activity.
OptionalFailure refine_host(CornerPointGrid& grid, const std::array<std::vector<std::uint32_t>, 3>& fine_cells,
                            const std::array<std::vector<double>, 3>& fine_widths, const CornerPointGrid& host, const Input& input,
                            std::uint64_t& room);

/// Whether a local grid is what refine_host() makes of its host: its corners and activity then go without saying.
bool is_refined_host(const CornerPointGrid& grid, const CornerPointGrid& host);

/// Numbers of fine cells of each host cell along an axis, from the hosts of the cells; empty where they are not a box.
std::vector<std::uint32_t> fine_counts(const CornerPointGrid& grid, std::size_t axis);

}  // namespace geomend::grdecl
