// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/surfaces.h"

#include <array>

#include "formats/surfaces/obj.h"
#include "formats/surfaces/off.h"
#include "formats/surfaces/ply.h"
#include "formats/surfaces/smesh.h"
#include "formats/surfaces/stl.h"

namespace geomend::surfaces {

namespace {

constexpr std::string_view stl_extensions[] = {".stl"}, obj_extensions[] = {".obj"}, ply_extensions[] = {".ply"},
                           off_extensions[] = {".off"}, smesh_extensions[] = {".smesh", ".poly"};
constexpr std::string_view tried = "fixtures and clients: no real file was found", by_itself = "fixtures only: no real file was found";
constexpr std::string_view note =
    "substance: attributes, points, lines, cells, grids, wells, regions; identity: role, feature, units, coordinate system";
constexpr std::string_view ply_note =
    "substance: texts, attributes of several surfaces, points, lines, cells, grids, wells, regions; identity: names, role, feature, units, "
    "coordinate system";

constexpr OptionRow encoding_row{"encoding", OptionUse::writing, OptionValue::words, "text|binary", "how numbers are written"};
constexpr std::array encoding_options{encoding_row};

constexpr Keeps keeps(Keeping polygons, Keeping names, Keeping attributes) {
    Keeps k;
    k.surfaces = k.exact_coordinates = Keeping::yes;
    k.polygons = polygons;
    k.names = k.several_objects = names;
    k.attributes = attributes;
    return k;
}

constexpr std::array rows = {
    Format{"stl", "surface", "STL: triangles of solids", stl_extensions, sniff_stl, read_stl, write_stl, WriterWants::objects,
           keeps(Keeping::no, Keeping::yes, Keeping::no), note, "real files and clients", encoding_options},
    Format{"obj", "surface", "Wavefront OBJ", obj_extensions, sniff_obj, read_obj, write_obj, WriterWants::objects,
           keeps(Keeping::yes, Keeping::yes, Keeping::no), note, tried},
    Format{"ply", "surface", "PLY: polygons with numbers at points and polygons", ply_extensions, sniff_ply, read_ply, write_ply,
           WriterWants::objects, keeps(Keeping::yes, Keeping::no, Keeping::yes), ply_note, tried, encoding_options},
    Format{"off", "surface", "OFF", off_extensions, sniff_off, read_off, write_off, WriterWants::objects,
           keeps(Keeping::yes, Keeping::no, Keeping::no), note, by_itself},
    Format{"smesh", "surface", "TetGen: facets of surfaces, in .smesh or .poly", smesh_extensions, sniff_smesh, read_smesh, write_smesh,
           WriterWants::objects, keeps(Keeping::yes, Keeping::yes, Keeping::no), note, tried},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::surfaces
