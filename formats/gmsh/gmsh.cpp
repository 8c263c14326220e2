// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/gmsh.h"

#include <array>

#include "formats/gmsh/read_msh.h"
#include "formats/gmsh/sections.h"
#include "formats/gmsh/write_msh.h"

namespace geomend::gmsh {

namespace {

constexpr std::array<std::string_view, 1> extensions = {".msh"};

constexpr Keeps keeps() {
    Keeps k;
    k.points = k.polylines = k.surfaces = k.cells = Keeping::yes;
    k.polygons = Keeping::partly;
    k.structured_grids = k.rasters = k.wells = Keeping::partly;
    k.brep = k.several_objects = k.names = k.roles = Keeping::yes;
    k.attributes = k.units = k.no_data = k.crs = k.exact_coordinates = Keeping::yes;
    return k;
}

}  // namespace

std::span<const Format> formats() {
    static const std::array<Format, 1> rows = {Format{
        .name = "msh",
        .family = "gmsh",
        .title = "Gmsh mesh: MSH 1, 2, 4.0 and 4.1 read, 2.2 and 4.1 written, text and binary",
        .extensions = extensions,
        .sniff = sniff,
        .read = read_msh,
        .write = write_msh,
        .wants = WriterWants::tagged_mesh,
        .keeps = keeps(),
        .lossy_note = "substance: polygons of more than 4 corners, polyhedra, text properties, markers and logs of wells, second-order "
                      "elements unless order=2; identity: lattices become cells",
        .tried_on = "real files and clients",
    }};
    return rows;
}

}  // namespace geomend::gmsh
