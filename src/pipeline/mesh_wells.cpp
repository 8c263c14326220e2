// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh_wells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "base/length.h"
#include "base/nearest_word.h"
#include "base/own_name.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "formats/mesh_format.h"
#include "formats/registry.h"
#include "model/attribute_operations.h"

namespace geomend {

namespace {

bool is_line(const Object& object) { return std::holds_alternative<Well>(object) || std::holds_alternative<PolylineSet>(object); }

/// The lines of a name.
std::vector<std::uint32_t> lines_called(const Dataset& dataset, std::string_view name) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        if (is_line(dataset.objects[o]) && info_of(dataset.objects[o]).name == name) all.push_back(o);
    }
    return all;
}

/// The pieces of a set of polylines, each as far as one edge goes on from another.
std::vector<std::vector<Vec3>> pieces_of(const PolylineSet& lines) {
    std::vector<std::vector<Vec3>> all;
    std::uint32_t last = no_index;
    for (const auto& edge : lines.edges) {
        if (edge[0] != last || all.empty()) all.push_back({lines.points[edge[0]]});
        all.back().push_back(lines.points[edge[1]]);
        last = edge[1];
    }
    return all;
}

/// Whether measured depths are the way along the path, which edges say as well.
bool are_lengths(const Well& well) {
    double way = 0;
    for (std::size_t i = 1; i < well.path.size() && i < well.measured_depth.size(); ++i) {
        way += length(minus(well.path[i], well.path[i - 1]));
        if (!(std::abs(well.measured_depth[i] - well.measured_depth[0] - way) <= 1e-3 * way)) return false;
    }
    return true;
}

}  // namespace

Result<std::vector<std::uint32_t>> chosen_wells(const Dataset& dataset, const std::string& which) {
    std::vector<std::uint32_t> chosen;
    if (which == "none") return chosen;
    if (which == "all") {
        for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
            if (std::holds_alternative<Well>(dataset.objects[o])) chosen.push_back(o);
        }
        return chosen;
    }
    std::string_view names = which;
    while (!names.empty()) {  // a name may have commas itself: the longest one that is there counts
        std::size_t end = names.size();
        std::vector<std::uint32_t> found = lines_called(dataset, names);
        while (found.empty()) {
            end = end > 0 ? names.rfind(',', end - 1) : std::string_view::npos;
            if (end == std::string_view::npos || end == 0) break;
            found = lines_called(dataset, names.substr(0, end));
        }
        if (found.empty()) {
            const std::string_view name = names.substr(0, names.find(','));
            std::vector<std::string_view> known;
            for (const Object& object : dataset.objects) {
                if (is_line(object)) known.push_back(info_of(object).name);
            }
            return failure(FailureKind::usage, "F018", {},
                           "--wells: no well or line is called " + geomend::quoted(name) + nearest_hint(name, known));
        }
        chosen.insert(chosen.end(), found.begin(), found.end());
        names.remove_prefix(std::min(end + 1, names.size()));
    }
    std::ranges::sort(chosen);
    const auto repeats = std::ranges::unique(chosen);
    chosen.erase(repeats.begin(), repeats.end());
    return chosen;
}

std::vector<volumes::WellPath> paths_of(const Dataset& dataset, std::span<const std::uint32_t> chosen, std::vector<Loss>& losses) {
    std::vector<volumes::WellPath> paths;
    std::set<std::string> names;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Object& object = dataset.objects[chosen[i]];
        const std::string stated = info_of(object).name.empty() ? "well " + std::to_string(i + 1) : info_of(object).name;
        const std::string name = own_name(stated, names);
        if (name != stated)
            add_loss(losses,
                     {LossClass::identity, stated, "name", "another well has it: its edges are called " + geomend::quoted(name), 1});
        if (const auto* well = std::get_if<Well>(&object)) paths.push_back({name, well->path});
        if (const auto* lines = std::get_if<PolylineSet>(&object)) {
            for (auto& piece : pieces_of(*lines)) paths.push_back({name, std::move(piece)});
        }
    }
    return paths;
}

bool has_edges(const Format& target) { return target.flat_meshes || mesh_format(target) != nullptr; }

void add_wells(CellMesh& mesh, std::span<const volumes::WellChain> chains) {
    std::map<std::string_view, std::uint32_t> entity_of;
    std::set<std::pair<std::uint32_t, std::array<std::uint32_t, 2>>> taken;
    std::int64_t tag = 0, group_tag = 0;
    for (const auto& e : mesh.entities) tag = e.dimension == 1 ? std::max(tag, e.tag) : tag;
    for (const auto& g : mesh.groups) group_tag = g.dimension == 1 ? std::max(group_tag, g.tag) : group_tag;
    for (const auto& chain : chains) {
        if (chain.edges.empty()) continue;
        const auto [found, is_new] = entity_of.emplace(chain.name, static_cast<std::uint32_t>(mesh.entities.size()));
        if (is_new) {
            CellMesh::Entity entity;
            entity.dimension = 1;
            entity.tag = ++tag;
            entity.name = chain.name;
            entity.groups.push_back(static_cast<std::uint32_t>(mesh.groups.size()));
            mesh.groups.push_back({1, ++group_tag, chain.name});
            mesh.entities.push_back(std::move(entity));
        }
        for (const auto& edge : chain.edges) {
            if (!taken.insert({found->second, {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}}).second) continue;
            mesh.add_cell(CellType::line, edge);
            mesh.cell_entity.push_back(found->second);
        }
    }
    for (Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::cell) resize_with_missing(a, mesh.cell_count());
    }
}

void list_well_losses(const Object& object, std::vector<Loss>& losses) {
    const std::string& name = info_of(object).name;
    const auto lose = [&](std::size_t count, const char* what, LossClass loss = LossClass::substance) {
        if (count > 0) add_loss(losses, {loss, name, what, "a mesh has the way of a well as edges, and nothing else of it", count});
    };
    lose(info_of(object).attributes.size(), "attributes");
    const auto* well = std::get_if<Well>(&object);
    if (well == nullptr) return;
    lose(well->markers.size(), "markers");
    lose(well->zones.size(), "zones");
    lose(well->curves.size(), "logs");
    lose(well->measured_depth.empty() ? 0 : 1, "measured depths", are_lengths(*well) ? LossClass::identity : LossClass::substance);
}

std::vector<MeshWell> mesh_wells(std::span<const volumes::WellChain> chains) {
    std::vector<MeshWell> wells;
    for (const auto& chain : chains) {
        auto well = std::ranges::find(wells, chain.name, &MeshWell::name);
        if (well == wells.end()) well = wells.insert(wells.end(), MeshWell{chain.name});
        well->length += chain.length;
        well->inside += chain.inside;
        well->repeated += chain.repeated;
        well->edges += chain.edges.size();
        well->on_surfaces += chain.on_surfaces;
        well->crossings += chain.crossings;
    }
    return wells;
}

std::string wells_text(std::span<const MeshWell> wells) {
    std::string text;
    for (const MeshWell& well : wells) {
        text += "  well " + geomend::quoted(well.name) + ": ";
        const double outside = well.length - well.inside - well.repeated;
        if (!(well.length > 0)) {
            text += "its path has no length: there are no edges for it\n";
            continue;
        }
        if (well.edges == 0) {
            text += "no part of it lies in the model: there are no edges for it\n";
            continue;
        }
        text += counted(well.edges, "edge", "edges") + ", length " + short_number(well.inside);
        if (well.on_surfaces > 0) text += ", " + counted(well.on_surfaces, "edge", "edges") + " on surfaces";
        if (well.repeated > 0) text += "; " + short_number(well.repeated) + " of its path runs along edges that it has already";
        if (outside > 1e-6 * well.length) text += "; " + short_number(outside) + " of its path lies outside of the model, and is left out";
        text += '\n';
    }
    return text;
}

}  // namespace geomend
