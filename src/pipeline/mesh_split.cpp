// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh_split.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/nearest_word.h"
#include "base/wording.h"
#include "exchange/cell_mesh_of.h"
#include "exchange/split_mesh.h"
#include "pipeline/mesh_output.h"

namespace geomend {

namespace {

/// Chooses the surfaces of a name: that of the surface, or that of its set without the side. False where there are none.
bool choose(const VolumeMesh& mesh, std::string_view name, std::vector<std::uint8_t>& chosen) {
    bool found = false;
    for (std::size_t s = 0; s < mesh->surfaces.size(); ++s) {
        if (mesh->surfaces[s] != name) continue;
        chosen[s] = 1;
        found = true;
    }
    for (const auto& set : mesh->face_sets) {
        const bool is_side = set.name.starts_with(name) && (set.name.size() == name.size() || set.name[name.size()] == '_');
        if (set.surface == no_index || !is_side || set.side == FaceSide::none) continue;
        std::string side = to_string(set.side);
        std::ranges::replace(side, ' ', '_');
        if (set.name != std::string(name) + "_" + side) continue;
        chosen[set.surface] = 1;
        found = true;
    }
    return found;
}

/// Surfaces of the mesh by names between commas. A name may have commas itself: the longest one that is there counts.
Result<std::vector<std::uint8_t>> named_surfaces(const VolumeMesh& mesh, std::string_view names) {
    std::vector<std::uint8_t> chosen(mesh->surfaces.size(), 0);
    while (!names.empty()) {
        std::size_t end = names.size();
        while (end != std::string_view::npos && end > 0 && !choose(mesh, names.substr(0, end), chosen)) end = names.rfind(',', end - 1);
        if (end == std::string_view::npos || end == 0) {
            const std::string_view name = names.substr(0, names.find(','));
            const std::vector<std::string_view> known(mesh->surfaces.begin(), mesh->surfaces.end());
            return failure(FailureKind::usage, "F018", {},
                           "--split: no surface is called " + geomend::quoted(name) + nearest_hint(name, known));
        }
        names.remove_prefix(std::min(end + 1, names.size()));
    }
    return chosen;
}

Result<std::vector<std::uint8_t>> chosen_surfaces(const VolumeMesh& mesh, const std::string& which) {
    if (which == "faults") return exchange::faults_of(mesh);
    if (which == "all") return std::vector<std::uint8_t>(mesh->surfaces.size(), 1);
    return named_surfaces(mesh, which);
}

}  // namespace

Result<SplitReport> split_mesh(Dataset& dataset, const std::string& which, std::vector<Loss>& losses) {
    SplitReport report;
    if (which.empty() || which == "none") return report;
    auto mesh = volume_mesh_in(dataset, losses);
    if (!mesh) return std::move(mesh).why();
    auto chosen = chosen_surfaces(*mesh, which);
    if (!chosen) return std::move(chosen).why();
    auto split = exchange::split_along(*mesh, *chosen);
    if (!split) return std::move(split).why();
    report.surfaces = static_cast<std::uint64_t>(std::ranges::count(*chosen, 1));
    report.vertices = (*split)->vertices.size() - (*mesh)->vertices.size();
    report.pairs = (*split)->split_pairs.size() - (*mesh)->split_pairs.size();
    dataset.objects.clear();
    dataset.models.clear();
    dataset.breps.clear();
    dataset.objects.emplace_back(exchange::cell_mesh_of(*split));
    return report;
}

}  // namespace geomend
