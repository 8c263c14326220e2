// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/cut_surfaces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "model/face_corners.h"
#include "model/split_sides.h"

namespace geomend {

namespace {

using Regions = std::array<std::uint32_t, 2>;  // entities, ascending; no_index where there is none

class Cutter {
public:
    Cutter(CellMesh& mesh, std::span<const std::uint8_t> may_be_cut) : mesh_(mesh), may_be_cut_(may_be_cut) {}

    std::vector<CutSurface> cut() {
        find_regions();
        for (const CellMesh::Entity& e : mesh_.entities) {
            if (e.tag < std::numeric_limits<std::int32_t>::max()) next_tag_ = std::max(next_tag_, e.tag);
        }
        std::map<std::pair<std::uint32_t, Regions>, std::uint32_t> piece_of;
        std::map<std::uint32_t, CutSurface> surfaces;
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            if (!is_of_a_set(c)) continue;
            const std::uint32_t surface = mesh_.cell_entity[c];
            Regions between = regions_[face_places(face_corners(mesh_, c), first_)];
            std::ranges::sort(between);
            const auto [at, is_new] = piece_of.try_emplace({surface, between}, surface);
            if (is_new) {
                auto& pieces = surfaces[surface].pieces;
                if (!pieces.empty()) at->second = copy_of(surface);
                pieces.push_back(at->second);
            }
            mesh_.cell_entity[c] = at->second;
        }
        std::vector<CutSurface> result;
        for (auto& [surface, cut] : surfaces) {
            if (cut.pieces.size() < 2) continue;
            give_name(cut);
            result.push_back(std::move(cut));
        }
        return result;
    }

private:
    bool is_of_a_set(std::size_t cell) const {
        const std::uint32_t e = mesh_.cell_entity[cell];
        return dimension(mesh_.types[cell]) == 2 && e < may_be_cut_.size() && may_be_cut_[e] != 0;
    }

    /// The regions of the cells at each face of a set, also where the mesh is split there and they have nodes of their own. Most cells
    /// have no face all of whose corners are on one.
    void find_regions() {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c) {
            if (is_of_a_set(c)) faces.push_back(c);
        }
        if (faces.empty()) return;
        first_ = first_at_places(mesh_, faces);
        std::vector<std::uint8_t> is_on_a_set(mesh_.points.size(), 0);
        for (const std::uint32_t c : faces) {
            regions_[face_places(face_corners(mesh_, c), first_)] = {no_index, no_index};
            for (const std::uint32_t node : mesh_.cell_nodes(c)) is_on_a_set[first_[node]] = 1;
        }
        for (std::size_t p = 0; p < first_.size(); ++p) is_on_a_set[p] = is_on_a_set[first_[p]];
        each_marked_face(mesh_, is_on_a_set, [&](std::size_t cell, const FaceCorners& corners) {
            const auto at = regions_.find(face_places(corners, first_));
            if (at != regions_.end()) at->second[at->second[0] == no_index ? 0 : 1] = mesh_.cell_entity[cell];
        });
    }

    std::uint32_t copy_of(std::uint32_t surface) {
        CellMesh::Entity copy = mesh_.entities[surface];
        copy.tag = ++next_tag_;
        mesh_.entities.push_back(std::move(copy));
        return static_cast<std::uint32_t>(mesh_.entities.size() - 1);
    }

    /// Without a name nothing would say that the pieces are one set.
    void give_name(const CutSurface& cut) {
        const CellMesh::Entity& whole = mesh_.entities[cut.pieces.front()];
        const auto has_name = [&](std::uint32_t group) { return group < mesh_.groups.size() && !mesh_.groups[group].name.empty(); };
        if (!whole.name.empty() || std::ranges::any_of(whole.groups, has_name)) return;
        const std::string name = "Surface_" + std::to_string(whole.tag);
        for (const std::uint32_t piece : cut.pieces) mesh_.entities[piece].name = name;
    }

    CellMesh& mesh_;
    std::span<const std::uint8_t> may_be_cut_;
    std::vector<std::uint32_t> first_;  // per point the first one at its place
    std::unordered_map<FaceCorners, Regions, FaceCornersHash> regions_;
    std::int64_t next_tag_ = 0;
};

}  // namespace

std::vector<CutSurface> cut_surfaces_by_regions(CellMesh& mesh, std::span<const std::uint8_t> may_be_cut) {
    if (mesh.cell_entity.size() != mesh.cell_count()) return {};
    return Cutter(mesh, may_be_cut).cut();
}

}  // namespace geomend
