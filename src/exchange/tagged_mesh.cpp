// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>

#include "exchange/attribute_merge.h"
#include "exchange/model_from_brep.h"
#include "exchange/statements.h"
#include "topology/corner_values.h"
#include "topology/twin_nodes.h"

namespace geomend::exchange {

namespace {

std::int64_t tag_of(std::uint32_t index) { return std::int64_t{index} + 1; }

/// The signed tags of the lines around each surface: a line counts once for each side on which the surface borders
/// it, negative where the surface's own sense of rotation runs against it.
class BorderTags {
public:
    explicit BorderTags(const BrepData& brep) {
        for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
            const auto& v = brep.lines[l].vertices;
            first_segment_[{std::min(v[0], v[1]), std::max(v[0], v[1])}] = {l, v[0] < v[1]};
        }
    }

    std::vector<std::int64_t> of(const BrepData::Surface& surface) const {
        std::vector<std::int64_t> tags;
        if (surface.neighbours.empty()) return tags;
        std::size_t corner = 0;
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t i = 0; i < polygon.size(); ++i, ++corner) {
                if (surface.neighbours[corner] != no_index) continue;
                const VertexId a = surface.nodes[polygon[i]], b = surface.nodes[polygon[(i + 1) % polygon.size()]];
                const auto found = first_segment_.find({std::min(a, b), std::max(a, b)});
                if (found == first_segment_.end()) continue;
                const auto& [line, ascending] = found->second;
                tags.push_back((a < b) == ascending ? tag_of(line) : -tag_of(line));
            }
        }
        std::sort(tags.begin(), tags.end(), [](std::int64_t x, std::int64_t y) {
            const std::int64_t ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
            return ax != ay ? ax < ay : x > y;
        });
        return tags;
    }

private:
    std::map<std::pair<VertexId, VertexId>, std::pair<std::uint32_t, bool>> first_segment_;
};

class MeshWriter {
public:
    /// \param stated whether a StatedModel and annotations go beside the mesh; else surfaces give way to shared points
    MeshWriter(const BrepData& brep, bool stated, std::vector<Loss>& losses) : b_(brep), stated_(stated), losses_(losses) {}

    /// The entity of each surface, once the mesh is made.
    const std::vector<std::uint32_t>& surface_entities() const { return surface_entity_; }

    CellMesh run() {
        out_.info.name = b_.name;
        out_.info.crs = b_.crs;
        out_.info.annotations = b_.annotations;
        out_.points = b_.vertices;
        attributes_.extend(AttributeLocation::point, out_.points.size());
        for (const auto& region : b_.regions) has_polyhedra_ |= !region.cell_faces.empty();
        if (has_polyhedra_) {
            out_.cell_faces.push_back(0);
            out_.face_offsets.push_back(0);
        }
        attributes_.add(b_.vertex_attributes, AttributeLocation::point, 0, out_.points.size());
        add_corners();
        add_lines();
        add_surfaces();
        add_regions();
        attributes_.extend(AttributeLocation::cell, out_.cell_count());
        out_.info.attributes = attributes_.finish(b_.name, losses_);
        if (stated_) add_statements();
        else list_losses();
        return std::move(out_);
    }

private:
    std::uint32_t add_group(int dimension, const std::string& name) {
        std::int64_t& last = last_group_tag_[dimension];
        out_.groups.push_back({dimension, ++last, name});
        return static_cast<std::uint32_t>(out_.groups.size() - 1);
    }
    std::uint32_t add_entity(int dimension, std::uint32_t index, const std::string& name) {
        CellMesh::Entity entity;
        entity.dimension = dimension;
        entity.tag = tag_of(index);
        entity.name = name;
        out_.entities.push_back(std::move(entity));
        return static_cast<std::uint32_t>(out_.entities.size() - 1);
    }
    void add_cell(CellType type, std::span<const std::uint32_t> nodes, std::uint32_t entity) {
        out_.add_cell(type, nodes);
        out_.cell_entity.push_back(entity);
    }

    void add_corners() {
        for (std::uint32_t c = 0; c < b_.corners.size(); ++c) {
            const std::uint32_t e = add_entity(0, c, b_.corners[c].name);
            if (!b_.corners[c].name.empty()) out_.entities[e].groups.push_back(add_group(0, b_.corners[c].name));
            const std::uint32_t v = b_.corners[c].vertex.value;
            add_cell(CellType::vertex, {&v, 1}, e);
        }
    }

    void add_lines() {
        for (std::uint32_t l = 0; l < b_.lines.size(); ++l) {
            const auto& line = b_.lines[l];
            const std::uint32_t e = add_entity(1, l, line.name);
            if (!line.name.empty()) out_.entities[e].groups.push_back(add_group(1, line.name));
            out_.entities[e].boundary = {tag_of(line.corners[0].value), -tag_of(line.corners[1].value)};
            for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i) {
                const std::array<std::uint32_t, 2> edge{line.vertices[i].value, line.vertices[i + 1].value};
                add_cell(CellType::line, edge, e);
            }
        }
    }

    void add_surfaces() {
        const BorderTags borders(b_);
        std::vector<std::uint32_t> group_of(b_.interfaces.size(), no_index);
        for (std::uint32_t s = 0; s < b_.surfaces.size(); ++s) {
            const auto& surface = b_.surfaces[s];
            const bool has_interface = surface.interface_id.valid();
            const std::string& name = has_interface ? b_.interfaces[surface.interface_id.value].name : surface.name;
            const std::uint32_t e = add_entity(2, s, name);
            auto& entity = out_.entities[e];
            entity.role = surface.role;
            entity.role_text = surface.role_text;
            entity.boundary = borders.of(surface);
            if (has_interface) {
                std::uint32_t& group = group_of[surface.interface_id.value];
                if (group == no_index) group = add_group(2, name);
                entity.groups.push_back(group);
            }
            const std::size_t first_cell = out_.cell_count();
            first_cell_.push_back(first_cell);
            surface_entity_.push_back(e);
            std::vector<std::uint32_t> polygon, target;
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
                polygon.clear();
                for (const std::uint32_t node : surface.polygons[p]) polygon.push_back(surface.nodes[node].value);
                const CellType type = polygon.size() == 3 ? CellType::triangle : polygon.size() == 4 ? CellType::quad : CellType::polygon;
                add_cell(type, polygon, e);
            }
            if (!stated_) {
                for (const VertexId v : surface.nodes) target.push_back(v.value);
                attributes_.add(surface.attributes, AttributeLocation::point, AttributeLocation::point, target);
                target.clear();
            }
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) target.push_back(static_cast<std::uint32_t>(first_cell + p));
            attributes_.add(surface.attributes, AttributeLocation::polygon, AttributeLocation::cell, target);
            lose_object_attributes(surface.attributes, surface.name);
        }
    }

    void add_regions() {
        for (std::uint32_t r = 0; r < b_.regions.size(); ++r) {
            const auto& region = b_.regions[r];
            const std::uint32_t e = add_entity(3, r, region.name);
            for (const auto& side : region.sides) {
                out_.entities[e].boundary.push_back(side.front ? -tag_of(side.surface.value) : tag_of(side.surface.value));
            }
            if (!region.name.empty()) out_.entities[e].groups.push_back(add_group(3, region.name));
            const std::size_t first_cell = out_.cell_count();
            std::vector<std::uint32_t> cell, target;
            for (std::size_t c = 0; c < region.cell_types.size(); ++c) {
                cell.clear();
                for (std::uint64_t k = region.cell_offsets[c]; k < region.cell_offsets[c + 1]; ++k) {
                    cell.push_back(region.nodes[region.cell_nodes[k]].value);
                }
                add_cell(region.cell_types[c], cell, e);
                if (!region.cell_faces.empty()) add_faces(region, c);
            }
            for (const VertexId v : region.nodes) target.push_back(v.value);
            attributes_.add(region.attributes, AttributeLocation::point, AttributeLocation::point, target);
            target.clear();
            for (std::size_t c = 0; c < region.cell_types.size(); ++c) target.push_back(static_cast<std::uint32_t>(first_cell + c));
            attributes_.add(region.attributes, AttributeLocation::cell, AttributeLocation::cell, target);
            lose_object_attributes(region.attributes, region.name);
        }
    }

    void add_faces(const BrepData::Region& region, std::size_t cell) {
        for (std::uint64_t f = region.cell_faces[cell]; f < region.cell_faces[cell + 1]; ++f) {
            for (std::uint64_t k = region.face_offsets[f]; k < region.face_offsets[f + 1]; ++k) {
                out_.face_nodes.push_back(region.nodes[region.face_nodes[k]].value);
            }
            out_.face_offsets.push_back(out_.face_nodes.size());
        }
        out_.cell_faces.back() = out_.face_offsets.size() - 1;
    }

    void lose_object_attributes(const std::vector<Attribute>& attributes, const std::string& entity) {
        for (const Attribute& a : attributes) {
            if (a.location != AttributeLocation::object) continue;
            add_loss(losses_,
                     {LossClass::substance, entity, "attribute '" + a.name + "'", "entities of a mesh have no values of their own", 1});
        }
    }

    /// What shared points and entities do not say: values of the surfaces' own nodes, and which of them are twins.
    void add_statements() {
        std::vector<std::int64_t> tags;
        Twins twins;
        for (std::uint32_t s = 0; s < b_.surfaces.size(); ++s) {
            tags.push_back(tag_of(s));
            if (auto own = topology::twins_of(b_.surfaces[s]); !own.empty()) twins.emplace(tag_of(s), std::move(own));
            lose_loose_nodes(b_.surfaces[s]);
        }
        out_.twins = std::move(twins);
        for (Attribute& a : topology::shared_node_attributes(b_, first_cell_, tags, out_.cell_count()))
            out_.info.attributes.push_back(std::move(a));
    }

    void lose_loose_nodes(const BrepData::Surface& surface) {
        std::vector<std::uint8_t> used(surface.nodes.size(), 0);
        for (const std::uint32_t node : surface.polygons.corners) used[node] = 1;
        const auto loose = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), 0));
        if (loose == 0) return;
        const bool valued = std::any_of(surface.attributes.begin(), surface.attributes.end(),
                                        [](const Attribute& a) { return a.location == AttributeLocation::point; });
        add_loss(losses_, {valued ? LossClass::substance : LossClass::identity, surface.name, "nodes that no polygon uses",
                           "the points of a mesh are no surface's own", loose});
    }

    void list_losses() {
        const auto lose = [&](std::size_t count, const char* what) {
            if (count > 0) add_loss(losses_, {LossClass::identity, b_.name, what, "a tagged mesh has no place for them", count});
        };
        lose(b_.layers.size(), "layers");
        lose(b_.fault_blocks.size(), "fault blocks");
        lose(b_.features.size(), "geological features");
        if (const auto twins = topology::count_twins(b_); twins > 0) {
            add_loss(losses_, {LossClass::identity, b_.name, "twin nodes that cut a surface", "a mesh has one node for them", twins});
        }
    }

    const BrepData& b_;
    bool stated_;
    std::vector<Loss>& losses_;
    CellMesh out_;
    std::vector<std::size_t> first_cell_;        // per surface
    std::vector<std::uint32_t> surface_entity_;  // per surface
    AttributeMerge attributes_;
    std::map<int, std::int64_t> last_group_tag_;
    bool has_polyhedra_ = false;
};

}  // namespace

CellMesh tagged_mesh(const Brep& brep, std::vector<Loss>& losses) { return MeshWriter(*brep, false, losses).run(); }

Dataset tagged_model(const Brep& brep, std::vector<Loss>& losses) {
    Dataset result;
    MeshWriter writer(*brep, true, losses);
    result.objects.emplace_back(writer.run());
    std::vector<FacePlace> places;
    for (std::uint32_t s = 0; s < brep->surfaces.size(); ++s) places.push_back({SurfaceId(s), 0, writer.surface_entities()[s]});
    StatedModel model = stated_model(*brep, places);
    for (auto& face : model.faces) face.key.reset();  // sides are those of the mesh's own polygons
    for (const auto& interface : brep->interfaces) {
        if (!interface.feature.empty() || !interface.annotations.empty()) {
            model.interfaces.push_back({interface.name, interface.feature, interface.annotations});
        }
    }
    result.models.push_back(std::move(model));
    return result;
}

}  // namespace geomend::exchange
