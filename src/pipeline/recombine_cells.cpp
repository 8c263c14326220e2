// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/recombine_cells.h"

#include <map>
#include <utility>

#include "base/wording.h"
#include "exchange/cell_mesh_of.h"
#include "exchange/split_mesh.h"
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

std::string percent(double part) { return rounded(100 * part) + " %"; }

}  // namespace

Result<VolumeMesh> recombine_cells(Dataset& dataset, const hexes::RecombineOptions& options, hexes::RecombineReport& report,
                                   std::vector<Loss>& losses) {
    auto mesh = volume_mesh_in(dataset, losses);
    if (!mesh) return std::move(mesh).why();
    if (!(*mesh)->vertex_origins.empty() || !(*mesh)->split_pairs.empty()) {
        mesh = exchange::joined(*mesh, losses);
        if (!mesh) return std::move(mesh).why();
    }
    auto made = hexes::recombine(*mesh, options, report);
    if (!made) return std::move(made).why();
    dataset.objects.clear();
    dataset.models.clear();
    dataset.breps.clear();
    dataset.findings.clear();
    dataset.objects.emplace_back(exchange::cell_mesh_of(*made));
    return made;
}

Json recombined_json(const hexes::RecombineReport& report) {
    const hexes::ThinCounts& t = report.thin;
    Json thin{{"triangles", t.triangles}, {"prisms", t.prisms},       {"pyramids", t.pyramids},   {"tetrahedra", t.tetrahedra},
              {"ignored", t.ignored},     {"undefined", t.undefined}, {"unmatched", t.unmatched}, {"invalid", t.invalid}};
    Json all{{"tetrahedra", report.tetrahedra}, {"candidates", report.candidates},     {"selected", report.selected},
             {"quads", report.closing.quads},   {"absorbed", report.closing.absorbed}, {"pyramids", report.closing.pyramids},
             {"opened", report.closing.opened}, {"split", report.closing.split},       {"moves", report.moves},
             {"folded", report.folded}};
    if (t.triangles > 0) all["thin"] = std::move(thin);
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
    std::string text = "of " + counted(report.tetrahedra, "tetrahedron", "tetrahedra") + ":\n";
    for (const CellType type : mixed_types) {
        const std::uint64_t count = report.count_of(type);
        if (count > 0)
            text += "  " + counted(count, type == CellType::wedge ? "prism" : to_string(type), plural(type)) + ", " +
                    percent(report.volume_share_of(type)) + " of the volume\n";
    }
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
