// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk_structure.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/vtk/vtk_cells.h"

namespace geomend::vtk {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view point_label = "geomend.label", cell_label = "geomend.cell_label", alias_array = "geomend.alias",
                           entity_array = "geomend.entity", set_prefix = "geomend.set.";

const Json& member(const Json& j, const char* key) {
    static const Json none;
    if (!j.is_object()) return none;
    const auto found = j.find(key);
    return found == j.end() ? none : *found;
}

std::int64_t number(const Json& j, std::int64_t otherwise) { return j.is_number_integer() ? j.get<std::int64_t>() : otherwise; }
std::string text_of(const Json& j) { return j.is_string() ? j.get<std::string>() : std::string{}; }

Json point_json(const Vec3& p) { return Json::array({p[0], p[1], p[2]}); }

bool point_from(const Json& j, Vec3& p) {
    if (!j.is_array() || j.size() != 3) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!j[i].is_number()) return false;
        p[i] = j[i].get<double>();
    }
    return true;
}

// ---- to text ----

void put_first_label(Json& j, const char* key, const Labels& labels) {
    if (labels.ids.empty()) j[key] = labels.first;
}

Json parts_json(const std::vector<PolylineSet::Part>& parts) {
    Json all = Json::array();
    for (const auto& p : parts) all.push_back(Json::array({p.first_point, p.first_edge, p.name}));
    return all;
}

Json parts_json(const std::vector<Surface::Part>& parts) {
    Json all = Json::array();
    for (const auto& p : parts) all.push_back(Json::array({p.first_point, p.first_polygon}));
    return all;
}

Json entities_json(const CellMesh& mesh) {
    Json all = Json::array();
    for (const auto& e : mesh.entities) {
        Json j = Json::object();
        j["dimension"] = e.dimension;
        j["tag"] = e.tag;
        if (!e.boundary.empty()) j["boundary"] = e.boundary;
        if (!e.groups.empty()) j["groups"] = e.groups;
        if (e.bounds) j["bounds"] = Json::array({point_json((*e.bounds)[0]), point_json((*e.bounds)[1])});
        all.push_back(std::move(j));
    }
    return all;
}

void put(Json& j, const PointSet& set) {
    put_first_label(j, "first_label", set.labels);
    if (!set.part_first.empty()) j["parts"] = set.part_first;
}

void put(Json& j, const PolylineSet& set) {
    put_first_label(j, "first_label", set.labels);
    if (!set.parts.empty()) j["parts"] = parts_json(set.parts);
}

void put(Json& j, const Surface& surface) {
    put_first_label(j, "first_label", surface.labels);
    if (!surface.parts.empty()) j["parts"] = parts_json(surface.parts);
    if (!surface.border_corners.empty()) j["border_corners"] = surface.border_corners;
    Json starts = Json::array();
    for (const auto& b : surface.border_starts) starts.push_back(Json::array({b.id, b.corner, b.next}));
    if (!starts.empty()) j["border_starts"] = std::move(starts);
}

void put(Json& j, const CellMesh& mesh) {
    put_first_label(j, "first_label", mesh.point_labels);
    put_first_label(j, "first_cell_label", mesh.cell_labels);
    if (!mesh.entities.empty()) j["entities"] = entities_json(mesh);
    Json groups = Json::array();
    for (const auto& g : mesh.groups) groups.push_back(Json{{"dimension", g.dimension}, {"tag", g.tag}, {"name", g.name}});
    if (!groups.empty()) j["groups"] = std::move(groups);
    if (mesh.facet_tags.empty()) return;
    j["facet_names"] = mesh.facet_names;
    Json tags = Json::array();  // name * 6 + (sign + 1) * 2 + boundary; -1 for none
    for (const auto& t : mesh.facet_tags)
        tags.push_back(t.name == no_index ? std::int64_t{-1} - (t.boundary ? 1 : 0)
                                          : std::int64_t{t.name} * 6 + (t.sign + 1) * 2 + (t.boundary ? 1 : 0));
    j["facet_tags"] = std::move(tags);
}

void put(Json& j, const StructuredGrid& grid) {
    Json splits = Json::array();
    for (const auto& s : grid.splits)
        splits.push_back(Json::array({s.node[0], s.node[1], s.node[2], point_json(s.position), s.id, s.cells}));
    if (!splits.empty()) j["splits"] = std::move(splits);
    Json sets = Json::array();
    for (const auto& s : grid.face_sets) sets.push_back(Json{{"name", s.name}, {"faces", s.faces}});
    if (!sets.empty()) j["face_sets"] = std::move(sets);
}

constexpr std::string_view ghost_array = "vtkGhostType";
constexpr std::uint8_t hidden_point = 2;

/// Samples whose height is missing, as VTK marks what is not to be drawn; empty where there are none.
std::vector<std::uint8_t> hidden_samples(const Raster& raster) {
    if (raster.height_attribute >= raster.info.attributes.size()) return {};
    const Attribute& height = raster.info.attributes[raster.height_attribute];
    if (height.components != 1 || value_count(height) != sample_count(raster.dims)) return {};
    std::vector<std::uint8_t> marks(value_count(height), 0);
    bool any = false;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const double value = value_as_double(height, i);
        if (std::isfinite(value) && !is_no_data(height, value)) continue;
        marks[i] = hidden_point;
        any = true;
    }
    return any ? marks : std::vector<std::uint8_t>();
}

/// Whether samples without a height are marked for VTK: where nothing of the raster's own is called like the marks.
bool hides_heights(const Raster& raster) {
    return find_attribute(raster.info.attributes, std::string(ghost_array), AttributeLocation::point) == nullptr &&
           !hidden_samples(raster).empty();
}

void put(Json& j, const Raster& raster) {
    j["origin"] = point_json(raster.origin);
    j["step"] = Json::array({point_json(raster.step[0]), point_json(raster.step[1]), point_json(raster.step[2])});
    if (raster.height_attribute < raster.info.attributes.size()) j["height"] = raster.info.attributes[raster.height_attribute].name;
    if (hides_heights(raster)) j["hidden"] = true;
}

void put(Json&, const Well&) {}
void put(Json&, const CornerPointGrid&) {}

// ---- from text ----

template <class Body>
void each(const Json& list, const Body& body) {
    if (!list.is_array()) return;
    for (const Json& one : list) body(one);
}

// Parts must begin at the start and not go down.
bool good_starts(const std::vector<std::array<std::uint64_t, 2>>& starts, std::size_t points, std::size_t cells) {
    std::array<std::uint64_t, 2> before{0, 0};
    for (const auto& s : starts) {
        if (s[0] < before[0] || s[1] < before[1] || s[0] > points || s[1] > cells) return false;
        before = s;
    }
    return true;
}

template <class Part>
std::vector<Part> parts_from(const Json& list, std::size_t points, std::size_t cells) {
    std::vector<Part> parts;
    std::vector<std::array<std::uint64_t, 2>> starts;
    bool good = list.is_array();
    each(list, [&](const Json& one) {
        if (!one.is_array() || one.size() < 2 || number(one[0], -1) < 0 || number(one[1], -1) < 0) {
            good = false;
            return;
        }
        starts.push_back({static_cast<std::uint64_t>(number(one[0], 0)), static_cast<std::uint64_t>(number(one[1], 0))});
        Part part;
        part.first_point = static_cast<std::uint32_t>(starts.back()[0]);
        if constexpr (requires { part.first_edge; }) {
            part.first_edge = starts.back()[1];
            if (one.size() > 2) part.name = text_of(one[2]);
        } else {
            part.first_polygon = starts.back()[1];
        }
        parts.push_back(std::move(part));
    });
    if (!good || !good_starts(starts, points, cells)) parts.clear();
    return parts;
}

void take(const Json& j, PointSet& set) {
    set.labels.first = number(member(j, "first_label"), 1);
    each(member(j, "parts"), [&](const Json& one) {
        const std::int64_t first = number(one, -1);
        const std::int64_t before = set.part_first.empty() ? 0 : set.part_first.back();
        if (first >= before && std::cmp_less_equal(first, set.points.size())) set.part_first.push_back(static_cast<std::uint32_t>(first));
    });
}

void take(const Json& j, PolylineSet& set) {
    set.labels.first = number(member(j, "first_label"), 1);
    set.parts = parts_from<PolylineSet::Part>(member(j, "parts"), set.points.size(), set.edges.size());
}

void take(const Json& j, Surface& surface) {
    surface.labels.first = number(member(j, "first_label"), 1);
    surface.parts = parts_from<Surface::Part>(member(j, "parts"), surface.points.size(), surface.polygons.size());
    const auto is_point = [&](std::int64_t p) { return p >= 0 && std::cmp_less(p, surface.points.size()); };
    each(member(j, "border_corners"), [&](const Json& one) {
        if (is_point(number(one, -1))) surface.border_corners.push_back(static_cast<std::uint32_t>(number(one, 0)));
    });
    each(member(j, "border_starts"), [&](const Json& one) {
        if (!one.is_array() || one.size() != 3 || !is_point(number(one[1], -1)) || !is_point(number(one[2], -1))) return;
        surface.border_starts.push_back(
            {number(one[0], 0), static_cast<std::uint32_t>(number(one[1], 0)), static_cast<std::uint32_t>(number(one[2], 0))});
    });
}

CellMesh::Entity entity_from(const Json& j, std::size_t group_count) {
    CellMesh::Entity e;
    e.dimension = static_cast<int>(std::clamp<std::int64_t>(number(member(j, "dimension"), 3), 0, 3));
    e.tag = number(member(j, "tag"), 0);
    each(member(j, "boundary"), [&](const Json& one) { e.boundary.push_back(number(one, 0)); });
    each(member(j, "groups"), [&](const Json& one) {
        const std::int64_t g = number(one, -1);
        if (g >= 0 && std::cmp_less(g, group_count)) e.groups.push_back(static_cast<std::uint32_t>(g));
    });
    const Json& bounds = member(j, "bounds");
    std::array<Vec3, 2> box{};
    if (bounds.is_array() && bounds.size() == 2 && point_from(bounds[0], box[0]) && point_from(bounds[1], box[1])) e.bounds = box;
    return e;
}

void take_facets(const Json& j, CellMesh& mesh) {
    const auto tets = static_cast<std::size_t>(std::ranges::count(mesh.types, CellType::tetrahedron));
    const Json& tags = member(j, "facet_tags");
    if (!tags.is_array() || tags.size() != 4 * tets) return;
    each(member(j, "facet_names"), [&](const Json& one) { mesh.facet_names.push_back(text_of(one)); });
    for (const Json& one : tags) {
        const std::int64_t packed = number(one, -1);
        CellMesh::FacetTag tag;
        if (packed >= 0 && std::cmp_less(packed / 6, mesh.facet_names.size())) {
            tag.name = static_cast<std::uint32_t>(packed / 6);
            tag.sign = static_cast<std::int8_t>(packed % 6 / 2 - 1);
            tag.boundary = packed % 2 == 1;
        } else {
            tag.boundary = packed == -2;
        }
        mesh.facet_tags.push_back(tag);
    }
}

void take(const Json& j, CellMesh& mesh) {
    mesh.point_labels.first = number(member(j, "first_label"), 1);
    mesh.cell_labels.first = number(member(j, "first_cell_label"), 1);
    each(member(j, "groups"), [&](const Json& one) {
        mesh.groups.push_back({static_cast<int>(std::clamp<std::int64_t>(number(member(one, "dimension"), 3), 0, 3)),
                               number(member(one, "tag"), 0), text_of(member(one, "name"))});
    });
    each(member(j, "entities"), [&](const Json& one) { mesh.entities.push_back(entity_from(one, mesh.groups.size())); });
    take_facets(j, mesh);
}

void take(const Json& j, StructuredGrid& grid) {
    each(member(j, "splits"), [&](const Json& one) {
        if (!one.is_array() || one.size() != 6) return;
        StructuredGrid::Split split{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int64_t n = number(one[i], -1);
            if (n < 0 || n >= grid.dims[i]) return;
            split.node[i] = static_cast<std::uint32_t>(n);
        }
        if (!point_from(one[3], split.position)) return;
        split.id = number(one[4], 0);
        split.cells = static_cast<std::uint8_t>(number(one[5], 0));
        grid.splits.push_back(split);
    });
    each(member(j, "face_sets"), [&](const Json& one) {
        StructuredGrid::FaceSet set;
        set.name = text_of(member(one, "name"));
        each(member(one, "faces"), [&](const Json& face) {
            if (!face.is_array() || face.size() != 2) return;
            const std::int64_t p = number(face[0], -1), d = number(face[1], -1);
            if (p >= 0 && std::cmp_less(p, grid.points.size()) && d >= 0 && d < 3)
                set.faces.push_back({static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(d)});
        });
        grid.face_sets.push_back(std::move(set));
    });
}

bool near(const Vec3& a, const Vec3& b) {
    double size = 0, gap = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        size = std::max({size, std::abs(a[i]), std::abs(b[i])});
        gap = std::max(gap, std::abs(a[i] - b[i]));
    }
    return gap <= 1e-9 * size;
}

void take(const Json& j, Raster& raster) {
    Vec3 origin{};
    std::array<Vec3, 3> step{};
    const Json& steps = member(j, "step");
    // Exact values for what VTK splits into spacing and direction; only where nobody has moved the image.
    if (point_from(member(j, "origin"), origin) && steps.is_array() && steps.size() == 3 && point_from(steps[0], step[0]) &&
        point_from(steps[1], step[1]) && point_from(steps[2], step[2]) && near(origin, raster.origin)) {
        bool same = true;
        for (std::size_t d = 0; d < 3; ++d) same = same && (raster.dims[d] == 1 || near(step[d], raster.step[d]));
        if (same) {
            raster.origin = origin;
            raster.step = step;
        }
    }
    if (member(j, "hidden") == Json(true))
        std::erase_if(raster.info.attributes,
                      [](const Attribute& a) { return a.name == ghost_array && a.location == AttributeLocation::point; });
    const std::vector<Attribute>& attributes = raster.info.attributes;
    for (std::uint32_t i = 0; i < attributes.size(); ++i) {
        const Attribute& a = attributes[i];
        if (a.location == AttributeLocation::point && a.components == 1 && member(j, "height") == Json(a.name)) raster.height_attribute = i;
    }
}

void take(const Json&, Well&) {}
void take(const Json&, CornerPointGrid&) {}

// ---- arrays ----

Attribute array(std::string_view name, AttributeLocation location, AttributeValues values) {
    Attribute a;
    a.name = name;
    a.location = location;
    a.values = std::move(values);
    return a;
}

template <class T>
bool take_array(ObjectInfo& info, std::string_view name, AttributeLocation location, std::vector<T>& to) {
    for (std::size_t i = 0; i < info.attributes.size(); ++i) {
        Attribute& a = info.attributes[i];
        auto* values = std::get_if<std::vector<T>>(&a.values);
        if (a.name != name || a.location != location || a.components != 1 || values == nullptr) continue;
        to = std::move(*values);
        info.attributes.erase(info.attributes.begin() + static_cast<std::ptrdiff_t>(i));
        return true;
    }
    return false;
}

// A twin that was moved since, or whose twin is one itself, is none.
void take_alias(ObjectInfo& info, const std::vector<Vec3>& points, std::vector<std::uint32_t>& alias) {
    std::vector<std::uint32_t> stated;
    if (!take_array(info, alias_array, AttributeLocation::point, stated) || stated.size() != points.size()) return;
    std::vector<std::uint32_t> good(stated.size(), no_index);
    for (std::size_t i = 0; i < stated.size(); ++i) {
        const std::uint32_t twin = stated[i];
        if (twin < stated.size() && stated[twin] == no_index && points[twin] == points[i]) good[i] = twin;
    }
    if (std::ranges::any_of(good, [](std::uint32_t twin) { return twin != no_index; })) alias = std::move(good);
}

void take_sets(ObjectInfo& info) {
    for (std::size_t i = 0; i < info.attributes.size();) {
        Attribute& a = info.attributes[i];
        const auto* marks = std::get_if<std::vector<std::uint8_t>>(&a.values);
        if (!a.name.starts_with(set_prefix) || marks == nullptr || a.components != 1) {
            ++i;
            continue;
        }
        NamedSet set{a.name.substr(set_prefix.size()), a.location, {}};
        for (std::uint32_t m = 0; m < marks->size(); ++m) {
            if ((*marks)[m] != 0) set.members.push_back(m);
        }
        info.sets.push_back(std::move(set));
        info.attributes.erase(info.attributes.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

void take_entities(CellMesh& mesh) {
    std::vector<std::int32_t> values;
    if (!take_array(mesh.info, entity_array, AttributeLocation::cell, values)) return;
    const bool good = std::ranges::all_of(values, [&](std::int32_t v) { return v < 0 || std::cmp_less(v, mesh.entities.size()); });
    if (!good || mesh.entities.empty()) return;
    for (const std::int32_t v : values) mesh.cell_entity.push_back(v < 0 ? no_index : static_cast<std::uint32_t>(v));
}

std::size_t things_at(const Object& object, AttributeLocation location) {
    if (location == AttributeLocation::point) {
        if (const auto* r = std::get_if<Raster>(&object)) return sample_count(r->dims);
        if (const auto* w = std::get_if<Well>(&object)) return w->path.size();
        return std::visit(
            [](const auto& o) -> std::size_t {
                if constexpr (requires { o.points.size(); }) return o.points.size();
                else return 0;
            },
            object);
    }
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return mesh->cell_count();
    if (const auto* surface = std::get_if<Surface>(&object)) return surface->polygons.size();
    if (const auto* lines = std::get_if<PolylineSet>(&object)) return lines->edges.size();
    if (const auto* grid = std::get_if<StructuredGrid>(&object)) return lattice_cell_count(grid->dims);
    if (const auto* raster = std::get_if<Raster>(&object)) return lattice_cell_count(raster->dims);
    return 0;
}

}  // namespace

std::string structure_text(const Object& object) {
    Json j = Json::object();
    j["structure"] = 1;
    j["kind"] = kind_name(object);
    std::visit([&](const auto& o) { put(j, o); }, object);
    return j.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::vector<Attribute> structure_arrays(const Object& object) {
    std::vector<Attribute> arrays;
    const auto add_labels = [&](const Labels& labels, std::string_view name, AttributeLocation location) {
        if (!labels.ids.empty()) arrays.push_back(array(name, location, labels.ids));
    };
    const auto add_alias = [&](const std::vector<std::uint32_t>& alias) {
        if (!alias.empty()) arrays.push_back(array(alias_array, AttributeLocation::point, alias));
    };
    std::visit(
        [&](const auto& o) {
            if constexpr (requires { o.labels; }) add_labels(o.labels, point_label, AttributeLocation::point);
            if constexpr (requires { o.alias; }) add_alias(o.alias);
        },
        object);
    if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        add_labels(mesh->point_labels, point_label, AttributeLocation::point);
        add_labels(mesh->cell_labels, cell_label, AttributeLocation::cell);
        if (!mesh->cell_entity.empty()) {
            std::vector<std::int32_t> entity;
            for (const std::uint32_t e : mesh->cell_entity) entity.push_back(e == no_index ? -1 : static_cast<std::int32_t>(e));
            arrays.push_back(array(entity_array, AttributeLocation::cell, std::move(entity)));
        }
    }
    if (const auto* raster = std::get_if<Raster>(&object); raster != nullptr && hides_heights(*raster))
        arrays.push_back(array(ghost_array, AttributeLocation::point, hidden_samples(*raster)));
    for (const NamedSet& set : info_of(object).sets) {
        std::vector<std::uint8_t> marks(things_at(object, set.location), 0);
        for (const std::uint32_t m : set.members) {
            if (m < marks.size()) marks[m] = 1;
        }
        arrays.push_back(array(std::string(set_prefix) + set.name, set.location, std::move(marks)));
    }
    return arrays;
}

bool restore_structure(std::string_view text, Object& object) {
    const Json j = Json::parse(text, nullptr, false);
    if (!j.is_object() || number(member(j, "structure"), 0) != 1) return false;
    const std::string kind = text_of(member(j, "kind"));
    if (auto* mesh = std::get_if<CellMesh>(&object); mesh != nullptr && kind != "cell-mesh") {
        Object other = object_of_kind(std::move(*mesh), kind);
        object = std::move(other);
    }
    if (kind != kind_name(object)) return true;  // the text is ours, but the object was edited
    std::visit([&](auto& o) { take(j, o); }, object);
    ObjectInfo& info = info_of(object);
    take_sets(info);
    std::visit(
        [&](auto& o) {
            if constexpr (requires { o.labels; }) take_array(o.info, point_label, AttributeLocation::point, o.labels.ids);
            if constexpr (requires {
                              o.alias;
                              o.points;
                          })
                take_alias(o.info, o.points, o.alias);
        },
        object);
    if (auto* mesh = std::get_if<CellMesh>(&object)) {
        take_array(mesh->info, point_label, AttributeLocation::point, mesh->point_labels.ids);
        take_array(mesh->info, cell_label, AttributeLocation::cell, mesh->cell_labels.ids);
        take_entities(*mesh);
    }
    return true;
}

ImageAxes image_axes(const Raster& raster) {
    ImageAxes axes;
    for (std::size_t d = 0; d < 3; ++d) {
        const Vec3& s = raster.step[d];
        int used = 0;
        for (const double x : s) used += x != 0 ? 1 : 0;
        const double length = used == 1 ? std::abs(s[0] + s[1] + s[2]) : std::hypot(s[0], s[1], s[2]);
        if (!(length > 0) || !std::isfinite(length)) continue;  // a direction with one sample may have no step
        axes.spacing[d] = length;
        for (std::size_t axis = 0; axis < 3; ++axis) axes.direction[3 * axis + d] = s[axis] / length;
    }
    return axes;
}

}  // namespace geomend::vtk
