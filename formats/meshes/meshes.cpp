// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/meshes.h"

#include <array>

#include "formats/meshes/read_abaqus.h"
#include "formats/meshes/read_medit.h"
#include "formats/meshes/read_tetgen.h"
#include "formats/meshes/write_abaqus.h"
#include "formats/meshes/write_cgns.h"
#include "formats/meshes/write_code_aster.h"
#include "formats/meshes/write_csmp.h"
#include "formats/meshes/write_exodus.h"
#include "formats/meshes/write_feflow.h"
#include "formats/meshes/write_gprs.h"
#include "formats/meshes/write_medit.h"
#include "formats/meshes/write_mfem.h"
#include "formats/meshes/write_modflow.h"
#include "formats/meshes/write_openfoam.h"
#include "formats/meshes/write_pflotran.h"
#include "formats/meshes/write_tetgen.h"
#include "formats/meshes/write_tough2.h"
#include "formats/meshes/write_ucd.h"

namespace geomend::meshes {

namespace {

constexpr std::string_view medit_extensions[] = {".mesh", ".meshb"}, tetgen_extensions[] = {".node", ".ele"},
                           abaqus_extensions[] = {".inp"}, code_aster_extensions[] = {".mail"}, openfoam_extensions[] = {".foam"},
                           pflotran_extensions[] = {".uge"}, modflow_extensions[] = {".disu"}, ucd_extensions[] = {".ucd", ".avs"},
                           mfem_extensions[] = {".mfem"}, exodus_extensions[] = {".exo", ".e", ".ex2", ".g"},
                           feflow_extensions[] = {".fem"}, csmp_extensions[] = {".asc"}, gprs_extensions[] = {".gprs"},
                           tough2_extensions[] = {".tough2"}, cgns_extensions[] = {".cgns"};
constexpr std::string_view tried = "fixtures and clients: no real file was found",
                           tried_by_readers_of_tests = "fixtures only: no client was at hand";

/// A mesh has to be made and prepared before it is written: see MeshFormat.
Result<std::vector<Loss>> refuse_dataset(const Dataset&, OutputSet& out, const WriteOptions&) {
    return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()},
                   "only a prepared mesh of cells can be written in this format");
}

constexpr Format row(std::string_view name, std::string_view title, std::span<const std::string_view> extensions, std::string_view note) {
    Format format{};
    format.name = name;
    format.family = "mesh";
    format.title = title;
    format.extensions = extensions;
    format.write = refuse_dataset;
    format.keeps.cells = Keeping::partly;
    format.keeps.fault_faces = Keeping::partly;
    format.lossy_note = note;
    format.tried_on = tried;
    return format;
}

constexpr Format medit_row() {
    Format format =
        row("medit", "Medit: cells with numbers of regions, and of faces and edges of sets", medit_extensions,
            "substance: pyramids, polyhedra, second order, node sets, attributes, points, grids, wells; identity: names, sides, "
            "units, coordinate system");
    format.keeps.exact_coordinates = Keeping::yes;
    format.sniff = sniff_medit;
    format.read = read_medit;
    return format;
}

constexpr Format tetgen_row() {
    Format format = row("tetgen", "TetGen: tetrahedra with numbers of regions and faces, in .node, .ele and .face", tetgen_extensions,
                        "substance: other cells, edge and node sets, texts, attributes of cells, points, grids, wells; identity: names, "
                        "sides, units, coordinate system");
    format.keeps.attributes = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    format.sniff = sniff_tetgen;
    format.read = read_tetgen;
    return format;
}

constexpr Format abaqus_row() {
    Format format = row("abaqus", "Abaqus and CalculiX: elements, and sets of elements, faces and nodes", abaqus_extensions,
                        "substance: pyramids, polyhedra, attributes, points, grids, wells; identity: edges (their nodes are kept), names "
                        "that are no words, roles, digits beyond 20 characters, units, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::partly;
    format.sniff = sniff_abaqus;
    format.read = read_abaqus;
    format.tried_on = "real files and clients";
    return format;
}

constexpr Format code_aster_row() {
    Format format = row("code-aster", "Code_Aster: elements split along faults, and groups of elements and nodes", code_aster_extensions,
                        "substance: polyhedra, second order, attributes, points, grids, wells; identity: names that are no words of 24 "
                        "characters, roles, units, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    format.tried_on = tried_by_readers_of_tests;
    return format;
}

constexpr Format csmp_row() {
    Format format = row(
        "csmp", "CSMP++: families of elements for regions, surfaces and lines, with their neighbours, in .asc, .dat and -regions.txt",
        csmp_extensions,
        "substance: polyhedra, second order, further sets on the same faces, node sets, attributes, points, grids; identity: names that "
        "are no words or twice, sides, roles, units, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    format.tried_on = tried_by_readers_of_tests;
    return format;
}

constexpr Format openfoam_row() {
    Format format = row("openfoam", "OpenFOAM: constant/polyMesh beside a .foam file, with patches and zones", openfoam_extensions,
                        "substance: second order, edge sets, further sets on the same faces, attributes, points, grids, wells; identity: "
                        "names that are no words or twice, roles, units, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    return format;
}

constexpr Format ucd_row() {
    Format format = row("avs-ucd", "AVS UCD: cells with numbers of regions, values at points and in cells", ucd_extensions,
                        "substance: polyhedra, second order, sets, texts, points, grids, wells; identity: names, coordinate system");
    format.keeps.attributes = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    return format;
}

constexpr Format mfem_row() {
    Format format = row("mfem", "MFEM mesh v1.0: tetrahedra and hexahedra with numbers of regions and of faces of sets", mfem_extensions,
                        "substance: other cells, second order, edge and node sets, attributes, points, grids, wells; identity: names, "
                        "sides, units, coordinate system");
    format.keeps.exact_coordinates = Keeping::yes;
    format.tried_on = tried_by_readers_of_tests;
    return format;
}

constexpr Format exodus_row() {
    Format format = row("exodus", "Exodus II: element blocks by region and type, side sets, node sets, values at nodes and of elements",
                        exodus_extensions,
                        "substance: polyhedra, second order, edge sets, texts, points, grids, wells; identity: the end of names beyond 32 "
                        "characters, roles, units, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.attributes = Keeping::partly;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    return format;
}

constexpr Format cgns_row() {
    Format format =
        row("cgns", "CGNS in HDF5: sections of elements, families of regions and sets, boundary conditions, values", cgns_extensions,
            "substance: polyhedra, edge sets, nodes in the middle of faces and cells, texts, points, grids, wells; identity: the "
            "end of names beyond 32 characters, units other than m, ft and cm, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.attributes = Keeping::partly;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    return format;
}

constexpr Format feflow_row() {
    Format format =
        row("feflow", "FEFLOW: elements, sets of elements for regions, chains of edges as discrete features", feflow_extensions,
            "substance: pyramids, polyhedra, second order, faces, node sets, attributes, points, grids, wells; identity: units, "
            "coordinate system");
    format.keeps.fault_faces = Keeping::no;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    format.tried_on = tried_by_readers_of_tests;
    return format;
}

constexpr std::string_view network_losses =
    "substance: shapes of cells, edge and node sets, attributes, points, grids, wells; identity: "
    "names that are too long or no words, units, coordinate system";

constexpr Format network_row(std::string_view name, std::string_view title, std::span<const std::string_view> extensions,
                             std::string_view losses = network_losses) {
    Format format = row(name, title, extensions, losses);
    format.tried_on = tried_by_readers_of_tests;
    return format;
}

constexpr std::array rows = {
    abaqus_row(),
    ucd_row(),
    cgns_row(),
    code_aster_row(),
    csmp_row(),
    exodus_row(),
    feflow_row(),
    network_row(
        "gprs", "GPRS: a network of pipes between cells, with volumes, centres and areas", gprs_extensions,
        "substance: shapes and regions of cells, sets, attributes, points, grids, wells; identity: names, units, coordinate system"),
    medit_row(),
    mfem_row(),
    network_row("modflow-disu", "MODFLOW 6: the package DISU of unstructured cells", modflow_extensions,
                "substance: shapes of cells, sets, attributes, points, grids, wells; identity: names (they are comments), units other "
                "than m, ft and cm, coordinate system"),
    openfoam_row(),
    network_row("pflotran", "PFLOTRAN: explicit unstructured grid, with files of regions and of faces", pflotran_extensions),
    tetgen_row(),
    network_row("tough2", "TOUGH2: elements and connections of a MESH file", tough2_extensions)};
constexpr std::array mesh_rows = {MeshFormat{"abaqus", "abaqus", write_abaqus},
                                  MeshFormat{"avs-ucd", "avs-ucd", write_ucd},
                                  MeshFormat{"cgns", "cgns", write_cgns},
                                  MeshFormat{"code-aster", "code-aster", write_code_aster},
                                  MeshFormat{"csmp", "csmp", write_csmp},
                                  MeshFormat{"exodus", "exodus", write_exodus},
                                  MeshFormat{"feflow", "feflow", write_feflow},
                                  MeshFormat{"gprs", "gprs", write_gprs},
                                  MeshFormat{"medit", "medit", write_medit},
                                  MeshFormat{"mfem", "mfem", write_mfem},
                                  MeshFormat{"modflow-disu", "modflow-disu", write_modflow},
                                  MeshFormat{"openfoam", "openfoam", write_openfoam},
                                  MeshFormat{"pflotran", "pflotran", write_pflotran},
                                  MeshFormat{"tetgen", "tetgen", write_tetgen},
                                  MeshFormat{"tough2", "tough2", write_tough2}};

}  // namespace

std::span<const Format> formats() { return rows; }

std::span<const MeshFormat> mesh_formats() { return mesh_rows; }

}  // namespace geomend::meshes
