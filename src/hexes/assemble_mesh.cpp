// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/assemble_mesh.h"

#include <algorithm>
#include <numeric>

#include "model/attribute_operations.h"

namespace geomend::hexes {

namespace {

/// A cell of the new mesh: one of the mixed mesh, or one of the old mesh that was no tetrahedron.
struct Source {
    std::uint32_t region;
    CellType type;
    std::uint32_t old_cell;
    std::uint32_t mixed = no_index;  ///< its number there
};

class Assembly {
public:
    Assembly(const VolumeMesh& old, const TetMesh& tets, MixedMesh mixed) : old_(old), tets_(tets), mixed_(std::move(mixed)) {}

    Result<VolumeMesh> run() {
        d_.name = old_->name;
        d_.crs = old_->crs;
        d_.regions = old_->regions;
        d_.surfaces = old_->surfaces;
        d_.lines = old_->lines;
        d_.corners = old_->corners;
        d_.edge_sets = old_->edge_sets;
        d_.node_sets = old_->node_sets;
        list_sources();
        add_cells();
        add_sets();
        add_vertices();
        add_attributes();
        return VolumeMesh::make(std::move(d_));
    }

private:
    void list_sources() {
        for (std::uint32_t i = 0; i < mixed_.cells.size(); ++i) {
            const auto& cell = mixed_.cells[i];
            sources_.push_back({cell.region, cell.type, tets_.cells[cell.tet], i});
        }
        for (const auto& block : old_->blocks) {
            if (block.type == CellType::tetrahedron) continue;
            for (std::uint32_t c = block.first; c < block.first + block.count; ++c) sources_.push_back({block.region, block.type, c});
        }
        std::ranges::stable_sort(sources_, {}, [](const Source& s) { return std::pair(s.region, s.type); });
    }

    void add_cells() {
        new_of_mixed_.resize(mixed_.cells.size());
        new_of_old_.assign(old_->cell_count(), no_index);
        const bool has_polyhedra = !old_->cell_faces.empty();
        if (has_polyhedra) {
            d_.cell_faces = {0};
            d_.face_offsets = {0};
        }
        for (std::uint32_t i = 0; i < sources_.size(); ++i) {
            const Source& s = sources_[i];
            if (s.mixed != no_index) {
                new_of_mixed_[s.mixed] = i;
                const auto& c = mixed_.cells[s.mixed].corners;
                d_.cell_nodes.insert(d_.cell_nodes.end(), c.begin(), c.begin() + node_count(s.type));
            } else {
                new_of_old_[s.old_cell] = i;
                const auto nodes = old_->nodes_of(s.old_cell);
                d_.cell_nodes.insert(d_.cell_nodes.end(), nodes.begin(), nodes.end());
            }
            d_.cell_offsets.push_back(d_.cell_nodes.size());
            if (has_polyhedra) add_faces(s);
            if (d_.blocks.empty() || d_.blocks.back().region != s.region || d_.blocks.back().type != s.type)
                d_.blocks.push_back({s.region, s.type, i, 0});
            ++d_.blocks.back().count;
        }
    }

    void add_faces(const Source& s) {
        if (s.mixed == no_index) {
            for (std::uint64_t f = old_->cell_faces[s.old_cell]; f < old_->cell_faces[s.old_cell + 1]; ++f) {
                for (std::uint64_t n = old_->face_offsets[f]; n < old_->face_offsets[f + 1]; ++n)
                    d_.face_nodes.push_back(old_->face_nodes[n]);
                d_.face_offsets.push_back(d_.face_nodes.size());
            }
        }
        d_.cell_faces.push_back(d_.face_offsets.size() - 1);
    }

    void add_sets() {
        std::vector<std::uint32_t> tet_of(old_->cell_count(), no_index);
        for (std::uint32_t t = 0; t < tets_.cells.size(); ++t) tet_of[tets_.cells[t]] = t;
        for (const auto& set : old_->face_sets) {
            VolumeMeshData::FaceSet made{set.name, set.role, set.side, set.surface, {}};
            for (const CellFaceRef& face : set.faces) {
                const CellFaceRef now =
                    tet_of[face.cell] == no_index ? CellFaceRef{new_of_old_[face.cell], face.face} : place_of(tet_of[face.cell], face);
                if (now.cell != no_index) made.faces.push_back(now);
            }
            std::ranges::sort(made.faces);
            made.faces.erase(std::ranges::unique(made.faces).begin(), made.faces.end());
            d_.face_sets.push_back(std::move(made));
        }
    }

    CellFaceRef place_of(std::uint32_t tet, const CellFaceRef& face) const {
        const auto nodes = old_.nodes_of(face);
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (std::ranges::find(nodes, tets_.tets[tet][k]) != nodes.end()) continue;
            const CellFaceRef place = mixed_.facet_places[4 * tet + k];
            return place.cell == no_index ? place : CellFaceRef{new_of_mixed_[place.cell], place.face};
        }
        return {};
    }

    void add_vertices() {
        if (!old_->vertex_places.empty()) {
            d_.vertex_places = old_->vertex_places;
            for (const auto& v : mixed_.new_vertices) d_.vertex_places.push_back({VolumeMeshData::Place::region, v.region});
        }
        d_.vertices = std::move(mixed_.positions);
    }

    void add_attributes() {
        std::vector<std::uint32_t> rows;
        for (const Source& s : sources_) rows.push_back(s.old_cell);
        std::vector<Sample> samples;
        for (std::uint32_t v = 0; v < old_->vertices.size(); ++v) samples.push_back({{v, v, v}, {1, 0, 0}});
        for (const auto& v : mixed_.new_vertices) samples.push_back({{v.near[0], v.near[2], v.near[0]}, {0.5, 0.5, 0}});
        for (const Attribute& a : old_->attributes) {
            if (a.location == AttributeLocation::cell) d_.attributes.push_back(taken(a, rows));
            else if (a.location == AttributeLocation::point) d_.attributes.push_back(interpolated(a, samples));
            else d_.attributes.push_back(a);
        }
    }

    const VolumeMesh& old_;
    const TetMesh& tets_;
    MixedMesh mixed_;
    VolumeMeshData d_;
    std::vector<Source> sources_;
    std::vector<std::uint32_t> new_of_mixed_, new_of_old_;
};

}  // namespace

Result<VolumeMesh> assemble(const VolumeMesh& old, const TetMesh& tets, MixedMesh mixed) {
    return Assembly(old, tets, std::move(mixed)).run();
}

}  // namespace geomend::hexes
