// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/meshes.h"

#include <array>

#include "formats/meshes/write_abaqus.h"
#include "formats/meshes/write_medit.h"
#include "formats/meshes/write_tetgen.h"

namespace geomend::meshes {

namespace {

constexpr std::string_view medit_extensions[] = {".mesh"}, tetgen_extensions[] = {".node", ".ele"}, abaqus_extensions[] = {".inp"};
constexpr std::string_view tried = "fixtures and clients: no real file was found";

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
    return format;
}

constexpr Format tetgen_row() {
    Format format = row("tetgen", "TetGen: tetrahedra with numbers of regions and faces, in .node, .ele and .face", tetgen_extensions,
                        "substance: other cells, edge and node sets, texts, attributes of cells, points, grids, wells; identity: names, "
                        "sides, units, coordinate system");
    format.keeps.attributes = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::yes;
    return format;
}

constexpr Format abaqus_row() {
    Format format = row("abaqus", "Abaqus and CalculiX: elements, and sets of elements, faces and nodes", abaqus_extensions,
                        "substance: pyramids, polyhedra, attributes, points, grids, wells; identity: edges (their nodes are kept), names "
                        "that are no words, roles, digits beyond 20 characters, units, coordinate system");
    format.keeps.fault_faces = Keeping::yes;
    format.keeps.names = Keeping::partly;
    format.keeps.exact_coordinates = Keeping::partly;
    return format;
}

constexpr std::array rows = {abaqus_row(), medit_row(), tetgen_row()};
constexpr std::array mesh_rows = {MeshFormat{"abaqus", "abaqus", write_abaqus}, MeshFormat{"medit", "medit", write_medit},
                                  MeshFormat{"tetgen", "tetgen", write_tetgen}};

}  // namespace

std::span<const Format> formats() { return rows; }

std::span<const MeshFormat> mesh_formats() { return mesh_rows; }

}  // namespace geomend::meshes
