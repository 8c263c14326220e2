// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/brep_from_dataset.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/parallel.h"
#include "topology/cell_regions.h"
#include "topology/cut_nodes.h"
#include "topology/face_volume.h"
#include "topology/faces_from_mesh.h"
#include "topology/faces_from_surfaces.h"
#include "topology/geology.h"
#include "topology/keys.h"
#include "topology/near_weld.h"
#include "topology/pieces.h"
#include "topology/regions.h"
#include "topology/weld.h"
#include "topology/winding.h"

namespace geomend::topology {

namespace {

constexpr std::size_t most_elements = 100;

/// Builds one boundary representation over some objects of a Dataset.
class ModelBuilder {
public:
    /// \param model the file's claims; null for a mesh whose entities say it all
    /// \param mesh_object the mesh that a null `model` is about
    /// \param tolerance nearer points are one vertex; 0: equal ones only
    ModelBuilder(const Dataset& dataset, const StatedModel* model, std::uint32_t mesh_object, double tolerance)
        : dataset_(dataset), model_(model), welder_(0), mesh_object_(mesh_object), tolerance_(tolerance) {
        choose_objects();
    }
    /// \param loose surfaces that belong to no model
    ModelBuilder(const Dataset& dataset, std::vector<std::uint32_t> loose, double tolerance)
        : dataset_(dataset), model_(nullptr), objects_(std::move(loose)), welder_(0), tolerance_(tolerance), loose_(true) {
        for (const std::uint32_t o : objects_) {
            const auto& info = info_of(dataset_.objects[o]);
            const auto parts = static_cast<std::uint32_t>(part_count(std::get<Surface>(dataset_.objects[o])));
            for (std::uint32_t part = 0; part < parts; ++part) faces_.push_back({o, part, info.name, {}, info.role, info.role_text});
        }
    }

    /// False when nothing is there to build from.
    bool worthwhile() const { return !faces_.empty() || has_volume_entities(); }
    Result<Brep> build();
    /// The same with what checks need besides.
    Result<JudgedModel> build_to_judge();
    std::vector<Finding>& findings() { return a_.findings; }

private:
    struct Face {
        std::uint32_t object, part;
        std::string interface_name, name;
        FeatureRole role;
        std::string role_text;
        const std::optional<std::array<Vec3, 3>>* key = nullptr;
        std::uint32_t stated = no_index;  // index into model_->faces
    };

    const CellMesh* mesh_of(std::uint32_t object) const { return std::get_if<CellMesh>(&dataset_.objects[object]); }
    bool has_volume_entities() const;
    bool has_volume_cells() const;
    void choose_objects();
    void choose_mesh_faces();
    void weld();
    void weld_points(std::uint32_t object, const std::vector<Vec3>& points, const std::vector<std::uint32_t>& alias);
    void weld_near();
    std::uint32_t vertex_at(const Vec3& position) const;
    void assemble();
    void make_surfaces();
    void tell_soups(const std::vector<std::uint8_t>& joined);
    void make_interfaces();
    void take_apart();
    void join_polygons();
    bool turn_over();
    void make_lines_anew();
    void make_lines();
    void name_corners();
    StatedLines stated() const;
    std::vector<std::uint8_t> reversed_keys();
    void make_regions();
    void regions_from_lists();
    std::vector<StatedRegion> stated_lists();
    void regions_from_mesh();
    void check_model_regions(const std::vector<RegionId>& region_of_entity);
    std::vector<StatedRegion> boundary_lists(const std::vector<std::uint32_t>& entities) const;
    void fill_hollow_regions();
    void make_lists(const std::vector<RegionId>& ids);
    void report_once(const char* code, std::string message, const std::vector<std::uint32_t>& surfaces);

    const Dataset& dataset_;
    const StatedModel* model_;
    std::vector<std::uint32_t> objects_;  // whose points are welded, ascending
    std::vector<Face> faces_;
    Welder welder_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> vertex_of_;  // per object, per point
    std::uint64_t points_ = 0, aliases_ = 0;
    std::uint32_t mesh_object_ = no_index;  // whose cells fill the regions
    std::vector<std::vector<std::uint32_t>> entity_cells_;
    std::optional<Twins> twins_;              // as the mesh states them
    std::vector<std::uint8_t> key_reversed_;  // per face
    double tolerance_ = 0;
    bool loose_ = false;
    std::vector<std::uint32_t> near_;  // per position of welder_ the vertex that stands for it; empty: itself
    std::uint64_t points_welded_ = 0;
    std::vector<Vec3> welded_positions_;
    std::vector<std::vector<std::uint32_t>> source_polygons_;
    std::vector<std::vector<std::uint32_t>> turned_polygons_;
    Assembly a_;
};

/// True for polygons that share next to no points, although more than a quarter are at positions of others, as STL files have it.
bool is_soup(const BrepData::Surface& surface) {
    const std::size_t corners = surface.polygons.corners.size();
    if (surface.polygons.size() < 2 || 10 * surface.nodes.size() < 9 * corners) return false;
    std::vector<VertexId> vertices = surface.nodes;
    std::sort(vertices.begin(), vertices.end());
    const auto distinct = static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    return 4 * distinct < 3 * surface.nodes.size();  // two triangles side by side have four positions
}

/// One node for each vertex; attributes go, since they may differ.
void join_nodes(BrepData::Surface& surface) {
    std::vector<VertexId> nodes = surface.nodes;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (std::uint32_t& corner : surface.polygons.corners) {
        corner = static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), surface.nodes[corner]) - nodes.begin());
    }
    surface.nodes = std::move(nodes);
    surface.attributes.clear();
}

std::string entity_name(const CellMesh& mesh, const CellMesh::Entity& e, const char* kind) {
    if (!e.name.empty()) return e.name;
    for (const std::uint32_t g : e.groups) {
        if (g < mesh.groups.size() && !mesh.groups[g].name.empty()) return mesh.groups[g].name;
    }
    return std::string(kind) + "_" + std::to_string(e.tag);
}

bool ModelBuilder::has_volume_entities() const {
    if (mesh_object_ == no_index) return false;
    const auto& entities = mesh_of(mesh_object_)->entities;
    return std::any_of(entities.begin(), entities.end(), [](const auto& e) { return e.dimension == 3; });
}

bool ModelBuilder::has_volume_cells() const {
    if (mesh_object_ == no_index) return false;
    const auto& entities = mesh_of(mesh_object_)->entities;
    for (std::size_t e = 0; e < entities.size(); ++e) {
        if (entities[e].dimension == 3 && !entity_cells_[e].empty()) return true;
    }
    return false;
}

void ModelBuilder::choose_mesh_faces() {
    const CellMesh& mesh = *mesh_of(mesh_object_);
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        const auto& entity = mesh.entities[e];
        if (entity.dimension != 2 || entity_cells_[e].empty()) continue;
        faces_.push_back({mesh_object_, e, entity_name(mesh, entity, "Surface"), {}, entity.role, entity.role_text});
    }
}

void ModelBuilder::choose_objects() {
    if (model_ != nullptr) {
        for (std::uint32_t f = 0; f < model_->faces.size(); ++f) {
            const auto& face = model_->faces[f];
            if (face.object >= dataset_.objects.size()) continue;
            const Object& object = dataset_.objects[face.object];
            if (const auto* surface = std::get_if<Surface>(&object)) {
                if (face.part >= part_count(*surface)) continue;
            } else if (const auto* mesh = std::get_if<CellMesh>(&object)) {
                if (face.part >= mesh->entities.size()) continue;
                mesh_object_ = face.object;
            } else {
                continue;
            }
            objects_.push_back(face.object);
            const auto& info = info_of(object);
            const bool own_role = face.role != FeatureRole::unknown || !face.role_text.empty();
            faces_.push_back({face.object, face.part, face.interface_name.empty() ? info.name : face.interface_name, face.name,
                              own_role ? face.role : info.role, own_role ? face.role_text : info.role_text, &face.key, f});
        }
        // Unnamed entities of meshes (MSH with a section of ours) fill the regions of the model that lists them.
        for (std::uint32_t o = 0; o < dataset_.objects.size(); ++o) {
            const CellMesh* mesh = mesh_of(o);
            if (mesh == nullptr || !mesh->entities.empty()) continue;
            for (const auto& region : model_->regions) {
                if (!region.universe && !region.name.empty() && region.name == mesh->info.name) {
                    objects_.push_back(o);
                    break;
                }
            }
        }
    } else {
        objects_.push_back(mesh_object_);
    }
    std::sort(objects_.begin(), objects_.end());
    objects_.erase(std::unique(objects_.begin(), objects_.end()), objects_.end());
    if (mesh_object_ != no_index) {
        entity_cells_ = cells_by_entity(*mesh_of(mesh_object_));
        twins_ = stated_twins(*mesh_of(mesh_object_));
    }
    if (model_ == nullptr) choose_mesh_faces();
}

void ModelBuilder::weld_points(std::uint32_t object, const std::vector<Vec3>& points, const std::vector<std::uint32_t>& alias) {
    auto& vertices = vertex_of_[object];
    vertices.reserve(points.size());
    for (const Vec3& p : points) vertices.push_back(welder_.add(p));
    points_ += points.size();
    aliases_ += static_cast<std::uint64_t>(std::count_if(alias.begin(), alias.end(), [](std::uint32_t a) { return a != no_index; }));
}

void ModelBuilder::weld() {
    std::size_t total = 0;
    for (const std::uint32_t o : objects_) {
        const CellMesh* mesh = mesh_of(o);
        total += mesh != nullptr ? mesh->points.size() : std::get<Surface>(dataset_.objects[o]).points.size();
    }
    welder_ = Welder(total);
    for (const std::uint32_t o : objects_) {
        if (const CellMesh* mesh = mesh_of(o)) {
            weld_points(o, mesh->points, mesh->alias);
        } else {
            const auto& surface = std::get<Surface>(dataset_.objects[o]);
            weld_points(o, surface.points, surface.alias);
        }
    }
    weld_near();
    const std::uint64_t welded = points_ - welder_.positions().size();
    if (welded == 0 || loose_) return;
    Finding finding;
    finding.code = "F111";
    finding.severity = Severity::info;
    finding.message = std::to_string(welded) + " points at positions of others were welded at zero distance";
    if (aliases_ > 0) finding.message += " (" + std::to_string(aliases_) + " of them are stated as such)";
    if (!a_.brep.name.empty()) finding.entities.push_back({"model", a_.brep.name, -1});
    finding.count = welded;
    finding.element_kind = "point";
    a_.findings.push_back(std::move(finding));
}

/// Gives vertices that are nearer than the tolerance to others the number of the first of them.
void ModelBuilder::weld_near() {
    if (tolerance_ <= 0) return;
    near_ = clusters_within(welder_.positions(), tolerance_);
    for (std::uint32_t v = 0; v < near_.size(); ++v) {
        if (near_[v] == v) continue;
        ++points_welded_;
        if (welded_positions_.size() < most_elements) welded_positions_.push_back(welder_.positions()[v]);
    }
    if (points_welded_ == 0) {
        near_.clear();
        return;
    }
    for (auto& [object, vertices] : vertex_of_) {
        for (std::uint32_t& v : vertices) v = near_[v];
    }
}

/// The vertex at a position, or no_index.
std::uint32_t ModelBuilder::vertex_at(const Vec3& position) const {
    const std::uint32_t v = welder_.find(position);
    return v == no_index || near_.empty() ? v : near_[v];
}

/// Loose surfaces: a surface for each piece that hangs together between lines, all of it wound one way where that can be.
void ModelBuilder::take_apart() {
    std::vector<Face> faces;
    std::vector<BrepData::Surface> surfaces;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        for (auto& piece : pieces_of(a_.brep.surfaces[f], a_.faces[f])) {
            faces.push_back(faces_[f]);
            source_polygons_.push_back(std::move(piece.polygons));
            surfaces.push_back(std::move(piece.surface));
        }
    }
    const bool apart = surfaces.size() != faces_.size();
    if (apart) {
        faces_ = std::move(faces);
        a_.brep.surfaces = std::move(surfaces);
        join_polygons();
    } else {
        source_polygons_.clear();
    }
    if (turn_over() || apart) make_lines_anew();
}

void ModelBuilder::join_polygons() {
    a_.faces.resize(faces_.size());
    parallel_for_each_index(faces_.size(), [&](std::size_t f) { a_.faces[f] = connect_polygons(a_.brep.surfaces[f]); });
}

void ModelBuilder::make_lines_anew() {
    for (auto& surface : a_.brep.surfaces) surface.lines.clear();
    a_.brep.lines.clear();
    a_.brep.corners.clear();
    a_.graph = build_lines(a_.brep, a_.faces, stated());
}

/// Polygons of loose surfaces that are wound against their neighbours are turned over, so that each side is one side.
bool ModelBuilder::turn_over() {
    std::vector<Winding> winding(faces_.size());
    parallel_for_each_index(faces_.size(), [&](std::size_t f) { winding[f] = winding_of(a_.brep.surfaces[f]); });
    const auto wrong = [](const Winding& w) { return !w.one_sided && !w.wrong.empty(); };
    if (std::ranges::none_of(winding, wrong)) return false;
    turned_polygons_.resize(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        if (!wrong(winding[f])) continue;
        for (const std::uint32_t p : winding[f].wrong) turn_polygon(a_.brep.surfaces[f], p);
        turned_polygons_[f] = std::move(winding[f].wrong);
    }
    join_polygons();
    return true;
}

void ModelBuilder::make_surfaces() {
    auto& surfaces = a_.brep.surfaces;
    surfaces.resize(faces_.size());
    a_.faces.resize(faces_.size());
    const bool point_attributes_here = !has_volume_cells();  // else they are the regions' own
    std::vector<std::uint8_t> joined(faces_.size(), 0);
    parallel_for_each_index(faces_.size(), [&](std::size_t f) {
        const Face& face = faces_[f];
        const auto& vertex_of = vertex_of_.at(face.object);
        if (const CellMesh* mesh = mesh_of(face.object)) {
            surfaces[f] = surface_of_cells(*mesh, entity_cells_[face.part], vertex_of, mesh->entities[face.part].tag,
                                           twins_ ? &*twins_ : nullptr, point_attributes_here);
        } else {
            surfaces[f] = surface_of_part(std::get<Surface>(dataset_.objects[face.object]), face.part, vertex_of);
        }
        surfaces[f].name = face.name;
        surfaces[f].role = face.role;
        surfaces[f].role_text = face.role_text;
        surfaces[f].source_object = face.object;
        surfaces[f].source_part = face.part;
        if (loose_ && is_soup(surfaces[f])) {
            join_nodes(surfaces[f]);
            joined[f] = 1;
        }
        a_.faces[f] = connect_polygons(surfaces[f]);
    });
    tell_soups(joined);
}

/// Names the surfaces whose polygons had points of their own.
void ModelBuilder::tell_soups(const std::vector<std::uint8_t>& joined) {
    for (std::uint32_t f = 0; f < joined.size(); ++f) {
        if (joined[f] == 0) continue;
        Finding finding;
        finding.code = "M08";
        finding.severity = Severity::warning;
        finding.message =
            "the triangles of '" + faces_[f].interface_name + "' have points of their own: judged as joined where points are equal";
        finding.entities.push_back({"interface", faces_[f].interface_name, -1});
        finding.count = a_.brep.surfaces[f].polygons.size();
        finding.element_kind = "triangle";
        a_.findings.push_back(std::move(finding));
    }
}

void ModelBuilder::make_interfaces() {
    InterfaceBook book(a_.brep);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        auto& interface = book.enter(SurfaceId(f), faces_[f].interface_name);
        const auto& info = info_of(dataset_.objects[faces_[f].object]);
        if (interface.surfaces.size() > 1 || mesh_of(faces_[f].object) != nullptr) continue;
        interface.feature = info.feature;
        interface.annotations = info.annotations;
    }
    if (model_ != nullptr) {
        for (const auto& said : model_->interfaces) {
            const auto found = std::ranges::find(a_.brep.interfaces, said.name, &BrepData::Interface::name);
            if (found == a_.brep.interfaces.end()) continue;
            found->feature = said.feature;
            found->annotations = said.annotations;
        }
    }
    name_surfaces(a_.brep);
}

StatedLines ModelBuilder::stated() const {
    StatedLines lines;
    if (mesh_object_ != no_index) lines = stated_lines(*mesh_of(mesh_object_), entity_cells_, vertex_of_.at(mesh_object_));
    if (twins_) lines.shared_nodes = false;
    if (loose_) lines.shared_nodes = true;  // a fault that ends inside a horizon seldom cuts it there
    for (const std::uint32_t o : objects_) {
        const auto* surface = std::get_if<Surface>(&dataset_.objects[o]);
        if (surface == nullptr) continue;
        for (const std::uint32_t point : surface->border_corners) {
            if (point < surface->points.size()) lines.corner_hints.push_back(vertex_of_.at(o)[point]);
        }
    }
    if (model_ == nullptr) return lines;
    for (const auto& corner : model_->corners) {
        const std::uint32_t v = vertex_at(corner.position);
        if (v != no_index) lines.corners.push_back(v);
    }
    return lines;
}

void ModelBuilder::make_lines() {
    a_.graph = build_lines(a_.brep, a_.faces, stated());
    name_corners();
    if (mesh_object_ == no_index) return;
    if (!twins_) {
        for (auto& surface : a_.brep.surfaces) split_nodes_along_cuts(a_.brep, surface);
    }
    const CellMesh& mesh = *mesh_of(mesh_object_);
    for (std::size_t l = 0; l < a_.brep.lines.size(); ++l) {
        if (a_.graph.stated_line[l] != no_index) a_.brep.lines[l].name = mesh.entities[a_.graph.stated_line[l]].name;
    }
}

void ModelBuilder::name_corners() {
    std::map<std::uint32_t, std::string> names;
    if (model_ != nullptr) {
        for (const auto& corner : model_->corners) names.emplace(vertex_at(corner.position), corner.name);
    }
    if (mesh_object_ != no_index) {
        const CellMesh& mesh = *mesh_of(mesh_object_);
        for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
            if (mesh.entities[e].dimension != 0 || mesh.entities[e].name.empty()) continue;
            for (const std::uint32_t c : entity_cells_[e]) {
                for (const std::uint32_t p : mesh.cell_nodes(c)) names.emplace(vertex_of_.at(mesh_object_)[p], mesh.entities[e].name);
            }
        }
    }
    for (auto& corner : a_.brep.corners) {
        if (const auto found = names.find(corner.vertex.value); found != names.end()) corner.name = found->second;
    }
}

void ModelBuilder::report_once(const char* code, std::string message, const std::vector<std::uint32_t>& surfaces) {
    if (surfaces.empty()) return;
    const auto same = [&](const Finding& f) { return f.code == code; };
    if (std::any_of(dataset_.findings.begin(), dataset_.findings.end(), same)) return;  // the reader has seen it
    Finding finding;
    finding.code = code;
    finding.severity = Severity::warning;
    finding.message = std::to_string(surfaces.size()) + std::move(message);
    finding.count = surfaces.size();
    finding.element_kind = "surface";
    for (std::size_t i = 0; i < surfaces.size() && i < most_elements; ++i) {
        finding.entities.push_back({"surface", a_.brep.surfaces[surfaces[i]].name, surfaces[i]});
        finding.elements.push_back(model_ != nullptr ? model_->faces[faces_[surfaces[i]].stated].number : 0);
        finding.index.push_back(surfaces[i]);
    }
    a_.findings.push_back(std::move(finding));
}

std::vector<std::uint8_t> ModelBuilder::reversed_keys() {
    std::vector<KeyMatch> match(faces_.size(), KeyMatch::same);
    parallel_for_each_index(faces_.size(), [&](std::size_t f) {
        if (faces_[f].key == nullptr || !faces_[f].key->has_value()) return;
        const auto& key = **faces_[f].key;
        match[f] = match_key(a_.brep.surfaces[f], {vertex_at(key[0]), vertex_at(key[1]), vertex_at(key[2])});
    });
    std::vector<std::uint32_t> reversed, absent;
    std::vector<std::uint8_t> result(faces_.size(), 0);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        if (match[f] == KeyMatch::reversed) reversed.push_back(f);
        if (match[f] == KeyMatch::absent) absent.push_back(f);
        result[f] = match[f] == KeyMatch::reversed ? 1 : 0;
    }
    report_once("F106", " surfaces have a key triangle that is reversed against them", reversed);
    report_once("F116", " surfaces have a key triangle that is not among their triangles", absent);
    return result;
}

std::vector<StatedRegion> ModelBuilder::stated_lists() {
    std::vector<std::uint32_t> surface_of(model_->faces.size(), no_index);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) surface_of[faces_[f].stated] = f;
    std::vector<StatedRegion> lists;
    for (const auto& region : model_->regions) {
        StatedRegion list{region.name, region.universe, {}};
        for (const auto& side : region.sides) {
            const std::uint32_t s = side.face < surface_of.size() ? surface_of[side.face] : no_index;
            if (s != no_index) list.sides.push_back({SurfaceId(s), side.front != (key_reversed_[s] != 0)});
        }
        lists.push_back(std::move(list));
    }
    return lists;
}

void ModelBuilder::regions_from_lists() {
    const auto lists = stated_lists();
    make_lists(add_stated_regions(a_, lists));
}

/// Layers and fault blocks over the regions that there are.
void ModelBuilder::make_lists(const std::vector<RegionId>& ids) {
    std::vector<std::int64_t> missing;
    const auto resolve = [&](const std::vector<StatedModel::RegionList>& from, std::vector<BrepData::RegionList>& to) {
        for (const auto& list : from) {
            BrepData::RegionList resolved;
            resolved.name = list.name;
            resolved.unresolved = list.unresolved;
            for (const std::uint32_t r : list.regions) {
                if (r < ids.size() && ids[r].valid()) resolved.regions.push_back(ids[r]);
            }
            missing.insert(missing.end(), list.unresolved.begin(), list.unresolved.end());
            to.push_back(std::move(resolved));
        }
    };
    resolve(model_->layers, a_.brep.layers);
    resolve(model_->fault_blocks, a_.brep.fault_blocks);
    const auto told = [](const Finding& f) { return f.code == "F109"; };
    if (missing.empty() || std::any_of(dataset_.findings.begin(), dataset_.findings.end(), told)) return;
    Finding finding;
    finding.code = "F109";
    finding.severity = Severity::warning;
    finding.message = "layers or fault blocks list " + std::to_string(missing.size()) + " numbers without a region";
    finding.count = missing.size();
    finding.element_kind = "region";
    missing.resize(std::min(missing.size(), most_elements));
    finding.elements = std::move(missing);
    a_.findings.push_back(std::move(finding));
}

/// Sides of volume entities as their boundary lists state them.
std::vector<StatedRegion> ModelBuilder::boundary_lists(const std::vector<std::uint32_t>& entities) const {
    const CellMesh& mesh = *mesh_of(mesh_object_);
    std::map<std::int64_t, std::uint32_t> surface_of_tag;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        if (faces_[f].object == mesh_object_) surface_of_tag.emplace(mesh.entities[faces_[f].part].tag, f);
    }
    std::vector<StatedRegion> lists;
    for (const std::uint32_t e : entities) {
        StatedRegion list{entity_name(mesh, mesh.entities[e], "Region"), false, {}};
        for (const std::int64_t tag : mesh.entities[e].boundary) {
            const auto found = surface_of_tag.find(tag < 0 ? -tag : tag);
            if (found != surface_of_tag.end()) list.sides.push_back({SurfaceId(found->second), tag < 0});  // normals point outwards
        }
        lists.push_back(std::move(list));
    }
    return lists;
}

void ModelBuilder::regions_from_mesh() {
    const CellMesh& mesh = *mesh_of(mesh_object_);
    std::vector<std::uint32_t> filled, hollow;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension == 3) (entity_cells_[e].empty() ? hollow : filled).push_back(e);
    }
    std::vector<RegionId> region_of_entity(mesh.entities.size());
    const CellRegions maker(a_.brep, mesh, vertex_of_.at(mesh_object_));
    std::vector<CellRegion> made(filled.size());
    parallel_for_each_index(filled.size(), [&](std::size_t i) { made[i] = maker.make(entity_cells_[filled[i]]); });
    std::vector<SurfaceId> partial;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        region_of_entity[filled[i]] = RegionId(a_.brep.regions.size());
        made[i].region.name = entity_name(mesh, mesh.entities[filled[i]], "Region");
        made[i].region.source_object = mesh_object_;
        partial.insert(partial.end(), made[i].incomplete.begin(), made[i].incomplete.end());
        a_.brep.regions.push_back(std::move(made[i].region));
    }
    std::sort(partial.begin(), partial.end());
    partial.erase(std::unique(partial.begin(), partial.end()), partial.end());
    if (!partial.empty()) {
        Finding finding;
        finding.code = "F113";
        finding.severity = Severity::warning;
        finding.message = std::to_string(partial.size()) + " surfaces bound a region with a part of their polygons only";
        finding.count = partial.size();
        finding.element_kind = "surface";
        for (std::size_t i = 0; i < partial.size() && i < most_elements; ++i) {
            finding.entities.push_back({"surface", a_.brep.surfaces[partial[i].value].name, partial[i].value});
        }
        a_.findings.push_back(std::move(finding));
    }
    if (!hollow.empty()) {
        const auto ids = add_stated_regions(a_, boundary_lists(hollow));
        for (std::size_t i = 0; i < hollow.size(); ++i) region_of_entity[hollow[i]] = ids[i];
    }
    if (model_ != nullptr) check_model_regions(region_of_entity);
}

/// What a MODEL section says of regions (one side each, or whole lists) against the regions of the cells.
void ModelBuilder::check_model_regions(const std::vector<RegionId>& region_of_entity) {
    const CellMesh& mesh = *mesh_of(mesh_object_);
    std::multimap<std::string, RegionId> by_name;  // regions of one name are in the order of their statements
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
        if (region_of_entity[e].valid()) by_name.emplace(a_.brep.regions[region_of_entity[e].value].name, region_of_entity[e]);
    }
    std::vector<RegionId> ids;
    std::map<std::string, std::ptrdiff_t> seen;
    for (const auto& list : stated_lists()) {
        const auto [first, last] = by_name.equal_range(list.name);
        if (first == last) {
            ids.emplace_back();
            continue;
        }
        auto& taken = seen[list.name];
        const auto found = std::next(first, std::min(taken++, std::distance(first, last) - 1));
        ids.push_back(found->second);
        if (list.universe) continue;
        const auto& sides = a_.brep.regions[found->second.value].sides;
        for (const auto& side : list.sides) {
            const bool there =
                std::any_of(sides.begin(), sides.end(), [&](const auto& s) { return s.surface == side.surface && s.front == side.front; });
            if (there) continue;
            a_.findings.push_back(region_finding(a_.brep, "F113", list.name,
                                                 "region '" + list.name + "' is stated " + (side.front ? "in front of " : "behind ") +
                                                     a_.brep.surfaces[side.surface.value].name + ", but its cells are not there"));
            break;
        }
    }
    make_lists(ids);
}

/// Cells of meshes that bear the name of a region fill it.
void ModelBuilder::fill_hollow_regions() {
    for (const std::uint32_t o : objects_) {
        const CellMesh* mesh = mesh_of(o);
        if (mesh == nullptr || !mesh->entities.empty()) continue;
        std::vector<std::uint32_t> cells;
        for (std::uint32_t c = 0; c < mesh->cell_count(); ++c) {
            if (dimension(mesh->types[c]) == 3) cells.push_back(c);
        }
        for (auto& region : a_.brep.regions) {
            if (region.name != mesh->info.name || !region.cell_types.empty() || cells.empty()) continue;
            auto filling = CellRegions(a_.brep, *mesh, vertex_of_.at(o)).make(cells).region;
            filling.name = region.name;
            filling.sides = region.sides;
            filling.source_object = o;
            for (const Attribute& attribute : mesh->info.attributes) {
                if (attribute.location == AttributeLocation::object) filling.attributes.push_back(attribute);
            }
            region = std::move(filling);
            break;
        }
    }
}

void ModelBuilder::make_regions() {
    a_.cones = cone_volumes(a_.brep, a_.faces);
    key_reversed_ = reversed_keys();
    const bool listed = model_ != nullptr && !model_->regions.empty();
    if (has_volume_cells() || (has_volume_entities() && !listed)) {
        regions_from_mesh();
    } else if (listed) {
        regions_from_lists();
        fill_hollow_regions();
    } else {
        add_found_regions(a_);
        if (model_ != nullptr) make_lists({});
    }
    settle_universe(a_);
}

void ModelBuilder::assemble() {
    a_.tolerance = tolerance_;
    const auto& first = info_of(dataset_.objects[objects_.front()]);
    a_.brep.name = model_ != nullptr && !model_->name.empty() ? model_->name : first.name;
    a_.brep.crs = model_ != nullptr && model_->crs.stated ? model_->crs : first.crs;
    if (model_ != nullptr) a_.brep.annotations = model_->annotations;
    weld();
    a_.brep.vertices = welder_.positions();
    make_surfaces();
    make_lines();
    if (loose_) take_apart();
    make_interfaces();
    make_regions();
    make_contacts(a_.brep);
    count_internal_lines(a_.brep);
    if (model_ != nullptr) {
        std::vector<SurfaceId> surface_of(model_->faces.size());
        for (std::uint32_t f = 0; f < faces_.size(); ++f) surface_of[faces_[f].stated] = SurfaceId(f);
        for (const auto& feature : model_->features) {
            BrepData::Feature made{feature.name, {}};
            for (const std::uint32_t f : feature.faces) {
                if (f >= surface_of.size() || !surface_of[f].valid()) continue;
                made.surfaces.push_back(surface_of[f]);
                auto& interface = a_.brep.interfaces[a_.brep.surfaces[surface_of[f].value].interface_id.value];
                if (interface.feature.empty()) interface.feature = feature.name;
            }
            a_.brep.features.push_back(std::move(made));
        }
    }
}

Result<Brep> ModelBuilder::build() {
    assemble();
    return Brep::make(std::move(a_.brep));
}

Result<JudgedModel> ModelBuilder::build_to_judge() {
    assemble();
    const bool found = !a_.found.region_of_side.empty() || a_.brep.surfaces.empty();
    if (!found) a_.found = find_regions(a_.brep, a_.graph, a_.cones, tolerance_);
    std::vector<std::uint64_t> first_polygon;
    for (const Face& face : faces_) {
        const auto* surface = std::get_if<Surface>(&dataset_.objects[face.object]);
        first_polygon.push_back(surface == nullptr || surface->parts.empty() ? 0 : surface->parts[face.part].first_polygon);
    }
    auto brep = Brep::make(std::move(a_.brep));
    if (!brep) return std::move(brep).why();
    return JudgedModel{std::move(brep).value(),
                       std::move(a_.faces),
                       std::move(a_.graph),
                       std::move(a_.found),
                       !loose_,
                       !found,
                       tolerance_,
                       points_welded_,
                       std::move(welded_positions_),
                       std::move(source_polygons_),
                       std::move(turned_polygons_),
                       std::move(first_polygon),
                       std::move(a_.findings)};
}

/// Calls make(builder) for each model that the file states, and gives the surfaces that belong to none.
template <class Make>
std::vector<std::uint32_t> each_stated_model(const Dataset& dataset, double tolerance, const Make& make) {
    std::vector<std::uint8_t> claimed(dataset.objects.size(), 0);
    for (const StatedModel& model : dataset.models) {
        for (const auto& face : model.faces) {
            if (face.object < claimed.size()) claimed[face.object] = 1;
        }
        ModelBuilder builder(dataset, &model, no_index, tolerance);
        if (builder.worthwhile()) make(builder);
    }
    std::vector<std::uint32_t> loose;
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        if (claimed[o] != 0) continue;
        if (std::holds_alternative<Surface>(dataset.objects[o])) loose.push_back(o);
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[o]);
        if (mesh == nullptr || mesh->entities.empty()) continue;
        ModelBuilder builder(dataset, nullptr, o, tolerance);
        if (builder.worthwhile()) make(builder);
    }
    return loose;
}

}  // namespace

void build_breps(Dataset& dataset) {
    dataset.breps.clear();
    each_stated_model(dataset, 0, [&](ModelBuilder& builder) {
        auto brep = builder.build();
        std::ranges::move(builder.findings(), std::back_inserter(dataset.findings));
        if (brep) {
            dataset.breps.push_back(std::move(brep).value());
        } else {
            dataset.findings.push_back(brep.why().error);
        }
    });
}

Result<std::vector<JudgedModel>> models_to_judge(const Dataset& dataset, double tolerance) {
    std::vector<JudgedModel> models;
    std::optional<Failure> failed;
    const auto add = [&](ModelBuilder& builder) {
        if (failed) return;
        auto model = builder.build_to_judge();
        if (model) {
            models.push_back(std::move(model).value());
        } else {
            failed = std::move(model).why();
        }
    };
    auto loose = each_stated_model(dataset, tolerance, add);
    if (!loose.empty()) {
        ModelBuilder builder(dataset, std::move(loose), tolerance);
        add(builder);
    }
    if (failed) return std::move(*failed);
    return models;
}

}  // namespace geomend::topology
