// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/gmsh.h"

#include <array>

#include "formats/gmsh/read_msh.h"
#include "formats/gmsh/sections.h"
#include "formats/gmsh/write_geo.h"
#include "formats/gmsh/write_msh.h"

namespace geomend::gmsh {

namespace {

constexpr std::array<std::string_view, 1> extensions = {".msh"};
constexpr std::array<std::string_view, 1> script_extensions = {".geo"};

constexpr Keeps keeps() {
    Keeps k;
    k.points = k.polylines = k.surfaces = k.cells = Keeping::yes;
    k.polygons = Keeping::partly;
    k.structured_grids = k.rasters = k.wells = Keeping::partly;
    k.brep = k.several_objects = k.names = k.roles = Keeping::yes;
    k.attributes = k.units = k.no_data = k.crs = k.exact_coordinates = Keeping::yes;
    return k;
}

constexpr std::array options{
    OptionRow{"version", OptionUse::writing, OptionValue::words, "4.1|2.2", "version of the mesh file"},
    OptionRow{"binary", OptionUse::writing, OptionValue::words, "yes|no|true|false|1|0", "binary, or text (the default)"},
    OptionRow{"order", OptionUse::writing, OptionValue::words, "1|2",
              "1 (the default) makes elements of second order linear, 2 keeps them"},
};

}  // namespace

std::span<const Format> formats() {
    static const std::array<Format, 2> rows = {
        {{
             .name = "msh",
             .family = "gmsh",
             .title = "Gmsh mesh: MSH 1, 2, 4.0 and 4.1 read, 2.2 and 4.1 written, text and binary",
             .extensions = extensions,
             .sniff = sniff,
             .read = read_msh,
             .write = write_msh,
             .wants = WriterWants::tagged_mesh,
             .keeps = keeps(),
             .lossy_note =
                 "substance: polygons of more than 4 corners, polyhedra, text properties, markers and logs of wells, second-order "
                 "elements unless order=2; identity: lattices become cells",
             .tried_on = "real files and clients",
             .options = options,
             .flat_meshes = true,
             .statements = true,
             .elevations = true,
         },
         {
             .name = "geo",
             .family = "gmsh",
             .title = "Gmsh script over an MSH file beside it: `gmsh -3` fills the regions",
             .extensions = script_extensions,
             .write = write_geo,
             .wants = WriterWants::tagged_mesh,
             .keeps = keeps(),
             .lossy_note = "as msh, which stands beside it",
             .tried_on = "clients",
             .options = options,
             .flat_meshes = true,
             .statements = true,
             .elevations = true,
             .bounded_regions = true,
         }}};
    return rows;
}

}  // namespace geomend::gmsh
