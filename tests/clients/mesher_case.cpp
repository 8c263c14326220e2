// SPDX-License-Identifier: AGPL-3.0-or-later
#include "clients/mesher_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "geometry/cell_volume.h"
#include "pipeline/convert.h"
#include "pipeline/load.h"
#include "support/temporary_folder.h"

namespace geomend::test {

namespace {

std::vector<double> ascending(const std::map<std::int64_t, double>& volumes) {
    std::vector<double> all;
    for (const auto& [region, volume] : volumes) all.push_back(volume);
    std::ranges::sort(all);
    return all;
}

void write_poly(const BrepData& brep, const std::filesystem::path& file) {
    std::ofstream out(file);
    out.precision(17);
    out << brep.vertices.size() << " 3 0 0\n";
    for (std::size_t v = 0; v < brep.vertices.size(); ++v)
        out << v << ' ' << brep.vertices[v][0] << ' ' << brep.vertices[v][1] << ' ' << brep.vertices[v][2] << '\n';
    std::size_t facets = 0;
    for (const auto& surface : brep.surfaces) facets += surface.polygons.size();
    out << facets << " 1\n";
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            out << "1 0 " << s + 1 << '\n' << surface.polygons[p].size();
            for (const std::uint32_t node : surface.polygons[p]) out << ' ' << surface.nodes[node].value;
            out << '\n';
        }
    }
    out << "0\n0\n";
}

/// A TetGen file: its head line, then its rows, all numbers; comments left out.
std::vector<std::vector<double>> rows_of(const std::filesystem::path& file) {
    std::vector<std::vector<double>> rows;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::vector<double> row;
        for (double x = 0; words >> x;) row.push_back(x);
        if (!row.empty()) rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

bool has_tetgen() { return std::system("command -v tetgen >/dev/null 2>&1") == 0; }
bool has_gmsh() { return std::system("command -v gmsh >/dev/null 2>&1") == 0; }

Meshed mesh_with_tetgen(const BrepData& brep) {
    const TemporaryFolder folder;
    write_poly(brep, folder / "model.poly");
    const std::string command = "cd '" + folder.path().string() + "' && timeout 60 tetgen -pA model.poly > log 2>&1";
    Meshed meshed;
    const bool ended_well = std::system(command.c_str()) == 0;
    meshed.log = read_file(folder / "log");
    const auto points = rows_of(folder / "model.1.node"), cells = rows_of(folder / "model.1.ele");
    if (!ended_well || points.size() < 2 || cells.size() < 2) return meshed;
    std::vector<Vec3> position(points.size() - 1);
    for (std::size_t i = 1; i < points.size(); ++i)
        position[static_cast<std::size_t>(points[i][0])] = {points[i][1], points[i][2], points[i][3]};
    std::map<std::int64_t, double> volumes;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        const auto at = [&](std::size_t k) { return position[static_cast<std::size_t>(cells[i][k + 1])]; };
        volumes[static_cast<std::int64_t>(cells[i].back())] += std::abs(tetrahedron_volume(at(0), at(1), at(2), at(3)));
    }
    meshed.volumes = ascending(volumes);
    meshed.done = true;
    return meshed;
}

Meshed mesh_with_gmsh(const std::string& model_file) {
    const TemporaryFolder folder;
    ConvertRequest request;
    request.inputs = {model_file};
    request.output = (folder / "model.geo").string();
    const auto converted = convert(request);
    Meshed meshed;
    if (!converted) {
        meshed.log = converted.why().error.message;
        return meshed;
    }
    const std::string command = "cd '" + folder.path().string() +
                                "' && timeout 60 gmsh model.geo -3 -format msh41 -setnumber Mesh.SaveAll 1 -o made.msh > log 2>&1";
    const bool ended_well = std::system(command.c_str()) == 0;
    meshed.log = read_file(folder / "log");
    if (!ended_well || meshed.log.find("Error") != std::string::npos) return meshed;
    const auto dataset = load((folder / "made.msh").string(), {});
    if (!dataset) return meshed;
    std::map<std::int64_t, double> volumes;
    for (const Object& object : dataset->objects) {
        const auto* mesh = std::get_if<CellMesh>(&object);
        for (std::size_t cell = 0; mesh != nullptr && cell < mesh->cell_count(); ++cell) {
            const auto n = mesh->cell_nodes(cell);
            if (mesh->types[cell] != CellType::tetrahedron) continue;
            const auto at = [&](std::size_t k) { return mesh->points[n[k]]; };
            volumes[mesh->cell_entity.at(cell)] += std::abs(tetrahedron_volume(at(0), at(1), at(2), at(3)));
        }
    }
    meshed.volumes = ascending(volumes);
    meshed.done = !volumes.empty();
    return meshed;
}

std::vector<double> region_volumes(const BrepData& brep) {
    std::vector<double> volumes;
    for (const auto& region : brep.regions) volumes.push_back(region.volume);
    std::ranges::sort(volumes);
    return volumes;
}

}  // namespace geomend::test
