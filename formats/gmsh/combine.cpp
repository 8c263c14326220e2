// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/combine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace geomend::gmsh {

namespace {

// Values of one object that go into a property of the whole.
struct Share {
    const Attribute* attribute = nullptr;
    std::size_t first = 0;  // first point or cell of the object in the whole
    std::size_t count = 0;
};

class Combiner {
public:
    explicit Combiner(std::vector<Loss>& losses) : losses_(losses) {}

    void add(const PointSet& set) {
        begin(set.info);
        const std::uint32_t base = add_points(set.points);
        const std::uint32_t entity = new_entity(0, set.info);
        for (std::uint32_t i = 0; i < set.points.size(); ++i) add_cell(CellType::vertex, std::array{base + i}, entity);
        end(set.info);
    }

    void add(const PolylineSet& set) {
        begin(set.info);
        const std::uint32_t base = add_points(set.points);
        const std::uint32_t entity = new_entity(1, set.info);
        for (const auto& edge : set.edges) add_cell(CellType::line, std::array{base + edge[0], base + edge[1]}, entity);
        const bool named = std::ranges::any_of(set.parts, [](const auto& part) { return !part.name.empty(); });
        if (named || set.parts.size() > 1) lose(LossClass::identity, set.info, "parts of the polylines", "an entity has no parts");
        end(set.info);
    }

    void add(const Surface& surface) {
        begin(surface.info);
        const std::uint32_t base = add_points(surface.points);
        const std::uint32_t entity = new_entity(2, surface.info);
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
            const auto polygon = surface.polygons[i];
            corners.assign(polygon.begin(), polygon.end());
            for (std::uint32_t& c : corners) c += base;
            const CellType type = corners.size() == 3 ? CellType::triangle : corners.size() == 4 ? CellType::quad : CellType::polygon;
            add_cell(type, corners, entity);
        }
        if (surface.parts.size() > 1) lose(LossClass::identity, surface.info, "parts of the surface", "an entity has no parts");
        if (!surface.border_corners.empty() || !surface.border_starts.empty())
            lose(LossClass::style, surface.info, "stated border corners", "MSH has no place for them");
        end(surface.info);
    }

    void add(const CellMesh& mesh) {
        begin(mesh.info);
        const std::uint32_t base = add_points(mesh.points);
        const std::vector<std::uint32_t> entity_of = take_entities(mesh);
        std::array<std::uint32_t, 4> loose{no_index, no_index, no_index, no_index};
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
            const auto nodes = mesh.cell_nodes(i);
            corners.assign(nodes.begin(), nodes.end());
            for (std::uint32_t& c : corners) c += base;
            const std::uint32_t own = mesh.cell_entity.empty() ? no_index : mesh.cell_entity[i];
            std::uint32_t entity = own < entity_of.size() ? entity_of[own] : no_index;
            if (entity == no_index) {
                const int d = dimension(mesh.types[i]);
                std::uint32_t& slot = loose[static_cast<std::size_t>(d)];
                if (slot == no_index) slot = new_entity(d, mesh.info);
                entity = slot;
            }
            add_cell(mesh.types[i], corners, entity);
        }
        if (mesh.twins && !mesh.twins->empty())
            lose(LossClass::identity, mesh.info, "twin nodes that cut a surface", "several objects become one mesh", mesh.twins->size());
        if (!mesh.facet_tags.empty()) lose(LossClass::identity, mesh.info, "stated surfaces behind facets", "MSH has no place for them");
        end(mesh.info);
    }

    void add(const StructuredGrid& grid) {
        begin(grid.info);
        const std::uint32_t base = add_points(grid.points);
        add_lattice(grid.dims, base, grid.info);
        if (!grid.dead_cells.empty()) {
            out_.left_out.resize(first_cell_, 0);
            out_.left_out.insert(out_.left_out.end(), grid.dead_cells.begin(), grid.dead_cells.end());
            const auto dead = static_cast<std::uint64_t>(std::ranges::count_if(grid.dead_cells, [](std::uint8_t d) { return d != 0; }));
            if (dead > 0) losses_.push_back({LossClass::identity, grid.info.name, "blanked cells", "MSH holds no blanked cells", dead});
        }
        lose(LossClass::identity, grid.info, "the order of the lattice (i, j, k)", "MSH cells have no lattice");
        if (!grid.splits.empty())
            lose(LossClass::substance, grid.info, "nodes split at faults", "the lattice is written with its common nodes",
                 grid.splits.size());
        if (!grid.face_sets.empty())
            lose(LossClass::substance, grid.info, "sets of faces", "MSH has no faces of cells", grid.face_sets.size());
        end(grid.info);
    }

    void add(const Raster& raster) {
        begin(raster.info);
        std::vector<Vec3> points(sample_count(raster.dims));
        std::size_t at = 0;
        for (std::uint32_t k = 0; k < raster.dims[2]; ++k) {
            for (std::uint32_t j = 0; j < raster.dims[1]; ++j) {
                for (std::uint32_t i = 0; i < raster.dims[0]; ++i) points[at++] = sample_position(raster, i, j, k);
            }
        }
        std::vector<std::uint8_t> missing;
        if (raster.height_attribute < raster.info.attributes.size())
            missing = raise(points, raster.info.attributes[raster.height_attribute]);
        const std::uint32_t base = add_points(points);
        add_lattice(raster.dims, base, raster.info);
        leave_out_cells_on(missing, base);
        lose(LossClass::identity, raster.info, "the lattice of the raster", "it is written as cells between its samples");
        end(raster.info);
    }

    void add(const Well& well) {
        begin(well.info);
        const std::uint32_t base = add_points(well.path);
        const std::uint32_t entity = new_entity(1, well.info);
        for (std::uint32_t i = 0; i + 1 < well.path.size(); ++i) add_cell(CellType::line, std::array{base + i, base + i + 1}, entity);
        if (well.path.empty()) lose(LossClass::substance, well.info, "the head of the well", "a well without a path makes no line");
        if (!well.measured_depth.empty()) lose(LossClass::substance, well.info, "measured depths", "MSH holds lines only");
        if (!well.markers.empty()) lose(LossClass::substance, well.info, "markers", "MSH holds no wells", well.markers.size());
        if (!well.zones.empty()) lose(LossClass::substance, well.info, "zones", "MSH holds no wells", well.zones.size());
        if (!well.curves.empty()) lose(LossClass::substance, well.info, "logs", "MSH holds no wells", well.curves.size());
        end(well.info);
    }

    void add(const CornerPointGrid& grid) { lose(LossClass::substance, grid.info, "the corner-point grid", "MSH holds its cells only"); }

    Combined finish() {
        if (!out_.left_out.empty()) out_.left_out.resize(out_.mesh.cell_count(), 0);
        if (!out_.left_out_points.empty()) out_.left_out_points.resize(out_.mesh.points.size(), 0);
        merge_attributes();
        return std::move(out_);
    }

private:
    void begin(const ObjectInfo& info) {
        first_point_ = out_.mesh.points.size();
        first_cell_ = out_.mesh.cell_count();
        if (info.crs.stated && !out_.mesh.info.crs.stated) out_.mesh.info.crs = info.crs;
    }

    void end(const ObjectInfo& info) {
        const std::size_t points = out_.mesh.points.size() - first_point_;
        const std::size_t cells = out_.mesh.cell_count() - first_cell_;
        for (const Attribute& a : info.attributes) {
            const bool on_points = a.location == AttributeLocation::point;
            const std::size_t things = on_points ? points : cells;
            const bool fits = a.location != AttributeLocation::object && a.location != AttributeLocation::pillar &&
                              value_count(a) == things * a.components;
            if (!fits) {
                lose(LossClass::identity, info, "property '" + a.name + "' of the whole object",
                     "MSH holds properties of nodes and elements");
                continue;
            }
            shares_[{a.name, on_points, a.components}].push_back({&a, on_points ? first_point_ : first_cell_, things});
        }
        if (!info.sets.empty())
            lose(LossClass::identity, info, "sets of points or cells", "MSH groups hold whole entities", info.sets.size());
        if (!info.annotations.empty())
            lose(LossClass::style, info, "header lines", "several objects become one mesh", info.annotations.size());
        if (!info.groups.empty()) lose(LossClass::style, info, "groups of objects", "several objects become one mesh", info.groups.size());
    }

    void lose(LossClass loss_class, const ObjectInfo& info, std::string what, std::string why, std::uint64_t count = 1) {
        losses_.push_back({loss_class, info.name, std::move(what), std::move(why), count});
    }

    std::uint32_t add_points(const std::vector<Vec3>& points) {
        const auto base = static_cast<std::uint32_t>(out_.mesh.points.size());
        out_.mesh.points.insert(out_.mesh.points.end(), points.begin(), points.end());
        return base;
    }

    void add_cell(CellType type, std::span<const std::uint32_t> nodes, std::uint32_t entity) {
        out_.mesh.add_cell(type, nodes);
        out_.mesh.cell_entity.push_back(entity);
    }

    std::int64_t free_tag(int d, std::int64_t wanted) {
        std::set<std::int64_t>& used = used_tags_[static_cast<std::size_t>(d)];
        std::int64_t& next = next_tag_[static_cast<std::size_t>(d)];
        std::int64_t tag = wanted;
        if (tag < 1 || used.contains(tag)) {
            while (used.contains(next)) ++next;
            tag = next;
        }
        used.insert(tag);
        return tag;
    }

    std::uint32_t new_entity(int d, const ObjectInfo& info) {
        CellMesh::Entity entity;
        entity.dimension = d;
        entity.tag = free_tag(d, 0);
        entity.name = info.name;
        entity.role = info.role;
        entity.role_text = info.role_text;
        out_.mesh.entities.push_back(std::move(entity));
        return static_cast<std::uint32_t>(out_.mesh.entities.size() - 1);
    }

    // Tags that another object uses already give way, and boundaries with them.
    std::vector<std::uint32_t> take_entities(const CellMesh& mesh) {
        std::map<std::pair<int, std::int64_t>, std::int64_t> renamed;
        std::vector<std::uint32_t> index;
        const auto group_base = static_cast<std::uint32_t>(out_.mesh.groups.size());
        out_.mesh.groups.insert(out_.mesh.groups.end(), mesh.groups.begin(), mesh.groups.end());
        for (const CellMesh::Entity& e : mesh.entities) {
            CellMesh::Entity copy = e;
            copy.tag = free_tag(e.dimension, e.tag);
            renamed.try_emplace({e.dimension, e.tag}, copy.tag);
            for (std::uint32_t& g : copy.groups) g += group_base;
            index.push_back(static_cast<std::uint32_t>(out_.mesh.entities.size()));
            out_.mesh.entities.push_back(std::move(copy));
        }
        for (const std::uint32_t i : index) {
            CellMesh::Entity& e = out_.mesh.entities[i];
            for (std::int64_t& tag : e.boundary) {
                const auto at = renamed.find({e.dimension - 1, tag < 0 ? -tag : tag});
                if (at != renamed.end()) tag = tag < 0 ? -at->second : at->second;
            }
        }
        return index;
    }

    void add_lattice(const std::array<std::uint32_t, 3>& dims, std::uint32_t base, const ObjectInfo& info) {
        std::vector<std::size_t> axes;
        for (std::size_t a = 0; a < 3; ++a) {
            if (dims[a] > 1) axes.push_back(a);
        }
        constexpr std::array<CellType, 4> types = {CellType::vertex, CellType::line, CellType::quad, CellType::hexahedron};
        const std::array<std::uint32_t, 3> stride{1, dims[0], dims[0] * dims[1]};
        const std::uint32_t entity = new_entity(static_cast<int>(axes.size()), info);
        std::array<std::uint32_t, 3> cells{};
        for (std::size_t a = 0; a < 3; ++a) cells[a] = std::max(dims[a], 2u) - 1;
        std::array<std::uint32_t, 8> offset{};
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            // Corners go around the bottom, then around the top.
            const std::array<std::uint32_t, 3> step{(corner & 1u) ^ ((corner >> 1) & 1u), (corner >> 1) & 1u, corner >> 2};
            for (std::size_t k = 0; k < axes.size(); ++k) offset[corner] += step[k] * stride[axes[k]];
        }
        const std::size_t corners = std::size_t{1} << axes.size();
        std::array<std::uint32_t, 8> nodes{};
        for (std::uint32_t k = 0; k < cells[2]; ++k) {
            for (std::uint32_t j = 0; j < cells[1]; ++j) {
                for (std::uint32_t i = 0; i < cells[0]; ++i) {
                    const std::uint32_t first = base + i * stride[0] + j * stride[1] + k * stride[2];
                    for (std::size_t c = 0; c < corners; ++c) nodes[c] = first + offset[c];
                    add_cell(types[axes.size()], {nodes.data(), corners}, entity);
                }
            }
        }
    }

    // Samples of a horizon grid stand at their heights; those without one are told.
    static std::vector<std::uint8_t> raise(std::vector<Vec3>& points, const Attribute& height) {
        std::vector<std::uint8_t> missing(points.size(), 0);
        for (std::size_t i = 0; i < points.size() && i < value_count(height); ++i) {
            const double z = value_as_double(height, i);
            if (std::isfinite(z) && !is_no_data(height, z)) points[i][2] = z;
            else missing[i] = 1;
        }
        return missing;
    }

    void leave_out_cells_on(const std::vector<std::uint8_t>& missing, std::uint32_t base) {
        if (std::ranges::find(missing, std::uint8_t{1}) == missing.end()) return;
        const CellMesh& mesh = out_.mesh;
        out_.left_out.resize(mesh.cell_count(), 0);
        for (std::size_t cell = first_cell_; cell < mesh.cell_count(); ++cell) {
            for (const std::uint32_t node : mesh.cell_nodes(cell)) out_.left_out[cell] |= missing[node - base];
        }
        out_.left_out_points.resize(base, 0);
        out_.left_out_points.insert(out_.left_out_points.end(), missing.begin(), missing.end());
    }

    void merge_attributes() {
        for (const auto& [key, shares] : shares_) {
            const auto& [name, on_points, components] = key;
            const std::size_t things = on_points ? out_.mesh.points.size() : out_.mesh.cell_count();
            if (std::holds_alternative<std::vector<std::string>>(shares.front().attribute->values)) {
                losses_.push_back({LossClass::substance, name, "property of texts", "MSH holds numbers only", 1});
                continue;
            }
            Attribute merged = without_values(*shares.front().attribute);
            merged.location = on_points ? AttributeLocation::point : AttributeLocation::cell;
            std::size_t covered = 0;
            for (const Share& share : shares) {
                covered += share.count;
                if (!merged.no_data) merged.no_data = share.attribute->no_data;
            }
            if (covered < things && !merged.no_data) merged.no_data = std::numeric_limits<double>::lowest();
            std::vector<double> values(things * components, merged.no_data.value_or(0));
            for (const Share& share : shares) fill(values, share, merged);
            merged.values = std::move(values);
            out_.mesh.info.attributes.push_back(std::move(merged));
        }
    }

    void fill(std::vector<double>& values, const Share& share, const Attribute& merged) {
        const Attribute& a = *share.attribute;
        const std::size_t n = a.components;
        const bool text = std::holds_alternative<std::vector<std::string>>(a.values);
        if (text) losses_.push_back({LossClass::substance, a.name, "property of texts", "MSH holds numbers only", 1});
        if (a.unit != merged.unit)
            losses_.push_back({LossClass::identity, a.name, "unit '" + a.unit + "'", "objects give the property different units", 1});
        const bool other_no_data = a.no_data && a.no_data != merged.no_data;
        for (std::size_t i = 0; i < share.count * n && !text; ++i) {
            const double v = value_as_double(a, i);
            values[share.first * n + i] = other_no_data && v == *a.no_data ? merged.no_data.value_or(*a.no_data) : v;
        }
    }

    std::vector<Loss>& losses_;
    Combined out_;
    std::size_t first_point_ = 0, first_cell_ = 0;
    std::array<std::set<std::int64_t>, 4> used_tags_;
    std::array<std::int64_t, 4> next_tag_{1, 1, 1, 1};
    std::map<std::tuple<std::string, bool, std::uint32_t>, std::vector<Share>> shares_;
};

}  // namespace

Combined combine(const Dataset& dataset, std::vector<Loss>& losses) {
    Combiner combiner(losses);
    for (const Object& object : dataset.objects) std::visit([&](const auto& o) { combiner.add(o); }, object);
    Combined result = combiner.finish();
    if (!dataset.objects.empty()) {
        const ObjectInfo& first = info_of(dataset.objects.front());
        result.mesh.info.crs = result.mesh.info.crs.stated ? result.mesh.info.crs : first.crs;
        if (dataset.objects.size() == 1) {
            result.mesh.info.name = first.name;
            result.mesh.info.feature = first.feature;
            result.mesh.info.role = first.role;
            result.mesh.info.role_text = first.role_text;
        }
    }
    return result;
}

}  // namespace geomend::gmsh
