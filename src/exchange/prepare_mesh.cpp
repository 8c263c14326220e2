// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/prepare_mesh.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "exchange/cell_network_of.h"
#include "exchange/inner_faces.h"
#include "exchange/kept_cells.h"
#include "exchange/split_mesh.h"
#include "exchange/target_names.h"

namespace geomend::exchange {

namespace {

using Data = VolumeMeshData;

Failure cannot_take(const MeshNeeds& needs, const std::string& why) {
    return failure(FailureKind::cannot_hold, "F021", {}, std::string(needs.target) + " " + why);
}

/// Split along the surfaces where the target wants that, or joined where it wants none.
Result<VolumeMesh> split_for(const VolumeMesh& mesh, const MeshNeeds& needs, std::vector<Loss>& losses) {
    switch (needs.splitting) {
        case Splitting::none:
            return joined(mesh, losses);
        case Splitting::on_faults:
            return split_along(mesh, faults_of(mesh));
        case Splitting::on_all_surfaces:
            return split_along(mesh, std::vector<std::uint8_t>(mesh->surfaces.size(), 1));
        case Splitting::as_given:
            break;
    }
    return mesh;
}

/// Cells and nodes that the target knows.
Data known_cells(const Data& mesh, const MeshNeeds& needs) {
    std::vector<std::uint8_t> kept(mesh.cell_count(), 0);
    for (const Data::Block& block : mesh.blocks) {
        const std::uint8_t known = (kind_of(block.type) & needs.cells) != 0 ? 1 : 0;
        std::fill_n(kept.begin() + block.first, block.count, known);
    }
    return kept_cells(mesh, kept, needs.order < 2 ? KeptNodes::corners : needs.middle_nodes ? KeptNodes::all : KeptNodes::on_edges);
}

template <class Members>
void append_sorted(Members& to, const Members& from) {
    to.insert(to.end(), from.begin(), from.end());
    std::ranges::sort(to);
    to.erase(std::ranges::unique(to).begin(), to.end());
}

/// The sets on the sides of a surface become one, under the name of the surface.
void join_sides(const std::vector<std::string>& surfaces, std::vector<Data::FaceSet>& sets) {
    std::map<std::uint32_t, std::size_t> of_surface;
    std::vector<Data::FaceSet> joined;
    for (Data::FaceSet& set : sets) {
        set.side = FaceSide::none;
        if (set.surface == no_index) {
            joined.push_back(std::move(set));
            continue;
        }
        const auto [at, is_new] = of_surface.emplace(set.surface, joined.size());
        if (is_new) {
            if (!surfaces[set.surface].empty()) set.name = surfaces[set.surface];
            joined.push_back(std::move(set));
        } else {
            append_sorted(joined[at->second].faces, set.faces);
        }
    }
    sets = std::move(joined);
}

/// Sets of one name become one.
template <class Set, class Join>
void join_names(std::vector<Set>& sets, const Join& join) {
    std::map<std::string, std::size_t> of_name;
    std::vector<Set> joined;
    for (Set& set : sets) {
        const auto [at, is_new] = of_name.emplace(set.name, joined.size());
        if (is_new) joined.push_back(std::move(set));
        else join(joined[at->second], set);
    }
    sets = std::move(joined);
}

void join_face_sets(Data::FaceSet& to, const Data::FaceSet& from) {
    append_sorted(to.faces, from.faces);
    if (to.surface != from.surface) to.surface = no_index;
    if (to.role != from.role) to.role = FeatureRole::unknown;
    if (to.side != from.side) to.side = FaceSide::none;
}

/// Leaves a face to the first set that has it, whichever of its cells names it, and lists what later sets lose.
void leave_faces_once(Data& mesh, const MeshNeeds& needs, std::vector<Loss>& losses) {
    std::map<std::vector<std::uint32_t>, std::size_t> owner;
    for (std::size_t s = 0; s < mesh.face_sets.size(); ++s) {
        Data::FaceSet& set = mesh.face_sets[s];
        std::uint64_t lost = 0;
        std::erase_if(set.faces, [&](const CellFaceRef& face) {
            auto nodes = nodes_of(mesh, face);
            std::ranges::sort(nodes);
            const auto [at, is_new] = owner.emplace(std::move(nodes), s);
            if (!is_new && at->second != s) ++lost;
            return !is_new;
        });
        if (lost > 0)
            add_loss(losses,
                     {LossClass::substance, set.name, "faces of a set", std::string(needs.target) + " has one number a face", lost});
    }
    std::erase_if(mesh.face_sets, [](const Data::FaceSet& set) { return set.faces.empty(); });
}

/// Sets that the target keeps, one of each name, and without sides where it has none.
void join_sets(Data& mesh, const MeshNeeds& needs) {
    if (!needs.face_sets) mesh.face_sets.clear();
    if (!needs.edge_sets) mesh.edge_sets.clear();
    if (!needs.node_sets) mesh.node_sets.clear();
    if (!needs.face_sides) join_sides(mesh.surfaces, mesh.face_sets);
    join_names(mesh.face_sets, join_face_sets);
    join_names(mesh.edge_sets,
               [](Data::EdgeSet& to, const Data::EdgeSet& from) { std::ranges::copy(from.edges, std::back_inserter(to.edges)); });
    join_names(mesh.node_sets, [](Data::NodeSet& to, const Data::NodeSet& from) { append_sorted(to.nodes, from.nodes); });
}

/// Names that the target can write, for each kind by itself.
void rename_all(Data& mesh, const MeshNeeds& needs, std::vector<Loss>& losses) {
    if (needs.names == Naming::numbers) return;
    const auto rename = [&](auto& things, const auto& name_of) {
        std::vector<std::string> names;
        for (auto& thing : things) names.push_back(name_of(thing));
        const auto found = target_names(names, needs.names, needs.longest_name);
        for (auto& thing : things) name_of(thing) = found.at(name_of(thing));
        for (const auto& [from, to] : found) {
            const bool shorter = needs.longest_name > 0 && from.size() > needs.longest_name;  // listed as such
            if (from != to && !shorter)
                add_loss(losses,
                         {LossClass::identity, from, "name", std::string(needs.target) + " cannot write it: it is called '" + to + "'", 1});
        }
    };
    rename(mesh.regions, [](std::string& region) -> std::string& { return region; });
    const auto of_set = [](auto& set) -> std::string& { return set.name; };
    rename(mesh.face_sets, of_set);
    rename(mesh.edge_sets, of_set);
    rename(mesh.node_sets, of_set);
}

void drop_attributes(Data& mesh, const MeshNeeds& needs) {
    std::erase_if(mesh.attributes, [&](const Attribute& a) {
        if (a.location == AttributeLocation::point) return !needs.point_values;
        return a.location != AttributeLocation::cell || !needs.cell_values;
    });
}

}  // namespace

Result<PreparedMesh> prepare(const VolumeMesh& mesh, const MeshNeeds& needs) {
    std::vector<Loss> lost = losses(mesh, needs);
    Data data = known_cells(*mesh, needs);
    if (data.blocks.empty()) return cannot_take(needs, "has no cell of the kinds of this mesh");
    if (needs.splitting != Splitting::as_given) {
        auto kept = VolumeMesh::make(std::move(data));
        if (!kept) return std::move(kept).why();
        auto split = split_for(*kept, needs, lost);
        if (!split) return std::move(split).why();
        data = **split;
    }
    drop_attributes(data, needs);
    join_sets(data, needs);
    rename_all(data, needs, lost);
    if (needs.network) data.network = cell_network_of(data);
    if (needs.names == Naming::numbers && needs.face_sets) leave_faces_once(data, needs, lost);
    auto made = VolumeMesh::make(std::move(data));
    if (!made) return std::move(made).why();
    return PreparedMesh{*std::move(made), std::move(lost)};
}

}  // namespace geomend::exchange
