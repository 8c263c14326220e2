// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_openfoam.h"

#include <algorithm>
#include <map>

#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

constexpr const char* folder = "constant/polyMesh/";

/// A file of the mesh with its head.
OutputFile& begin(OutputSet& out, const char* object, const char* kind) {
    OutputFile& file = out.companion(std::string(folder) + object);
    file << "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " << kind << ";\n    location \"constant/polyMesh\";\n    object "
         << object << ";\n}\n\n";
    return file;
}

/// A list of the format: its size, then its members in brackets, one a line.
template <class Write>
void write_list(OutputFile& file, std::uint64_t size, const Write& write) {
    file.number(size) << "\n(\n";
    for (std::uint64_t i = 0; i < size && file.good(); ++i) {
        write(i);
        file << '\n';
    }
    file << ")\n";
}

struct Patch {
    std::string name;
    std::vector<CellFaceRef> faces;
};

/// Faces of one cell alone by the first set that has them; the rest is the patch "border".
std::vector<Patch> patches_of(const VolumeMesh& mesh) {
    const std::vector<CellFaceRef> inner = shared_faces(mesh->network);
    std::vector<CellFaceRef> border;
    for (std::uint32_t c = 0; c < mesh->cell_count(); ++c) {
        for (std::uint32_t f = 0; f < mesh.face_count(c); ++f) {
            if (!std::ranges::binary_search(inner, CellFaceRef{c, f})) border.push_back({c, f});
        }
    }
    std::vector<std::uint8_t> is_taken(border.size(), 0);
    std::vector<Patch> patches;
    for (const auto& set : mesh->face_sets) {
        Patch patch{set.name, {}};
        for (const CellFaceRef& face : set.faces) {
            const auto at = std::ranges::lower_bound(border, face);
            if (at == border.end() || *at != face || is_taken[static_cast<std::size_t>(at - border.begin())] != 0) continue;
            is_taken[static_cast<std::size_t>(at - border.begin())] = 1;
            patch.faces.push_back(face);
        }
        if (!patch.faces.empty()) patches.push_back(std::move(patch));
    }
    Patch rest{"border", {}};
    while (std::ranges::find(patches, rest.name, &Patch::name) != patches.end()) rest.name += "_";
    for (std::size_t i = 0; i < border.size(); ++i) {
        if (is_taken[i] == 0) rest.faces.push_back(border[i]);
    }
    if (!rest.faces.empty()) patches.push_back(std::move(rest));
    return patches;
}

void write_boundary(OutputSet& out, std::span<const Patch> patches, std::uint64_t first) {
    OutputFile& file = begin(out, "boundary", "polyBoundaryMesh");
    write_list(file, patches.size(), [&](std::uint64_t i) {
        file << "    " << patches[i].name << "\n    {\n        type patch;\n        nFaces ";
        file.number(static_cast<std::uint64_t>(patches[i].faces.size())) << ";\n        startFace ";
        file.number(first) << ";\n    }";
        first += patches[i].faces.size();
    });
}

void write_labels(OutputFile& file, const char* key, std::span<const std::uint32_t> labels) {
    file << "    " << key << " List<label>\n";
    write_list(file, labels.size(), [&](std::uint64_t i) { file.number(labels[i]); });
    file << "    ;\n";
}

void write_cell_zones(OutputSet& out, const VolumeMesh& mesh) {
    OutputFile& file = begin(out, "cellZones", "regIOobject");
    write_list(file, mesh->regions.size(), [&](std::uint64_t r) {
        std::vector<std::uint32_t> cells;
        for (const VolumeMeshData::Block& block : mesh->blocks) {
            for (std::uint32_t c = block.first; block.region == r && c < block.first + block.count; ++c) cells.push_back(c);
        }
        file << mesh->regions[r] << "\n{\n    type cellZone;\n";
        write_labels(file, "cellLabels", cells);
        file << "}";
    });
}

/// Sets of faces inside: their numbers, and which of them look from their neighbour to their owner.
void write_face_zones(OutputSet& out, const VolumeMesh& mesh) {
    std::map<CellFaceRef, std::pair<std::uint32_t, bool>> number;
    for (std::uint32_t i = 0; i < mesh->network.connections.size(); ++i) {
        const auto& c = mesh->network.connections[i];
        number[{c.from, c.from_face}] = {i, false};
        number[{c.to, c.to_face}] = {i, true};
    }
    struct Zone {
        const std::string* name;
        std::vector<std::pair<std::uint32_t, bool>> faces;
    };
    std::vector<Zone> zones;
    std::vector<std::uint8_t> is_in_zone(mesh->network.connections.size(), 0);
    for (const auto& set : mesh->face_sets) {
        Zone zone{&set.name, {}};
        for (const CellFaceRef& face : set.faces) {
            const auto at = number.find(face);
            if (at == number.end() || is_in_zone[at->second.first] != 0) continue;  // the other side of a surface is the same faces
            is_in_zone[at->second.first] = 1;
            zone.faces.push_back(at->second);
        }
        std::ranges::sort(zone.faces);
        if (!zone.faces.empty()) zones.push_back(std::move(zone));
    }
    OutputFile& file = begin(out, "faceZones", "regIOobject");
    write_list(file, zones.size(), [&](std::uint64_t z) {
        std::vector<std::uint32_t> labels;
        for (const auto& [label, turned] : zones[z].faces) labels.push_back(label);
        file << *zones[z].name << "\n{\n    type faceZone;\n";
        write_labels(file, "faceLabels", labels);
        file << "    flipMap List<bool>\n";
        write_list(file, labels.size(), [&](std::uint64_t i) { file << (zones[z].faces[i].second ? "1" : "0"); });
        file << "    ;\n}";
    });
}

void write_point_zones(OutputSet& out, const VolumeMesh& mesh) {
    OutputFile& file = begin(out, "pointZones", "regIOobject");
    write_list(file, mesh->node_sets.size(), [&](std::uint64_t s) {
        file << mesh->node_sets[s].name << "\n{\n    type pointZone;\n";
        write_labels(file, "pointLabels", mesh->node_sets[s].nodes);
        file << "}";
    });
}

void write_face(OutputFile& file, const std::vector<std::uint32_t>& nodes) {
    file.number(static_cast<std::uint64_t>(nodes.size())) << '(';
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (k > 0) file << ' ';
        file.number(nodes[k]);
    }
    file << ')';
}

}  // namespace

Result<std::vector<Loss>> write_openfoam(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (out.is_stream())
        return failure(FailureKind::usage, "F018", {out.main_path().string()},
                       "a mesh of OpenFOAM is a folder with several files: name an output file beside it, such as case.foam");
    const auto& connections = mesh->network.connections;
    out.main_file();
    OutputFile& points = begin(out, "points", "vectorField");
    write_list(points, mesh->vertices.size(), [&](std::uint64_t v) {
        const Vec3& p = mesh->vertices[v];
        points << '(';
        points.number(p[0]) << ' ';
        points.number(p[1]) << ' ';
        points.number(p[2]) << ')';
    });
    const std::vector<Patch> patches = patches_of(mesh);
    std::vector<CellFaceRef> faces;
    for (const auto& c : connections) faces.push_back({c.from, c.from_face});
    for (const Patch& patch : patches) faces.insert(faces.end(), patch.faces.begin(), patch.faces.end());
    OutputFile &face_file = begin(out, "faces", "faceList"), &owner = begin(out, "owner", "labelList"),
               &neighbour = begin(out, "neighbour", "labelList");
    write_list(face_file, faces.size(), [&](std::uint64_t i) { write_face(face_file, mesh.nodes_of(faces[i])); });
    write_list(owner, faces.size(), [&](std::uint64_t i) { owner.number(faces[i].cell); });
    write_list(neighbour, connections.size(), [&](std::uint64_t i) { neighbour.number(connections[i].to); });
    write_boundary(out, patches, connections.size());
    write_cell_zones(out, mesh);
    write_face_zones(out, mesh);
    write_point_zones(out, mesh);
    return common_losses(mesh, "OpenFOAM");
}

}  // namespace geomend::meshes
