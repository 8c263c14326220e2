// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/gocad.h"

#include <array>

#include "formats/gocad/object_frame.h"
#include "formats/gocad/read_gocad.h"

namespace geomend::gocad {

namespace {

// What the file is called says what it should hold, but any Gocad object may stand in any Gocad file: all rows read
// alike, and the extension only decides which row is named.
int sniff(std::string_view head, std::string_view) { return begins_with_gocad(head) ? 95 : 0; }

constexpr std::array<std::string_view, 1> ml{".ml"}, ts{".ts"}, pl{".pl"}, vs{".vs"}, so{".so"}, lso{".lso"}, sg{".sg"}, vo{".vo"},
    wl{".wl"}, gp{".gp"};
constexpr std::array<std::string_view, 2> gs{".gs", ".grs"};

Format row(std::string_view name, std::string_view title, std::span<const std::string_view> extensions) {
    Format format;
    format.name = name;
    format.family = "gocad";
    format.title = title;
    format.extensions = extensions;
    format.sniff = sniff;
    format.read = read_gocad;
    return format;
}

}  // namespace

std::span<const Format> formats() {
    static const std::array rows{
        row("gocad-ml", "Gocad Model3d: surfaces, regions, layers", ml),
        row("gocad-ts", "Gocad TSurf: triangulated surfaces", ts),
        row("gocad-pl", "Gocad PLine: polylines", pl),
        row("gocad-vs", "Gocad VSet: points", vs),
        row("gocad-so", "Gocad TSolid: tetrahedra", so),
        row("gocad-lso", "Gocad LightTSolid: tetrahedra", lso),
        row("gocad-sg", "Gocad SGrid: curvilinear grid", sg),
        row("gocad-vo", "Gocad Voxet: regular lattice", vo),
        row("gocad-gs", "Gocad 2D grid", gs),
        row("gocad-wl", "Gocad Well", wl),
        row("gocad-gp", "Gocad groups of objects", gp),
    };
    return rows;
}

}  // namespace geomend::gocad
