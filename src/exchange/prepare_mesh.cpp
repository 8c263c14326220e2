// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/prepare_mesh.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <span>
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

/// Where a face stays that several sets have, or one from both of its cells.
struct FaceOwner {
    std::size_t set = 0;
    CellFaceRef face;
};
using FaceOwners = std::map<std::vector<std::uint32_t>, FaceOwner>;

std::vector<std::uint32_t> known_by(const Data& mesh, const CellFaceRef& face) {
    auto nodes = nodes_of(mesh, face);
    std::ranges::sort(nodes);
    return nodes;
}

std::uint32_t region_of(const Data& mesh, std::uint32_t cell) {
    const auto block = std::ranges::upper_bound(mesh.blocks, cell, {}, &Data::Block::first) - 1;
    return block->region;
}

/// The first set that has a face. Where sides are not told apart, of the sets of one surface the one on the side of the lower region: so
/// a surface looks one way wherever it lies between the same regions, and inside a region as its first set does.
FaceOwners owners_of_faces(const Data& mesh, const MeshNeeds& needs) {
    FaceOwners owners;
    for (std::size_t s = 0; s < mesh.face_sets.size(); ++s) {
        for (const CellFaceRef& face : mesh.face_sets[s].faces) {
            const auto [at, is_new] = owners.emplace(known_by(mesh, face), FaceOwner{s, face});
            if (is_new || needs.face_sides) continue;
            const std::uint32_t surface = mesh.face_sets[at->second.set].surface;
            const bool of_one = at->second.set == s || (surface != no_index && surface == mesh.face_sets[s].surface);
            if (of_one && region_of(mesh, face.cell) < region_of(mesh, at->second.face.cell)) at->second = {s, face};
        }
    }
    return owners;
}

/// Leaves a face to one set, and lists what the others lose: faces, or only their side where the owner is of the same surface.
void leave_faces_once(Data& mesh, const MeshNeeds& needs, std::vector<Loss>& losses) {
    const FaceOwners owners = owners_of_faces(mesh, needs);
    const std::string why = std::string(needs.target) + " has a face in one set only";
    for (std::size_t s = 0; s < mesh.face_sets.size(); ++s) {
        Data::FaceSet& set = mesh.face_sets[s];
        std::uint64_t lost = 0, other_sides = 0;
        std::erase_if(set.faces, [&](const CellFaceRef& face) {
            const FaceOwner& owner = owners.at(known_by(mesh, face));
            if (owner.set == s) return owner.face != face;  // a set of both sides has a face once, too
            const Data::FaceSet& first = mesh.face_sets[owner.set];
            if (first.surface != no_index && first.surface == set.surface) ++(first.side == set.side ? lost : other_sides);
            else if (first.name != set.name) ++lost;  // sets of one name become one
            return true;
        });
        if (lost > 0) add_loss(losses, {LossClass::substance, set.name, "faces of a set", why, lost});
        if (other_sides > 0 && needs.face_sides) add_loss(losses, {LossClass::identity, set.name, "side of faces", why, other_sides});
    }
    std::erase_if(mesh.face_sets, [](const Data::FaceSet& set) { return set.faces.empty(); });
}

/// Sets that the target keeps, one of each name, and without sides where it has none.
void join_sets(Data& mesh, const MeshNeeds& needs, std::vector<Loss>& losses) {
    if (!needs.face_sets) mesh.face_sets.clear();
    if (!needs.edge_sets) mesh.edge_sets.clear();
    if (!needs.node_sets) mesh.node_sets.clear();
    if (needs.faces_once) leave_faces_once(mesh, needs, losses);  // first, so that all faces of a surface look to one side
    if (!needs.face_sides) join_sides(mesh.surfaces, mesh.face_sets);
    join_names(mesh.face_sets, join_face_sets);
    join_names(mesh.edge_sets,
               [](Data::EdgeSet& to, const Data::EdgeSet& from) { std::ranges::copy(from.edges, std::back_inserter(to.edges)); });
    join_names(mesh.node_sets, [](Data::NodeSet& to, const Data::NodeSet& from) { append_sorted(to.nodes, from.nodes); });
}

/// Names that a target can write, all different.
void rename(std::span<std::string* const> names, const MeshNeeds& needs, std::vector<Loss>& losses) {
    std::vector<std::string> given;
    for (const std::string* name : names) given.push_back(*name);
    const std::vector<std::string> found = target_names(given, needs.names, needs.longest_name);
    std::set<std::string> known;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_new = known.insert(given[i]).second;
        *names[i] = found[i];
        const bool shorter = needs.longest_name > 0 && given[i].size() > needs.longest_name;  // listed as such
        if (found[i] == given[i] || (is_new && shorter)) continue;
        const std::string why = is_new ? " cannot write it: it is called '" : " has a name only once: the next one is called '";
        add_loss(losses, {LossClass::identity, given[i], "name", std::string(needs.target) + why + found[i] + "'", 1});
    }
}

/// Names that the target can write, for each kind by itself where it has a name space for each.
void rename_all(Data& mesh, const MeshNeeds& needs, std::vector<Loss>& losses) {
    if (needs.names == Naming::numbers) return;
    std::vector<std::string*> names;
    const auto end_kind = [&] {
        rename(names, needs, losses);
        names.clear();
    };
    for (std::string& region : mesh.regions) names.push_back(&region);
    if (!needs.one_name_space) end_kind();
    for (Data::FaceSet& set : mesh.face_sets) names.push_back(&set.name);
    if (!needs.one_name_space) end_kind();
    for (Data::EdgeSet& set : mesh.edge_sets) names.push_back(&set.name);
    end_kind();
    for (Data::NodeSet& set : mesh.node_sets) names.push_back(&set.name);
    end_kind();
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
    join_sets(data, needs, lost);
    rename_all(data, needs, lost);
    if (needs.network) data.network = cell_network_of(data);
    auto made = VolumeMesh::make(std::move(data));
    if (!made) return std::move(made).why();
    return PreparedMesh{*std::move(made), std::move(lost)};
}

}  // namespace geomend::exchange
