// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/write_geo.h"

#include <map>

#include "formats/gmsh/write_msh.h"
#include "formats/gmsh/writing.h"

namespace geomend::gmsh {

namespace {

/// NAME.msh for NAME.geo, without the folder.
std::string listed(const std::vector<std::int64_t>& tags) {
    std::string text;
    for (const std::int64_t tag : tags) text += (text.empty() ? "" : ", ") + std::to_string(tag);
    return text;
}

// A surface that bounds the volume with both sides lies inside of it.
void write_volume(const CellMesh::Entity& volume, OutputFile& out) {
    std::map<std::int64_t, int> uses;
    for (const std::int64_t tag : volume.boundary) ++uses[tag < 0 ? -tag : tag];
    std::vector<std::int64_t> around, inside;
    for (const auto& [tag, count] : uses) (count == 1 ? around : inside).push_back(tag);
    const std::string number = std::to_string(volume.tag);
    out << "Surface Loop(" << number << ") = {" << listed(around) << "};\nVolume(" << number << ") = {" << number << "};\n";
    if (!inside.empty()) out << "Surface{" << listed(inside) << "} In Volume{" << number << "};\n";
}

void write_groups(const HollowVolumes& hollow, OutputFile& out) {
    std::map<std::uint32_t, std::vector<std::int64_t>> volumes_of;
    for (const CellMesh::Entity& volume : hollow.volumes) {
        for (const std::uint32_t group : volume.groups) volumes_of[group].push_back(volume.tag);
    }
    for (const auto& [index, volumes] : volumes_of) {
        const CellMesh::Group& group = hollow.groups[index];
        const std::string tag = std::to_string(group.tag);
        out << "Physical Volume(" << (group.name.empty() ? tag : '"' + quotable(group.name) + "\", " + tag) << ") = {" << listed(volumes)
            << "};\n";
    }
}

}  // namespace

Result<std::vector<Loss>> write_geo(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options) {
    if (outputs.is_stream()) {
        return failure(FailureKind::usage, "F018", {outputs.main_path().string()},
                       "a Gmsh script goes with a mesh file beside it: name an output file, or write msh");
    }
    const std::string mesh = outputs.stem() + ".msh";
    HollowVolumes hollow;
    auto losses = write_mesh_file(dataset, outputs.companion(mesh), outputs.main_path().parent_path() / mesh, options, &hollow);
    if (!losses) return losses;
    OutputFile& out = outputs.main_file();
    out << "Merge \"" << quotable(mesh) << "\";\n";
    for (const CellMesh::Entity& volume : hollow.volumes) write_volume(volume, out);
    write_groups(hollow, out);
    return losses;
}

}  // namespace geomend::gmsh
