// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/eclipse.h"

#include <array>

#include "formats/eclipse/arrays.h"
#include "formats/eclipse/read_egrid.h"
#include "formats/eclipse/write_eclipse.h"

namespace geomend::eclipse {

namespace {

constexpr std::string_view egrid_extensions[] = {".egrid"};
constexpr std::string_view fegrid_extensions[] = {".fegrid"};
constexpr std::string_view init_extensions[] = {".init"};
constexpr std::string_view finit_extensions[] = {".finit"};
constexpr std::string_view unrst_extensions[] = {".unrst"};
constexpr std::string_view funrst_extensions[] = {".funrst"};
constexpr std::string_view grid_extensions[] = {".grid"};
constexpr std::string_view fgrid_extensions[] = {".fgrid"};
constexpr std::string_view bgrdecl_extensions[] = {".bgrdecl"};

constexpr std::array bgrdecl_options{OptionRow{"dims", OptionUse::reading, OptionValue::whole_numbers, "NX,NY,NZ",
                                               "numbers of cells, for property files that do not state them"}};

enum class Kind : std::uint8_t { none, egrid, old_grid, init, restart, deck };

/// Whether the head names an array; names stand in the same eight characters in both encodings.
bool names(std::string_view head, std::string_view array) { return head.find(array) != std::string_view::npos; }

/// What the first array says. Files that begin with INTEHEAD are told by what comes after.
Kind kind_of(std::string_view head, const FirstArray& first) {
    if (first.name == "FILEHEAD") return Kind::egrid;
    if (first.name == "DIMENS") return Kind::old_grid;
    if (first.name == "SEQNUM") return Kind::restart;
    if (first.name == "INTEHEAD") {
        if (names(head, "PORV    ") && !names(head, "STARTSOL")) return Kind::init;
        if (names(head, "STARTSOL") || names(head, "IGRP    ") || names(head, "IWEL    ") || names(head, "ZWEL    ")) return Kind::restart;
        return Kind::init;
    }
    for (const std::string_view keyword : {"SPECGRID", "MAPAXES", "MAPUNITS", "GRIDUNIT", "GDORIENT", "COORD", "ZCORN", "COORDSYS"}) {
        if (first.name == keyword) return Kind::deck;
    }
    return Kind::none;
}

template <Kind kind, bool formatted>
int sniff(std::string_view head, std::string_view) {
    const auto first = first_array(head);
    if (!first || first->formatted != formatted) return 0;
    const Kind found = kind_of(head, *first);
    if (found == kind) return 100;
    // Other arrays first: of this family all the same; the extension decides between its rows.
    return found == Kind::none ? 20 : 0;
}

constexpr std::string_view tried = "real files and clients";
constexpr std::string_view tried_by_flow = "files that OPM flow wrote";
constexpr std::string_view grid_note =
    "substance: cell properties, faults, PINCH, MINPV, multipliers, transmissibilities, other objects; identity: name, unit system, "
    "rounding to single precision";
constexpr std::string_view init_note =
    "substance: corners, activity without pore volumes, connections, faults, local grids, other objects; identity: names longer than 8 "
    "characters, map axes";
constexpr std::string_view deck_note =
    "substance: faults, connections, local grids, second porosity, other objects; identity: name, unit system, names longer than 8 "
    "characters, rounding to single precision";

constexpr Keeps grid_keeps() {
    Keeps keeps;
    keeps.corner_point_grids = Keeping::yes;
    keeps.connections = Keeping::partly;
    keeps.several_objects = Keeping::partly;  // local refinements
    keeps.names = Keeping::partly;
    keeps.units = Keeping::partly;
    keeps.crs = Keeping::partly;
    return keeps;
}
constexpr Keeps property_keeps() {
    Keeps keeps;
    keeps.corner_point_grids = Keeping::partly;
    keeps.connections = Keeping::partly;
    keeps.attributes = Keeping::yes;
    keeps.no_data = Keeping::partly;
    return keeps;
}
constexpr Keeps deck_keeps() {
    Keeps keeps;
    keeps.corner_point_grids = Keeping::yes;
    keeps.attributes = Keeping::yes;
    keeps.units = Keeping::partly;
    keeps.crs = Keeping::partly;
    return keeps;
}

using enum WriterWants;

constexpr Format with_pore_volumes(Format row) {
    row.pore_volumes = true;
    return row;
}

constexpr std::array rows = {
    Format{"egrid",
           "eclipse",
           "EGRID, corner-point grid of simulators",
           egrid_extensions,
           sniff<Kind::egrid, false>,
           read_egrid,
           write_egrid,
           corner_point,
           grid_keeps(),
           grid_note,
           tried,
           {},
           false,
           true},
    Format{"fegrid",
           "eclipse",
           "FEGRID, the same as text",
           fegrid_extensions,
           sniff<Kind::egrid, true>,
           read_egrid,
           write_fegrid,
           corner_point,
           grid_keeps(),
           grid_note,
           tried,
           {},
           false,
           true},
    with_pore_volumes({"init", "eclipse", "INIT, properties of a simulator's cells", init_extensions, sniff<Kind::init, false>, read_init,
                       write_init, corner_point, property_keeps(), init_note, "real files"}),
    with_pore_volumes({"finit", "eclipse", "FINIT, the same as text", finit_extensions, sniff<Kind::init, true>, read_init, write_finit,
                       corner_point, property_keeps(), init_note, "real files"}),
    Format{"unrst",
           "eclipse",
           "UNRST, restart file: properties at report steps",
           unrst_extensions,
           sniff<Kind::restart, false>,
           read_restart,
           nullptr,
           corner_point,
           property_keeps(),
           "",
           tried_by_flow,
           {},
           false,
           true},
    Format{"funrst",
           "eclipse",
           "FUNRST, the same as text",
           funrst_extensions,
           sniff<Kind::restart, true>,
           read_restart,
           nullptr,
           corner_point,
           property_keeps(),
           "",
           "fixtures only: no real file was found",
           {},
           false,
           true},
    Format{"grid",
           "eclipse",
           "GRID, corner-point grid cell by cell",
           grid_extensions,
           sniff<Kind::old_grid, false>,
           read_old_grid,
           nullptr,
           corner_point,
           grid_keeps(),
           "",
           "real files",
           {},
           false,
           true},
    Format{"fgrid",
           "eclipse",
           "FGRID, the same as text",
           fgrid_extensions,
           sniff<Kind::old_grid, true>,
           read_old_grid,
           nullptr,
           corner_point,
           grid_keeps(),
           "",
           "fixtures only: no real file was found",
           {},
           false,
           true},
    Format{"bgrdecl", "eclipse", "GRDECL as binary records", bgrdecl_extensions, sniff<Kind::deck, false>, read_bgrdecl, write_bgrdecl,
           corner_point, deck_keeps(), deck_note, "real files", bgrdecl_options, false, true},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::eclipse
