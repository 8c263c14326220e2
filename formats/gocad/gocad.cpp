// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/gocad.h"

#include <array>

#include "formats/gocad/object_frame.h"
#include "formats/gocad/read_gocad.h"
#include "formats/gocad/write_gocad.h"

namespace geomend::gocad {

namespace {

// What the file is called says what it should hold, but any Gocad object may stand in any Gocad file: all rows read
// alike, and the extension only decides which row is named.
int sniff(std::string_view head, std::string_view) { return begins_with_gocad(head) ? 95 : 0; }

constexpr std::array<std::string_view, 1> ml{".ml"}, ts{".ts"}, pl{".pl"}, vs{".vs"}, so{".so"}, lso{".lso"}, sg{".sg"}, vo{".vo"},
    wl{".wl"}, gp{".gp"};
constexpr std::array<std::string_view, 2> gs{".gs", ".grs"};

constexpr std::array options{
    OptionRow{"triangulate", OptionUse::writing, OptionValue::words, "yes|no",
              "polygons of more than three corners are written as triangles"},
    OptionRow{"data", OptionUse::writing, OptionValue::words, "ascii|binary", "how grids write their values into the files beside them"},
};

Format row(std::string_view name, std::string_view title, std::span<const std::string_view> extensions, std::string_view tried_on,
           Writer write = write_objects, WriterWants wants = WriterWants::objects) {
    Format format;
    format.name = name;
    format.family = "gocad";
    format.title = title;
    format.extensions = extensions;
    format.sniff = sniff;
    format.read = read_gocad;
    format.write = write;
    format.wants = wants;
    format.bounded_regions = wants != WriterWants::objects;
    using enum Keeping;
    Keeps& keeps = format.keeps;
    keeps.points = keeps.polylines = keeps.surfaces = keeps.wells = yes;
    keeps.cells = keeps.structured_grids = keeps.rasters = partly;
    keeps.several_objects = keeps.names = keeps.roles = keeps.units = keeps.no_data = keeps.crs = keeps.exact_coordinates = yes;
    keeps.attributes = partly;
    keeps.brep = write == write_model3d || wants == WriterWants::tagged_mesh ? yes : no;
    format.lossy_note =
        "substance: polygons with more than three corners (but with triangulate=yes), cells that are not tetrahedra, text values, "
        "regions of a model (but in .ml, .so, .lso), sets and values of cells in a Voxet, vectors in a grid; "
        "identity: types of numbers in text, lines and corners of solids; style: annotations of other formats";
    format.tried_on = tried_on;
    format.options = options;
    return format;
}

}  // namespace

std::span<const Format> formats() {
    static const std::array rows{
        row("gocad-ml", "Gocad Model3d: surfaces, regions, layers", ml, "real files", write_model3d, WriterWants::faced_model),
        row("gocad-ts", "Gocad TSurf: triangulated surfaces", ts, "real files"),
        row("gocad-pl", "Gocad PLine: polylines", pl, "real files"),
        row("gocad-vs", "Gocad VSet: points", vs, "real files"),
        row("gocad-so", "Gocad TSolid: tetrahedra", so, "real files", write_objects, WriterWants::tagged_mesh),
        row("gocad-lso", "Gocad LightTSolid: tetrahedra", lso, "real files", write_light_objects, WriterWants::tagged_mesh),
        row("gocad-sg", "Gocad SGrid: curvilinear grid", sg,
            "fixtures only: of a real grid only the header was found, without its binary files"),
        row("gocad-vo", "Gocad Voxet: regular lattice", vo, "real files"),
        row("gocad-gs", "Gocad 2D grid", gs, "fixtures only: no real file was found"),
        row("gocad-wl", "Gocad Well", wl, "real files"),
        row("gocad-gp", "Gocad groups of objects", gp, "real files"),
    };
    return rows;
}

}  // namespace geomend::gocad
