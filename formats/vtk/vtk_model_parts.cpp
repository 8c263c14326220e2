// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk_model_parts.h"

#include <algorithm>
#include <bit>

#include "formats/drop.h"
#include "formats/vtk/vtk_cells.h"
#include "model/attribute_operations.h"

namespace geomend::vtk {

namespace {

constexpr std::array<std::string_view, 4> group_names{"Corners", "Lines", "Surfaces", "Regions"};

bool same_shape(const Attribute& a, const Attribute& b) { return a.components == b.components && a.values.index() == b.values.index(); }

void copy_value(Attribute& to, std::size_t i, const Attribute& from, std::size_t k) {
    std::visit(
        [&](auto& v) {
            const auto& w = std::get<std::decay_t<decltype(v)>>(from.values);
            for (std::size_t c = 0; c < to.components; ++c) v[i * to.components + c] = w[k * to.components + c];
        },
        to.values);
}

// Bit by bit, so that NaN equals itself and zeros differ by their signs.
template <class Value>
bool same_bits(const Value& x, const Value& y) {
    if constexpr (std::is_same_v<Value, double>) return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    else if constexpr (std::is_same_v<Value, float>) return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    else return x == y;
}

bool same_values(const Attribute& a, std::size_t i, const Attribute& b, std::size_t k) {
    return std::visit(
        [&](const auto& v) {
            const auto& w = std::get<std::decay_t<decltype(v)>>(b.values);
            for (std::size_t c = 0; c < a.components; ++c) {
                if (!same_bits(v[i * a.components + c], w[k * a.components + c])) return false;
            }
            return true;
        },
        a.values);
}

/// Takes the array of model vertices out of an object; empty where it is not there.
std::vector<std::uint32_t> take_vertices(ObjectInfo& info) {
    for (std::size_t i = 0; i < info.attributes.size(); ++i) {
        auto* ids = std::get_if<std::vector<std::uint32_t>>(&info.attributes[i].values);
        if (info.attributes[i].name != model_vertex || info.attributes[i].location != AttributeLocation::point || ids == nullptr) continue;
        std::vector<std::uint32_t> taken = std::move(*ids);
        info.attributes.erase(info.attributes.begin() + static_cast<std::ptrdiff_t>(i));
        return taken;
    }
    return {};
}

// A surface without polygons reads as points.
bool as_surface(Object& object, Surface& surface) {
    if (auto* points = std::get_if<PointSet>(&object)) {
        surface.info = std::move(points->info);
        surface.points = std::move(points->points);
        return true;
    }
    auto* own = std::get_if<Surface>(&object);
    if (own == nullptr) return false;
    surface = std::move(*own);
    return true;
}

void append_attributes(std::vector<Attribute>& to, std::vector<Attribute>& from, std::size_t points, std::size_t polygons) {
    for (Attribute& a : from) {
        Attribute* same = nullptr;
        for (Attribute& other : to) {
            if (other.name == a.name && other.location == a.location) same = &other;
        }
        if (same != nullptr && !same_shape(*same, a)) continue;
        if (same == nullptr) {
            to.push_back(a);
            same = &to.back();
            std::visit([](auto& v) { v.clear(); }, same->values);
        }
        resize_with_missing(*same, a.location == AttributeLocation::point ? points : polygons);
        std::visit(
            [&](auto& v) {
                auto& more = std::get<std::decay_t<decltype(v)>>(a.values);
                v.insert(v.end(), more.begin(), more.end());
            },
            same->values);
    }
}

/// Puts corners, lines, surfaces and regions into one mesh.
class MeshMaker {
public:
    MeshMaker(SortedBlocks& blocks, std::vector<Loss>& losses) : blocks_(blocks), losses_(losses) {}

    std::optional<CellMesh> run(std::vector<CellMesh::Entity> entities) {
        std::size_t count = 0;
        for (const auto& group : blocks_.groups) count += group.size();
        if (entities.size() != count || !gather_vertices()) return std::nullopt;
        mesh_.entities = std::move(entities);
        mesh_.points.resize(ids_.size());
        alias_.assign(ids_.size(), no_index);
        claimed_.assign(ids_.size(), false);
        std::uint32_t entity = 0;
        std::size_t block = 0;
        // Regions claim the points first, because their values stand there.
        const auto first_region = static_cast<std::uint32_t>(count - blocks_.groups[3].size());
        for (std::uint32_t r = 0; r < blocks_.groups[3].size(); ++r) {
            if (!region_points(blocks_.groups[3][r], vertices_[first_region + r])) return std::nullopt;
        }
        for (const auto& group : blocks_.groups) {
            for (const Object& object : group) {
                if (!add_cells(object, block++, entity++)) return std::nullopt;
            }
        }
        for (Attribute& a : point_attributes_) resize_with_missing(a, mesh_.points.size());
        for (Attribute& a : cell_attributes_) resize_with_missing(a, mesh_.cell_count());
        mesh_.info.attributes = std::move(point_attributes_);
        std::ranges::move(cell_attributes_, std::back_inserter(mesh_.info.attributes));
        if (std::ranges::any_of(alias_, [](std::uint32_t a) { return a != no_index; })) mesh_.alias = std::move(alias_);
        return std::move(mesh_);
    }

private:
    SortedBlocks& blocks_;
    std::vector<Loss>& losses_;
    CellMesh mesh_;
    std::vector<std::uint32_t> ids_;                    ///< model vertices, ascending: the first points of the mesh
    std::vector<std::vector<std::uint32_t>> vertices_;  ///< per block, model vertex of each point
    std::vector<std::vector<std::uint32_t>> point_of_;  ///< per region block, mesh point of each point
    std::vector<std::uint32_t> alias_;
    std::vector<bool> claimed_;
    std::vector<Attribute> point_attributes_, cell_attributes_;

    bool gather_vertices() {
        for (auto& group : blocks_.groups) {
            for (Object& object : group) {
                vertices_.push_back(take_vertices(info_of(object)));
                const bool fits = std::visit(
                    [&](const auto& o) {
                        if constexpr (requires { o.points.size(); }) return o.points.size() == vertices_.back().size();
                        else return false;
                    },
                    object);
                if (!fits) return false;
                ids_.insert(ids_.end(), vertices_.back().begin(), vertices_.back().end());
            }
        }
        std::ranges::sort(ids_);
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        return true;
    }

    std::uint32_t rank(std::uint32_t id) const { return static_cast<std::uint32_t>(std::ranges::lower_bound(ids_, id) - ids_.begin()); }

    // The attribute of the mesh for one of a block's, filled up to `things`; nullptr where its type differs.
    Attribute* column(std::vector<Attribute>& all, const Attribute& like, std::size_t things, const ObjectInfo& info) {
        for (Attribute& a : all) {
            if (a.name != like.name) continue;
            if (!same_shape(a, like)) {
                list_dropped(losses_,
                             {LossClass::substance, info.name, "attribute '" + like.name + "'", "blocks give it different types", 1});
                return nullptr;
            }
            resize_with_missing(a, things);
            return &a;
        }
        all.push_back(like);
        std::visit([](auto& v) { v.clear(); }, all.back().values);
        resize_with_missing(all.back(), things);
        return &all.back();
    }

    bool region_points(const Object& object, const std::vector<std::uint32_t>& vertices) {
        const bool hollow = !std::holds_alternative<CellMesh>(object);
        point_of_.emplace_back();
        if (hollow) return true;
        const auto& region = std::get<CellMesh>(object);
        std::vector<std::pair<std::size_t, const Attribute*>> columns;  // index into point_attributes_: it may grow
        for (const Attribute& a : region.info.attributes) {
            if (a.location != AttributeLocation::point) continue;
            const Attribute* c = column(point_attributes_, a, mesh_.points.size(), region.info);
            if (c != nullptr) columns.emplace_back(static_cast<std::size_t>(c - point_attributes_.data()), &a);
        }
        for (Attribute& a : point_attributes_) resize_with_missing(a, mesh_.points.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) point_of_.back().push_back(place(region.points[i], vertices[i], i, columns));
        return true;
    }

    // The vertex's own point, or a twin with other values.
    std::uint32_t place(const Vec3& position, std::uint32_t vertex, std::size_t i,
                        const std::vector<std::pair<std::size_t, const Attribute*>>& columns) {
        const std::uint32_t first = rank(vertex);
        const auto agrees = [&](std::uint32_t p) {
            return mesh_.points[p] == position &&
                   std::ranges::all_of(columns, [&](const auto& c) { return same_values(point_attributes_[c.first], p, *c.second, i); });
        };
        std::uint32_t point = first;
        if (claimed_[first] && !agrees(first)) {
            point = static_cast<std::uint32_t>(mesh_.points.size());
            mesh_.points.push_back(position);
            alias_.push_back(mesh_.points[first] == position ? first : no_index);
            claimed_.push_back(true);
            for (Attribute& a : point_attributes_) resize_with_missing(a, mesh_.points.size());
        } else if (claimed_[first]) {
            return first;
        }
        claimed_[point] = true;
        mesh_.points[point] = position;
        for (const auto& [c, a] : columns) copy_value(point_attributes_[c], point, *a, i);
        return point;
    }

    bool add_cells(const Object& object, std::size_t block, std::uint32_t entity) {
        const std::vector<std::uint32_t>& vertices = vertices_[block];
        const int dimension = mesh_.entities[entity].dimension;
        const std::size_t first_cell = mesh_.cell_count();
        const std::size_t first_region = mesh_.entities.size() - blocks_.groups[3].size();
        std::vector<std::uint32_t> points;
        if (dimension == 3) {
            if (block < first_region) return false;
            points = point_of_[block - first_region];
        } else {
            for (const std::uint32_t v : vertices) points.push_back(rank(v));
            set_positions(object, points);
        }
        const bool hollow = dimension == 3 && !std::holds_alternative<CellMesh>(object);
        if (hollow) return true;  // its sides are surfaces already
        CellMesh cells;
        if (!mesh_from_object(object, cells)) return false;
        for (std::size_t c = 0; c < cells.cell_count(); ++c) add_cell(cells, c, points, entity);
        cell_values(cells.info, first_cell);
        return true;
    }

    void set_positions(const Object& object, const std::vector<std::uint32_t>& points) {
        std::visit(
            [&](const auto& o) {
                if constexpr (requires { o.points.size(); }) {
                    for (std::size_t i = 0; i < points.size(); ++i) {
                        if (claimed_[points[i]]) continue;
                        mesh_.points[points[i]] = o.points[i];
                        claimed_[points[i]] = true;
                    }
                }
            },
            object);
    }

    void add_cell(const CellMesh& cells, std::size_t c, const std::vector<std::uint32_t>& points, std::uint32_t entity) {
        const auto nodes = cells.cell_nodes(c);
        if (cells.types[c] == CellType::poly_line) {
            for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
                const std::array<std::uint32_t, 2> edge{points[nodes[k]], points[nodes[k + 1]]};
                mesh_.add_cell(CellType::line, edge);
                mesh_.cell_entity.push_back(entity);
            }
            return;
        }
        std::vector<std::uint32_t> turned;
        for (const std::uint32_t n : nodes) turned.push_back(points[n]);
        if (cells.types[c] == CellType::polyhedron) {
            std::vector<std::uint32_t> stream;
            for (std::uint64_t f = cells.cell_faces[c]; f < cells.cell_faces[c + 1]; ++f) {
                stream.push_back(static_cast<std::uint32_t>(cells.face_offsets[f + 1] - cells.face_offsets[f]));
                for (std::uint64_t k = cells.face_offsets[f]; k < cells.face_offsets[f + 1]; ++k)
                    stream.push_back(points[cells.face_nodes[k]]);
            }
            MeshBuilder(mesh_).add_polyhedron(turned, stream);
        } else {
            mesh_.add_cell(cells.types[c], turned);
        }
        mesh_.cell_entity.push_back(entity);
    }

    void cell_values(const ObjectInfo& info, std::size_t first_cell) {
        for (const Attribute& a : info.attributes) {
            const bool on_cells =
                a.location == AttributeLocation::cell && value_count(a) == (mesh_.cell_count() - first_cell) * a.components;
            if (!on_cells) {
                if (a.location != AttributeLocation::point ||
                    mesh_.entities[mesh_.cell_entity.empty() ? 0 : mesh_.cell_entity.back()].dimension != 3)
                    list_dropped(losses_, {LossClass::substance, info.name, "attribute '" + a.name + "'", "a mesh has no place for it", 1});
                continue;
            }
            Attribute* to = column(cell_attributes_, a, mesh_.cell_count(), info);
            if (to == nullptr) continue;
            for (std::size_t k = 0; first_cell + k < mesh_.cell_count(); ++k) copy_value(*to, first_cell + k, a, k);
        }
    }
};

}  // namespace

SortedBlocks sort_blocks(Dataset blocks) {
    SortedBlocks sorted;
    std::vector<Object> objects = std::move(blocks.objects);
    blocks.objects.clear();
    for (Object& object : objects) {
        ObjectInfo& info = info_of(object);
        const auto group = info.groups.empty() ? group_names.end() : std::ranges::find(group_names, info.groups.front());
        if (group == group_names.end() || info.groups.size() != 1) {
            blocks.objects.push_back(std::move(object));
            continue;
        }
        info.groups.clear();
        sorted.groups[static_cast<std::size_t>(group - group_names.begin())].push_back(std::move(object));
    }
    sorted.rest = std::move(blocks);
    return sorted;
}

std::vector<Object> surfaces_of_blocks(SortedBlocks& blocks, const std::vector<std::vector<std::uint32_t>>& lists) {
    std::vector<Object> objects;
    std::vector<Object>& surfaces = blocks.groups[2];
    std::vector<bool> used(surfaces.size(), false);
    for (const auto& list : lists) {
        Surface whole;
        for (const std::uint32_t s : list) {
            Surface part;
            if (s >= surfaces.size() || used[s] || !as_surface(surfaces[s], part)) return {};
            used[s] = true;
            take_vertices(part.info);
            const auto first_point = static_cast<std::uint32_t>(whole.points.size());
            whole.parts.push_back({first_point, whole.polygons.size()});
            append_attributes(whole.info.attributes, part.info.attributes, whole.points.size(), whole.polygons.size());
            std::vector<std::uint32_t> polygon;
            for (std::size_t p = 0; p < part.polygons.size(); ++p) {
                polygon.assign(part.polygons[p].begin(), part.polygons[p].end());
                for (std::uint32_t& corner : polygon) corner += first_point;
                whole.polygons.push_back(polygon);
            }
            whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
            for (Attribute& a : whole.info.attributes)
                resize_with_missing(a, a.location == AttributeLocation::point ? whole.points.size() : whole.polygons.size());
            whole.info.annotations = std::move(part.info.annotations);
        }
        objects.emplace_back(std::move(whole));
    }
    return objects;
}

std::optional<CellMesh> mesh_of_blocks(SortedBlocks& blocks, std::vector<CellMesh::Entity> entities, std::vector<Loss>& losses) {
    return MeshMaker(blocks, losses).run(std::move(entities));
}

std::vector<CellMesh::Entity> model_entities(const BrepData& brep) {
    std::vector<CellMesh::Entity> entities;
    const auto add = [&](int dimension, std::size_t i, const std::string& name) -> CellMesh::Entity& {
        CellMesh::Entity e;
        e.dimension = dimension;
        e.tag = static_cast<std::int64_t>(i) + 1;
        e.name = name;
        entities.push_back(std::move(e));
        return entities.back();
    };
    for (std::size_t i = 0; i < brep.corners.size(); ++i) add(0, i, brep.corners[i].name);
    for (std::size_t i = 0; i < brep.lines.size(); ++i) {
        CellMesh::Entity& e = add(1, i, brep.lines[i].name);
        for (const CornerId c : brep.lines[i].corners) {
            if (c.valid()) e.boundary.push_back(static_cast<std::int64_t>(c.value) + 1);
        }
    }
    for (std::size_t i = 0; i < brep.surfaces.size(); ++i) {
        const BrepData::Surface& s = brep.surfaces[i];
        CellMesh::Entity& e = add(2, i, s.name);
        e.role = s.role;
        e.role_text = s.role_text;
        for (const auto& l : s.lines) e.boundary.push_back(static_cast<std::int64_t>(l.line.value) + 1);
    }
    for (std::size_t i = 0; i < brep.regions.size(); ++i) {
        CellMesh::Entity& e = add(3, i, brep.regions[i].name);
        for (const auto& side : brep.regions[i].sides) {
            const auto tag = static_cast<std::int64_t>(side.surface.value) + 1;
            e.boundary.push_back(side.front ? -tag : tag);  // the boundary's normal looks out of the region
        }
    }
    return entities;
}

}  // namespace geomend::vtk
