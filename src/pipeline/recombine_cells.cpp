// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/recombine_cells.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "base/wording.h"
#include "exchange/cell_mesh_of.h"
#include "exchange/kept_cells.h"
#include "exchange/split_mesh.h"
#include "formats/vtk/cell_check.h"
#include "model/attribute_operations.h"
#include "pipeline/mesh_output.h"

namespace geomend {

namespace {

constexpr std::array mixed_types{CellType::hexahedron, CellType::wedge, CellType::pyramid, CellType::tetrahedron};

const char* plural(CellType type) {
    switch (type) {
        case CellType::hexahedron:
            return "hexahedra";
        case CellType::wedge:
            return "prisms";
        case CellType::pyramid:
            return "pyramids";
        default:
            return "tetrahedra";
    }
}

/// Lines and points without names, which a volume mesh would not keep, get some of their own.
std::vector<std::string> name_lines_and_points(Dataset& dataset) {
    std::set<std::string> known;
    for (Object& object : dataset.objects) {
        if (const auto* mesh = std::get_if<CellMesh>(&object)) {
            for (const auto& e : mesh->entities) known.insert(e.name);
            for (const auto& g : mesh->groups) known.insert(g.name);
        }
    }
    std::vector<std::string> made;
    for (Object& object : dataset.objects) {
        auto* mesh = std::get_if<CellMesh>(&object);
        if (mesh == nullptr) continue;
        for (std::size_t e = 0; e < mesh->entities.size(); ++e) {
            auto& entity = mesh->entities[e];
            const bool is_named =
                !entity.name.empty() || std::ranges::any_of(entity.groups, [&](auto g) { return !mesh->groups[g].name.empty(); });
            if (entity.dimension > 1 || is_named) continue;
            std::string name = (entity.dimension == 1 ? "line " : "corner ") + std::to_string(made.size() + 1);
            while (!known.insert(name).second) name += '_';
            entity.name = name;
            made.push_back(std::move(name));
        }
    }
    return made;
}

/// Takes these names away again: lines stay without, and sets of nodes become points of the mesh once more.
void forget_names(CellMesh& mesh, const std::vector<std::string>& made) {
    const std::set<std::string> names(made.begin(), made.end());
    for (auto& entity : mesh.entities) {
        if (entity.dimension == 1 && names.contains(entity.name)) entity.name.clear();
    }
    for (const NamedSet& set : mesh.info.sets) {
        if (set.location != AttributeLocation::point || !names.contains(set.name)) continue;
        CellMesh::Entity entity;
        entity.dimension = 0;
        entity.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
        mesh.entities.push_back(std::move(entity));
        for (const std::uint32_t node : set.members) {
            mesh.add_cell(CellType::vertex, std::array{node});
            mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
        }
    }
    std::erase_if(mesh.info.sets, [&](const NamedSet& set) { return names.contains(set.name); });
    for (Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::cell) resize_with_missing(a, mesh.cell_count());
    }
}

/// Where there are no cells at all the reason is told as that of this command.
Failure why_not_recombined(Failure why) {
    if (std::ranges::find(why.error.measures, "without_cells", [](const auto& m) { return m.first; }) == why.error.measures.end())
        return why;
    why.error.message = "there are no cells: --recombine makes hexahedra of the tetrahedra of a mesh";
    why.error.measures = {{"no_tetrahedra", 1}};
    return why;
}

/// The same mesh with the corners of its cells alone, where it has cells of the second order: hexahedra are made of straight tetrahedra.
Result<VolumeMesh> with_corners_only(VolumeMesh mesh, std::vector<Loss>& losses) {
    bool is_second = false;
    for (const auto& block : mesh->blocks) {
        if (!is_second_order(block.type)) continue;
        is_second = true;
        add_loss(losses, {LossClass::substance, mesh->regions[block.region], "nodes on edges",
                          "--recombine takes the corners of cells of the second order", block.count});
    }
    if (!is_second) return mesh;
    return VolumeMesh::make(exchange::kept_cells(*mesh, std::vector<std::uint8_t>(mesh->cell_count(), 1), exchange::KeptNodes::corners));
}

std::string percent(double part) { return rounded(100 * part) + " %"; }

}  // namespace

Result<VolumeMesh> recombine_cells(Dataset& dataset, const hexes::RecombineOptions& options, hexes::RecombineReport& report,
                                   std::vector<Loss>& losses) {
    const std::vector<std::string> names = name_lines_and_points(dataset);
    auto mesh = volume_mesh_in(dataset, losses);
    if (!mesh) return why_not_recombined(std::move(mesh).why());
    mesh = with_corners_only(*std::move(mesh), losses);
    if (!mesh) return std::move(mesh).why();
    if (!(*mesh)->vertex_origins.empty() || !(*mesh)->split_pairs.empty()) {
        mesh = exchange::joined(*mesh, losses);
        if (!mesh) return std::move(mesh).why();
    }
    hexes::RecombineOptions checked = options;
    if (options.thin_only) checked.check = vtk_finds_valid;
    auto made = hexes::recombine(*mesh, checked, report);
    if (!made) return std::move(made).why();
    dataset.objects.clear();
    dataset.models.clear();
    dataset.breps.clear();
    dataset.findings.clear();
    CellMesh cells = exchange::cell_mesh_of(*made);
    forget_names(cells, names);
    dataset.objects.emplace_back(std::move(cells));
    return made;
}

Json recombined_json(const hexes::RecombineReport& report) {
    const hexes::ThinCounts& t = report.thin;
    Json thin{{"triangles", t.triangles}, {"prisms", t.prisms},       {"pyramids", t.pyramids},   {"tetrahedra", t.tetrahedra},
              {"ignored", t.ignored},     {"undefined", t.undefined}, {"unmatched", t.unmatched}, {"invalid", t.invalid}};
    Json all{
        {"tetrahedra", report.tetrahedra},
        {"candidates", report.candidates},
        {"selected", report.selected},
        {"first_share", report.first_share},
        {"quads", report.closing.quads},
        {"absorbed", report.closing.absorbed},
        {"pyramids", report.closing.pyramids},
        {"opened", report.closing.opened},
        {"split", report.closing.split},
        {"moves", report.moves},
        {"folded", report.folded},
        {"not_taken", report.not_taken},
        {"leftovers", {{"flips", report.leftovers.flips}, {"new_vertices", report.leftovers.placed}, {"flat", report.leftovers.flat}}}};
    if (t.triangles > 0) all["thin"] = std::move(thin);
    Json made = Json::object(), there = Json::object();
    for (const CellType type : mixed_types) {
        const auto put = [type](Json& to, const hexes::RecombineReport::Part& part) {
            if (part.count > 0) to[to_string(type)] = {{"number", part.count}, {"volume_share", part.share}};
        };
        put(made, report.made_of(type));
        put(there, report.there_of(type));
    }
    all["made"] = std::move(made);
    all["there"] = std::move(there);
    return all;
}

Json shares_json(const hexes::RecombineReport& report) {
    Json shares = Json::object();
    const double all = static_cast<double>(report.cell_count());
    for (const CellType type : mixed_types) {
        const auto count = static_cast<double>(report.count_of(type));
        shares[to_string(type)] = {{"volume", report.volume_share_of(type)}, {"number", all > 0 ? count / all : 0}};
    }
    return shares;
}

std::string recombined_text(const hexes::RecombineReport& report) {
    const auto line = [](CellType type, const hexes::RecombineReport::Part& part, const char* of) {
        if (part.count == 0) return std::string();
        return "  " + counted(part.count, type == CellType::wedge ? "prism" : to_string(type), plural(type)) + ", " + percent(part.share) +
               of;
    };
    std::string there;
    for (const CellType type : mixed_types) there += line(type, report.there_of(type), " of the whole volume\n");
    std::string text = "of " + counted(report.tetrahedra, "tetrahedron", "tetrahedra") + ":\n";
    for (const CellType type : mixed_types)
        text += line(type, report.made_of(type), there.empty() ? " of the volume\n" : " of their volume\n");
    if (!there.empty()) text += "beside them, as they were:\n" + there;
    if (report.count_of(CellType::hexahedron) > 0)
        text += "  least scaled Jacobian of a hexahedron " + rounded(report.least_jacobian) + '\n';
    const hexes::ThinCounts& t = report.thin;
    if (t.triangles > 0)
        text += "  thin parts: of " + counted(t.triangles, "side", "sides") + " of triangles " + std::to_string(t.prisms) +
                " are of prisms, " + std::to_string(t.pyramids) + " of pyramids, " + std::to_string(t.tetrahedra) +
                " of tetrahedra; filled by tetrahedra: " + std::to_string(t.undefined) + " without counterpart, " +
                std::to_string(t.unmatched) + " not matched, " + std::to_string(t.invalid) + " invalid\n";
    return text;
}

}  // namespace geomend
