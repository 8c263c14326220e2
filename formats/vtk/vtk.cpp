// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk.h"

#include <array>

#include "formats/vtk/legacy.h"
#include "formats/vtk/xml_read.h"
#include "formats/vtk/xml_write.h"

namespace geomend::vtk {

namespace {

using Names = std::array<std::string_view, 1>;
constexpr Names vtk{".vtk"}, vtu{".vtu"}, vtp{".vtp"}, vts{".vts"}, vti{".vti"}, vtr{".vtr"}, vtm{".vtm"}, pvd{".pvd"};
constexpr Names pvtu{".pvtu"}, pvtp{".pvtp"}, pvts{".pvts"}, pvti{".pvti"}, pvtr{".pvtr"};

template <int which>
int sniff(std::string_view head, std::string_view) {
    constexpr std::string_view types[] = {
        "UnstructuredGrid",  "PolyData",  "StructuredGrid",  "ImageData",  "RectilinearGrid",  "vtkMultiBlockDataSet",
        "PUnstructuredGrid", "PPolyData", "PStructuredGrid", "PImageData", "PRectilinearGrid", "Collection"};
    return sniff_xml(head, types[which]);
}

constexpr Keeping yes = Keeping::yes, partly = Keeping::partly, no = Keeping::no;

// What all VTK files share: attributes of all types, and our words in the field data.
constexpr Keeps common{.several_objects = no,
                       .names = yes,
                       .roles = yes,
                       .attributes = yes,
                       .units = yes,
                       .no_data = yes,
                       .crs = yes,
                       .exact_coordinates = yes};

constexpr Keeps cell_keeps() {
    Keeps k = common;
    k.points = k.polylines = k.surfaces = k.polygons = k.cells = k.polyhedra = k.several_objects = yes;
    k.wells = partly;
    k.brep = partly;
    return k;
}

constexpr Keeps poly_keeps() {
    Keeps k = cell_keeps();
    k.cells = k.polyhedra = no;
    return k;
}

constexpr Keeps legacy_keeps() {
    Keeps k = common;
    k.points = k.polylines = k.surfaces = k.polygons = k.cells = k.polyhedra = k.structured_grids = k.rasters = yes;
    return k;
}

constexpr Keeps grid_keeps() {
    Keeps k = common;
    k.structured_grids = yes;
    return k;
}

constexpr Keeps raster_keeps() {
    Keeps k = common;
    k.rasters = yes;
    return k;
}

constexpr Keeps block_keeps() {
    Keeps k = cell_keeps();
    k.structured_grids = k.rasters = k.brep = yes;
    return k;
}

constexpr std::array legacy_options{
    OptionRow{"encoding", OptionUse::writing, OptionValue::words, "text|binary|ascii", "text (the default, also called ascii) or binary"},
    OptionRow{"version", OptionUse::writing, OptionValue::words, "5.1|4.2", "version of the file; older readers understand 4.2"},
};
constexpr std::array xml_options{
    OptionRow{"encoding", OptionUse::writing, OptionValue::words, "appended|ascii", "raw data at the end (the default), or text"},
    OptionRow{"compress", OptionUse::writing, OptionValue::words, "yes|no", "compressed by zlib, or not (the default)"},
};

// What all of them do.
constexpr Format of_family(Format row) {
    row.family = "vtk";
    row.flat_meshes = row.elevations = true;
    row.bounded_regions = row.wants == WriterWants::brep;
    if (row.write != nullptr) row.options = row.write == write_legacy ? std::span<const OptionRow>(legacy_options) : xml_options;
    return row;
}

constexpr std::string_view wells_note = "substance: markers, zones and curves of wells";
constexpr std::string_view one_note = "substance: all but one object, and objects of other kinds";

const std::array rows = {
    of_family({"vtk", "vtk", "VTK legacy", vtk, sniff_legacy, read_legacy, write_legacy, WriterWants::objects, legacy_keeps(),
               "substance: all but one object; wells", "real files and clients"}),
    of_family({"vtu", "vtk", "VTK XML unstructured grid", vtu, sniff<0>, read_vtk_xml, write_vtu, WriterWants::objects, cell_keeps(),
               "substance: grids and rasters; markers, zones and curves of wells", "real files and clients"}),
    of_family({"vtp", "vtk", "VTK XML poly data", vtp, sniff<1>, read_vtk_xml, write_vtp, WriterWants::objects, poly_keeps(),
               "substance: cells, grids and rasters; markers, zones and curves of wells", "real files and clients"}),
    of_family({"vts", "vtk", "VTK XML structured grid", vts, sniff<2>, read_vtk_xml, write_vts, WriterWants::objects, grid_keeps(),
               one_note, "real files and clients"}),
    of_family({"vti", "vtk", "VTK XML image", vti, sniff<3>, read_vtk_xml, write_vti, WriterWants::objects, raster_keeps(), one_note,
               "fixtures and clients: no real file was found"}),
    of_family({"vtr", "vtk", "VTK XML rectilinear grid", vtr, sniff<4>, read_vtk_xml, write_vtr, WriterWants::objects, raster_keeps(),
               one_note, "fixtures and clients: no real file was found"}),
    of_family({"vtm", "vtk", "VTK XML multi-block: a block per corner, line, surface and region", vtm, sniff<5>, read_vtk_xml, write_vtm,
               WriterWants::brep, block_keeps(), wells_note, "real files and clients"}),
    of_family({"pvd", "vtk", "ParaView series in time: a VTK XML file per report step", pvd, sniff<11>, read_vtk_xml, write_pvd,
               WriterWants::objects, cell_keeps(), "substance: models; markers, zones and curves of wells",
               "fixtures and clients: made from restart files"}),
    of_family({"pvtu", "vtk", "VTK XML unstructured grid in pieces", pvtu, sniff<6>, read_vtk_xml, nullptr, WriterWants::objects,
               cell_keeps(), "", "real files"}),
    of_family({"pvtp", "vtk", "VTK XML poly data in pieces", pvtp, sniff<7>, read_vtk_xml, nullptr, WriterWants::objects, poly_keeps(), "",
               "fixtures only: no real file was found"}),
    of_family({"pvts", "vtk", "VTK XML structured grid in pieces", pvts, sniff<8>, read_vtk_xml, nullptr, WriterWants::objects,
               grid_keeps(), "", "fixtures only: no real file was found"}),
    of_family({"pvti", "vtk", "VTK XML image in pieces", pvti, sniff<9>, read_vtk_xml, nullptr, WriterWants::objects, raster_keeps(), "",
               "fixtures only: no real file was found"}),
    of_family({"pvtr", "vtk", "VTK XML rectilinear grid in pieces", pvtr, sniff<10>, read_vtk_xml, nullptr, WriterWants::objects,
               raster_keeps(), "", "fixtures only: no real file was found"}),
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::vtk
