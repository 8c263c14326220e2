// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <unordered_map>

#include "base/codes.h"
#include "formats/drop.h"
#include "formats/ringmesh/archive.h"
#include "model/attribute_operations.h"

namespace geomend::ringmesh {

namespace {

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::size_t seed = 0;
        for (const double x : p) seed = seed * 0x9e3779b97f4a7c15u + std::hash<double>()(x);
        return seed;
    }
};

class CellBuilder {
public:
    CellBuilder(GmArchive archive, Dataset& data) : archive_(std::move(archive)), data_(data) {}

    void run() {
        mesh_.info.name = archive_.text.model;
        add_regions();
        const std::vector<std::uint32_t> face_of_surface = add_surfaces();
        fill_attributes();
        StatedModel& model = data_.models.front();
        state_regions(archive_, face_of_surface, model, data_);
        if (welded_ > 0)
            data_.findings.push_back(make_finding(
                "F111", std::to_string(welded_) + " points at positions of others were welded at zero distance", {archive_.name}, welded_));
        data_.objects.emplace_back(std::move(mesh_));
        // Points and cells of the mesh come first among the objects, whatever is beside it.
        keep_lines_and_corners(archive_, data_);
    }

private:
    /// An attribute of one region: where its values go.
    struct Piece {
        Attribute attribute;
        std::vector<std::uint32_t> points;  ///< of the mesh, per point of the region
        std::size_t first_cell = 0, cells = 0;
    };

    GmArchive archive_;
    Dataset& data_;
    CellMesh mesh_;
    std::unordered_map<Vec3, std::uint32_t, PositionHash> point_at_;
    std::vector<Piece> pieces_;
    std::uint64_t welded_ = 0;

    std::vector<std::uint32_t> add_points(const GeogramMesh& mesh) {
        std::vector<std::uint32_t> to;
        to.reserve(mesh.points.size());
        for (const Vec3& p : mesh.points) {
            const auto [at, is_new] = point_at_.try_emplace(p, static_cast<std::uint32_t>(mesh_.points.size()));
            if (is_new) mesh_.points.push_back(p);
            else ++welded_;
            to.push_back(at->second);
        }
        if (mesh.precision == CoordinatePrecision::single_precision) mesh_.info.precision = mesh.precision;
        return to;
    }

    void add(CellType type, std::span<const std::uint32_t> corners, const std::vector<std::uint32_t>& points) {
        std::array<std::uint32_t, 8> few{};
        std::vector<std::uint32_t> many;
        std::span<std::uint32_t> cell(few.data(), std::min(corners.size(), few.size()));
        if (corners.size() > few.size()) {
            many.resize(corners.size());
            cell = many;
        }
        std::ranges::transform(corners, cell.begin(), [&](std::uint32_t c) { return points[c]; });
        mesh_.add_cell(type, cell);
        mesh_.cell_entity.push_back(static_cast<std::uint32_t>(mesh_.entities.size() - 1));
    }

    void add_regions() {
        const auto& regions = archive_.text.entities[EntityText::region];
        for (std::size_t r = 0; r < regions.size(); ++r) {
            CellMesh::Entity& entity = mesh_.entities.emplace_back();
            entity.dimension = 3;
            entity.tag = static_cast<std::int64_t>(r) + 1;
            entity.name = name_or_number(regions[r], EntityText::region, r);
            for (const EntityText::Bound& b : regions[r].bounds) {
                const auto tag = static_cast<std::int64_t>(b.number) + 1;
                entity.boundary.push_back(b.positive ? tag : -tag);
            }
            const auto& mesh = archive_.meshes[EntityText::region][r];
            if (!mesh) continue;
            const std::vector<std::uint32_t> points = add_points(*mesh);
            const std::size_t first = mesh_.cell_count();
            for (std::size_t c = 0; c < mesh->cell_types.size(); ++c) {
                const std::uint64_t begin = mesh->cell_offsets[c];
                add(mesh->cell_types[c], std::span(mesh->cell_nodes).subspan(begin, mesh->cell_offsets[c + 1] - begin), points);
            }
            for (const Attribute& a : mesh->attributes) pieces_.push_back({a, points, first, mesh->cell_types.size()});
        }
    }

    std::vector<std::uint32_t> add_surfaces() {
        StatedModel& model = data_.models.emplace_back();
        const auto& surfaces = archive_.text.entities[EntityText::surface];
        std::vector<std::uint32_t> face_of_surface(surfaces.size(), no_index);
        for (const Interface& one : interfaces_of(archive_, data_)) {
            for (const std::uint32_t s : one.surfaces) {
                CellMesh::Entity& entity = mesh_.entities.emplace_back();
                entity.dimension = 2;
                entity.tag = std::int64_t{s} + 1;
                entity.name = one.name;
                entity.role_text = one.feature;
                entity.role = feature_role(one.feature);
                StatedModel::Face& face = model.faces.emplace_back();
                face_of_surface[s] = static_cast<std::uint32_t>(model.faces.size() - 1);
                face.number = entity.tag;
                face.object = 0;
                face.part = static_cast<std::uint32_t>(mesh_.entities.size() - 1);
                face.interface_name = one.name;
                face.role = entity.role;
                face.role_text = entity.role_text;
                face.line = surfaces[s].line;
                add_facets(*archive_.meshes[EntityText::surface][s]);
            }
        }
        return face_of_surface;
    }

    void add_facets(const GeogramMesh& mesh) {
        const std::vector<std::uint32_t> points = add_points(mesh);
        for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
            const auto corners = mesh.facets[f];
            add(corners.size() == 3 ? CellType::triangle : corners.size() == 4 ? CellType::quad : CellType::polygon, corners, points);
        }
        for (const Attribute& a : mesh.attributes)
            drop(data_.findings, data_.losses,
                 {.what = "attribute '" + a.name + "' of surfaces", .why = "the model is filled with cells, whose attributes are kept"});
    }

    /// Attributes of regions become attributes of the mesh: missing where a region has none.
    void fill_attributes() {
        for (const Piece& piece : pieces_) {
            const Attribute& a = piece.attribute;
            const bool on_points = a.location == AttributeLocation::point;
            if (!on_points && a.location != AttributeLocation::cell) {
                drop(data_.findings, data_.losses,
                     {.what = "attribute '" + a.name + "' of regions", .why = "it stands neither on points nor on cells"});
                continue;
            }
            Attribute& to = attribute_like(a);
            if (to.components != a.components || to.values.index() != a.values.index()) {
                drop(data_.findings, data_.losses,
                     {.what = "attribute '" + a.name + "' of regions", .why = "the regions have it with several types"});
                continue;
            }
            const std::size_t things = on_points ? piece.points.size() : piece.cells;
            std::visit(
                [&]<class Values>(const Values& values) {
                    Values& all = std::get<Values>(to.values);
                    for (std::size_t i = 0; i < things; ++i) {
                        const std::size_t row = on_points ? piece.points[i] : piece.first_cell + i;
                        for (std::size_t k = 0; k < a.components; ++k) all[row * a.components + k] = values[i * a.components + k];
                    }
                },
                a.values);
        }
    }

    Attribute& attribute_like(const Attribute& a) {
        auto& all = mesh_.info.attributes;
        const auto same = std::ranges::find_if(all, [&](const Attribute& b) { return b.name == a.name && b.location == a.location; });
        if (same != all.end()) return *same;
        Attribute& added = all.emplace_back(without_values(a));
        added.values = taken(a.values, {}, a.components);
        resize_with_missing(added, a.location == AttributeLocation::point ? mesh_.points.size() : mesh_.cell_count());
        return added;
    }
};

}  // namespace

void build_from_cells(GmArchive archive, Dataset& data) { CellBuilder(std::move(archive), data).run(); }

}  // namespace geomend::ringmesh
