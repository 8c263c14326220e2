// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/dataset_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "base/utf8.h"
#include "model/attribute_names.h"

namespace geomend {

namespace {

using Json = nlohmann::ordered_json;

// ---- values that JSON itself cannot hold ----

// Bytes that are not UTF-8 (old Latin-1 names) go as {"bytes": each byte as one character}.
Json text_json(const std::string& text) {
    if (is_utf8(text)) return text;
    return Json{{"bytes", latin1_to_utf8(text)}};
}

std::string text_from(const Json& j) {
    if (j.is_string()) return j.get<std::string>();
    if (j.is_object() && j.contains("bytes") && j["bytes"].is_string()) return utf8_to_latin1(j["bytes"].get<std::string>());
    return {};
}

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(number_text(value)); }

std::optional<double> number_from(const Json& j) {
    if (j.is_number()) return j.get<double>();
    double value = 0;
    if (j.is_string() && parse_real(j.get<std::string>(), value) == NumberStatus::ok) return value;
    return std::nullopt;
}

// ---- reading without trust: a member of the wrong kind is as good as none ----

const Json& member(const Json& j, const char* key) {
    static const Json none;
    if (!j.is_object()) return none;
    const auto found = j.find(key);
    return found == j.end() ? none : *found;
}

std::string text_member(const Json& j, const char* key) { return text_from(member(j, key)); }

std::int64_t integer_member(const Json& j, const char* key, std::int64_t otherwise) {
    const Json& m = member(j, key);
    return m.is_number_integer() ? m.get<std::int64_t>() : otherwise;
}

std::uint32_t index_from(const Json& j) {
    if (!j.is_number_integer()) return no_index;
    const auto value = j.get<std::int64_t>();
    return value >= 0 && value < no_index ? static_cast<std::uint32_t>(value) : no_index;
}

template <class Body>
void for_each_member(const Json& j, const char* key, const Body& body) {
    const Json& all = member(j, key);
    if (!all.is_array()) return;
    for (const Json& one : all) body(one);
}

// ---- pairs ----

using Pairs = std::vector<std::pair<std::string, std::string>>;

Json pairs_json(const Pairs& pairs) {
    Json all = Json::array();
    for (const auto& [key, value] : pairs) all.push_back(Json::array({text_json(key), text_json(value)}));
    return all;
}

Pairs pairs_from(const Json& j, const char* key) {
    Pairs pairs;
    for_each_member(j, key, [&](const Json& one) {
        if (!one.is_array() || one.size() != 2) return;
        std::string name = text_from(one[0]);
        if (!name.empty()) pairs.emplace_back(std::move(name), text_from(one[1]));
    });
    return pairs;
}

Json annotations_json(const std::vector<Annotation>& annotations) {
    Json all = Json::array();
    for (const Annotation& a : annotations) all.push_back(Json::array({text_json(a.key), text_json(a.value)}));
    return all;
}

std::vector<Annotation> annotations_from(const Json& j) {
    std::vector<Annotation> annotations;
    for (auto& [key, value] : pairs_from(j, "annotations")) annotations.push_back({std::move(key), std::move(value)});
    return annotations;
}

void put_text(Json& j, const char* key, const std::string& text) {
    if (!text.empty()) j[key] = text_json(text);
}

void put_list(Json& j, const char* key, Json list) {
    if (!list.empty()) j[key] = std::move(list);
}

FeatureRole role_from(const Json& j) {
    const std::string word = text_member(j, "role");
    return word.empty() ? FeatureRole::unknown : feature_role(word);
}

void put_role(Json& j, FeatureRole role, const std::string& role_text) {
    if (role != FeatureRole::unknown) j["role"] = to_string(role);
    put_text(j, "role_text", role_text);
}

// ---- coordinate system ----

Json crs_json(const CoordinateSystem& crs) {
    Json j = Json::object();
    j["stated"] = crs.stated;
    put_text(j, "name", crs.name);
    put_text(j, "projection", crs.projection);
    put_text(j, "datum", crs.datum);
    const auto three = [](const std::array<std::string, 3>& t) { return Json::array({text_json(t[0]), text_json(t[1]), text_json(t[2])}); };
    if (crs.axis_names != std::array<std::string, 3>{}) j["axis_names"] = three(crs.axis_names);
    if (crs.axis_units != std::array<std::string, 3>{}) j["axis_units"] = three(crs.axis_units);
    if (crs.z_positive_stated || crs.z_positive == ZPositive::depth)
        j["z_positive"] = crs.z_positive == ZPositive::depth ? "depth" : "elevation";
    put_list(j, "annotations", pairs_json(crs.annotations));
    return j;
}

CoordinateSystem crs_from(const Json& j) {
    CoordinateSystem crs;
    crs.stated = member(j, "stated") == Json(true);
    crs.name = text_member(j, "name");
    crs.projection = text_member(j, "projection");
    crs.datum = text_member(j, "datum");
    const auto three = [&](const char* key, std::array<std::string, 3>& out) {
        const Json& m = member(j, key);
        for (std::size_t i = 0; m.is_array() && i < 3 && i < m.size(); ++i) out[i] = text_from(m[i]);
    };
    three("axis_names", crs.axis_names);
    three("axis_units", crs.axis_units);
    const std::string sign = text_member(j, "z_positive");
    crs.z_positive_stated = !sign.empty();
    crs.z_positive = sign == "depth" ? ZPositive::depth : ZPositive::elevation;
    crs.annotations = pairs_from(j, "annotations");
    return crs;
}

// ---- attributes ----

Json corner_values_json(const CornerValues& values) {
    Json j{{"components", values.components}};
    if (values.surfaces) j["surfaces"] = *values.surfaces;
    if (values.made_no_data) j["made_no_data"] = true;
    return j;
}

std::optional<CornerValues> corner_values_from(const Json& j) {
    if (!j.is_object()) return std::nullopt;
    CornerValues values;
    values.components = index_from(member(j, "components"));
    if (member(j, "surfaces").is_array()) values.surfaces.emplace();
    for_each_member(j, "surfaces", [&](const Json& one) {
        if (one.is_number_integer()) values.surfaces->push_back(one.get<std::int64_t>());
    });
    values.made_no_data = member(j, "made_no_data") == Json(true);
    return values;
}

Json time_json(const TimeStep& time) {
    Json j = Json::object();
    put_text(j, "date", time.date);
    if (time.days) j["days"] = number_json(*time.days);
    if (time.number) j["step"] = *time.number;
    return j;
}

std::optional<TimeStep> time_from(const Json& j) {
    if (!j.is_object()) return std::nullopt;
    TimeStep time{text_member(j, "date"), number_from(member(j, "days")), {}};
    if (member(j, "step").is_number_integer()) time.number = integer_member(j, "step", 0);
    return time;
}

Json attribute_json(const Attribute& a) {
    Json j = Json::object();
    j["name"] = text_json(a.name);
    j["location"] = to_string(a.location);
    put_text(j, "unit", a.unit);
    put_text(j, "kind", a.kind);
    put_text(j, "class", a.property_class);
    if (a.no_data) j["no_data"] = number_json(*a.no_data);
    if (a.legal_min) j["legal_min"] = number_json(*a.legal_min);
    if (a.legal_max) j["legal_max"] = number_json(*a.legal_max);
    Json names = Json::array();
    for (const auto& name : a.component_names) names.push_back(text_json(name));
    put_list(j, "component_names", std::move(names));
    Json codes = Json::array();
    for (const auto& [code, name] : a.code_names) codes.push_back(Json::array({code, text_json(name)}));
    put_list(j, "codes", std::move(codes));
    if (a.corner_values) j["corner_values"] = corner_values_json(*a.corner_values);
    if (a.time) j["time"] = time_json(*a.time);
    put_list(j, "annotations", pairs_json(a.annotations));
    return j;
}

/// \param told  attributes that had their entry: of several with one name each takes its own, in their order
void apply_attribute(const Json& j, std::vector<Attribute>& attributes, std::vector<bool>& told) {
    const std::string name = text_member(j, "name");
    const std::string location = text_member(j, "location");
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        Attribute& a = attributes[i];
        if (told[i] || a.name != name || location != to_string(a.location)) continue;
        told[i] = true;
        a.unit = text_member(j, "unit");
        a.kind = text_member(j, "kind");
        a.property_class = text_member(j, "class");
        a.no_data = number_from(member(j, "no_data"));
        a.legal_min = number_from(member(j, "legal_min"));
        a.legal_max = number_from(member(j, "legal_max"));
        std::vector<std::string> component_names;
        for_each_member(j, "component_names", [&](const Json& one) { component_names.push_back(text_from(one)); });
        if (component_names.size() == a.components) a.component_names = std::move(component_names);
        a.code_names.clear();
        for_each_member(j, "codes", [&](const Json& one) {
            if (one.is_array() && one.size() == 2 && one[0].is_number_integer())
                a.code_names.emplace_back(one[0].get<int>(), text_from(one[1]));
        });
        a.corner_values = corner_values_from(member(j, "corner_values"));
        a.time = time_from(member(j, "time"));
        a.annotations = pairs_from(j, "annotations");
        const auto own = std::ranges::find(a.annotations, own_name_key, &std::pair<std::string, std::string>::first);
        if (own == a.annotations.end()) return;
        a.name = std::move(own->second);
        a.annotations.erase(own);
        return;
    }
}

// ---- objects ----

Json info_json(const ObjectInfo& info) {
    Json j = Json::object();
    j["name"] = text_json(info.name);
    put_role(j, info.role, info.role_text);
    put_text(j, "feature", info.feature);
    j["crs"] = crs_json(info.crs);
    Json attributes = Json::array();
    for (const Attribute& a : info.attributes) attributes.push_back(attribute_json(a));
    put_list(j, "attributes", std::move(attributes));
    put_list(j, "annotations", annotations_json(info.annotations));
    Json groups = Json::array();
    for (const std::string& g : info.groups) groups.push_back(text_json(g));
    put_list(j, "groups", std::move(groups));
    return j;
}

void apply_info(const Json& j, ObjectInfo& info) {
    info.name = text_member(j, "name");
    info.role = role_from(j);
    info.role_text = text_member(j, "role_text");
    info.feature = text_member(j, "feature");
    info.crs = crs_from(member(j, "crs"));
    std::vector<bool> told(info.attributes.size());
    for_each_member(j, "attributes", [&](const Json& one) { apply_attribute(one, info.attributes, told); });
    for (Annotation& a : annotations_from(j)) info.annotations.push_back(std::move(a));
    info.groups.clear();
    for_each_member(j, "groups", [&](const Json& one) { info.groups.push_back(text_from(one)); });
}

Json entities_json(const CellMesh& mesh) {
    Json all = Json::array();
    for (const auto& e : mesh.entities) {
        Json j = Json::object();
        j["dimension"] = e.dimension;
        j["tag"] = e.tag;
        put_text(j, "name", e.name);
        put_role(j, e.role, e.role_text);
        all.push_back(std::move(j));
    }
    return all;
}

void apply_entities(const Json& object, CellMesh& mesh) {
    std::map<std::pair<std::int64_t, std::int64_t>, CellMesh::Entity*> by_tag;
    for (auto& e : mesh.entities) by_tag.emplace(std::pair{std::int64_t{e.dimension}, e.tag}, &e);
    for_each_member(object, "entities", [&](const Json& j) {
        const auto found = by_tag.find({integer_member(j, "dimension", -1), integer_member(j, "tag", -1)});
        if (found == by_tag.end()) return;
        found->second->name = text_member(j, "name");
        found->second->role = role_from(j);
        found->second->role_text = text_member(j, "role_text");
    });
}

// A twin is written as its numbers of polygons and corners in turn, a surface as its tag and its twins.
Json twins_json(const Twins& twins) {
    Json all = Json::array();
    for (const auto& [tag, own] : twins) {
        Json list = Json::array();
        for (const TwinCorners& corners : own) {
            Json flat = Json::array();
            for (const auto& [polygon, corner] : corners) flat.push_back(polygon), flat.push_back(corner);
            list.push_back(std::move(flat));
        }
        all.push_back(Json::array({tag, std::move(list)}));
    }
    return all;
}

std::optional<Twins> twins_from(const Json& j) {
    if (!j.is_array()) return std::nullopt;
    Twins twins;
    for (const Json& one : j) {
        if (!one.is_array() || one.size() != 2 || !one[0].is_number_integer() || !one[1].is_array()) return std::nullopt;
        auto& own = twins[one[0].get<std::int64_t>()];
        for (const Json& flat : one[1]) {
            if (!flat.is_array() || flat.size() % 2 != 0) return std::nullopt;
            TwinCorners corners;
            for (std::size_t i = 0; i < flat.size(); i += 2) {
                const std::uint32_t polygon = index_from(flat[i]), corner = index_from(flat[i + 1]);
                if (polygon == no_index || corner == no_index) return std::nullopt;
                corners.push_back({polygon, corner});
            }
            own.push_back(std::move(corners));
        }
    }
    return twins;
}

Json groups_json(const std::vector<StatedGroup>& groups) {
    Json all = Json::array();
    for (const StatedGroup& g : groups) {
        Json path = Json::array();
        for (const std::string& name : g.path) path.push_back(text_json(name));
        all.push_back(Json{{"path", std::move(path)}, {"head", text_json(g.head)}});
    }
    return all;
}

StatedGroup group_from(const Json& j) {
    StatedGroup group{{}, text_member(j, "head")};
    for_each_member(j, "path", [&](const Json& one) { group.path.push_back(text_from(one)); });
    return group;
}

// ---- stated models ----

Json point_json(const Vec3& p) { return Json::array({number_json(p[0]), number_json(p[1]), number_json(p[2])}); }

std::optional<Vec3> point_from(const Json& j) {
    if (!j.is_array() || j.size() != 3) return std::nullopt;
    Vec3 p{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = number_from(j[axis]);
        if (!value) return std::nullopt;
        p[axis] = *value;
    }
    return p;
}

Json face_json(const StatedModel::Face& face) {
    Json j = Json::object();
    j["number"] = face.number;
    j["object"] = face.object;
    j["part"] = face.part;
    put_text(j, "interface", face.interface_name);
    put_text(j, "name", face.name);
    put_role(j, face.role, face.role_text);
    if (face.key) j["key"] = Json::array({point_json((*face.key)[0]), point_json((*face.key)[1]), point_json((*face.key)[2])});
    return j;
}

StatedModel::Face face_from(const Json& j) {
    StatedModel::Face face;
    face.number = integer_member(j, "number", 0);
    face.object = index_from(member(j, "object"));
    face.part = index_from(member(j, "part"));
    face.interface_name = text_member(j, "interface");
    face.name = text_member(j, "name");
    face.role = role_from(j);
    face.role_text = text_member(j, "role_text");
    const Json& key = member(j, "key");
    if (key.is_array() && key.size() == 3) {
        const auto a = point_from(key[0]), b = point_from(key[1]), c = point_from(key[2]);
        if (a && b && c) face.key = {*a, *b, *c};
    }
    return face;
}

// Sides are written as face numbers from 1, negative for the back, as Model3d does.
Json region_json(const StatedModel::Region& region) {
    Json j = Json::object();
    j["number"] = region.number;
    j["name"] = text_json(region.name);
    if (region.universe) j["universe"] = true;
    Json sides = Json::array();
    for (const auto& side : region.sides) sides.push_back(side.front ? std::int64_t{side.face} + 1 : -std::int64_t{side.face} - 1);
    j["sides"] = std::move(sides);
    return j;
}

StatedModel::Region region_from(const Json& j, std::size_t face_count) {
    StatedModel::Region region;
    region.number = integer_member(j, "number", 0);
    region.name = text_member(j, "name");
    region.universe = member(j, "universe") == Json(true);
    for_each_member(j, "sides", [&](const Json& one) {
        if (!one.is_number_integer()) return;
        const auto n = one.get<std::int64_t>();
        const std::uint64_t face = n > 0 ? static_cast<std::uint64_t>(n) : std::uint64_t{0} - static_cast<std::uint64_t>(n);
        if (face >= 1 && face <= face_count) region.sides.push_back({static_cast<std::uint32_t>(face - 1), n > 0});
    });
    return region;
}

std::vector<std::uint32_t> indices_from(const Json& j, const char* key, std::size_t count) {
    std::vector<std::uint32_t> all;
    for_each_member(j, key, [&](const Json& one) {
        if (const auto i = index_from(one); i < count) all.push_back(i);
    });
    return all;
}

Json lists_json(const std::vector<StatedModel::RegionList>& lists) {
    Json all = Json::array();
    for (const auto& list : lists)
        all.push_back(Json{{"name", text_json(list.name)}, {"regions", list.regions}, {"unresolved", list.unresolved}});
    return all;
}

std::vector<StatedModel::RegionList> lists_from(const Json& j, const char* key, std::size_t region_count) {
    std::vector<StatedModel::RegionList> lists;
    for_each_member(j, key, [&](const Json& one) {
        StatedModel::RegionList list{text_member(one, "name"), indices_from(one, "regions", region_count), {}};
        for_each_member(one, "unresolved", [&](const Json& n) {
            if (n.is_number_integer()) list.unresolved.push_back(n.get<std::int64_t>());
        });
        lists.push_back(std::move(list));
    });
    return lists;
}

Json interface_json(const StatedModel::Interface& interface) {
    Json j = Json::object();
    j["name"] = text_json(interface.name);
    put_text(j, "feature", interface.feature);
    put_list(j, "annotations", annotations_json(interface.annotations));
    return j;
}

Json model_json(const StatedModel& model) {
    Json j = Json::object();
    j["name"] = text_json(model.name);
    j["crs"] = crs_json(model.crs);
    put_list(j, "annotations", annotations_json(model.annotations));
    Json faces = Json::array(), regions = Json::array(), features = Json::array(), corners = Json::array();
    for (const auto& face : model.faces) faces.push_back(face_json(face));
    for (const auto& region : model.regions) regions.push_back(region_json(region));
    for (const auto& f : model.features) features.push_back(Json{{"name", text_json(f.name)}, {"faces", f.faces}});
    for (const auto& c : model.corners) corners.push_back(Json{{"name", text_json(c.name)}, {"position", point_json(c.position)}});
    Json interfaces = Json::array();
    for (const auto& interface : model.interfaces) interfaces.push_back(interface_json(interface));
    put_list(j, "faces", std::move(faces));
    put_list(j, "interfaces", std::move(interfaces));
    put_list(j, "regions", std::move(regions));
    put_list(j, "features", std::move(features));
    put_list(j, "layers", lists_json(model.layers));
    put_list(j, "fault_blocks", lists_json(model.fault_blocks));
    put_list(j, "corners", std::move(corners));
    return j;
}

std::size_t part_count(const Object& object) {
    if (const auto* surface = std::get_if<Surface>(&object)) return std::max<std::size_t>(surface->parts.size(), 1);
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return mesh->entities.size();
    return 0;
}

std::optional<StatedModel> model_from(const Json& j, const std::vector<Object>& objects) {
    StatedModel model;
    model.name = text_member(j, "name");
    model.crs = crs_from(member(j, "crs"));
    model.annotations = annotations_from(j);
    bool fits = true;
    for_each_member(j, "faces", [&](const Json& one) {
        model.faces.push_back(face_from(one));
        const auto& face = model.faces.back();
        fits = fits && face.object < objects.size() && face.part < part_count(objects[face.object]);
    });
    if (!fits) return std::nullopt;
    for_each_member(j, "interfaces", [&](const Json& one) {
        model.interfaces.push_back({text_member(one, "name"), text_member(one, "feature"), annotations_from(one)});
    });
    for_each_member(j, "regions", [&](const Json& one) { model.regions.push_back(region_from(one, model.faces.size())); });
    for_each_member(j, "features", [&](const Json& one) {
        model.features.push_back({text_member(one, "name"), indices_from(one, "faces", model.faces.size())});
    });
    model.layers = lists_from(j, "layers", model.regions.size());
    model.fault_blocks = lists_from(j, "fault_blocks", model.regions.size());
    for_each_member(j, "corners", [&](const Json& one) {
        if (const auto p = point_from(member(one, "position"))) model.corners.push_back({text_member(one, "name"), *p});
    });
    return model;
}

}  // namespace

ObjectInfo words_of(const ObjectInfo& info) {
    ObjectInfo words;
    words.name = info.name;
    words.role = info.role;
    words.role_text = info.role_text;
    words.feature = info.feature;
    words.crs = info.crs;
    words.annotations = info.annotations;
    words.groups = info.groups;
    return words;
}

std::string dataset_text(const Dataset& dataset) {
    Json j = Json::object();
    j["geomend"] = 1;
    put_list(j, "groups", groups_json(dataset.groups));
    put_list(j, "annotations", annotations_json(dataset.annotations));
    Json objects = Json::array(), models = Json::array();
    for (const Object& object : dataset.objects) {
        Json one = info_json(info_of(object));
        if (const auto* mesh = std::get_if<CellMesh>(&object)) {
            put_list(one, "entities", entities_json(*mesh));
            if (mesh->twins) one["twins"] = twins_json(*mesh->twins);
        }
        objects.push_back(std::move(one));
    }
    for (const StatedModel& model : dataset.models) models.push_back(model_json(model));
    put_list(j, "objects", std::move(objects));
    put_list(j, "models", std::move(models));
    return j.dump(-1, ' ', true);  // ASCII only, so that no reader's encoding can spoil it
}

bool apply_dataset_text(std::string_view text, Dataset& dataset) {
    const Json j = Json::parse(text, nullptr, false);
    if (!j.is_object() || integer_member(j, "geomend", 0) != 1) return false;
    for_each_member(j, "groups", [&](const Json& one) { dataset.groups.push_back(group_from(one)); });
    for (Annotation& a : annotations_from(j)) dataset.annotations.push_back(std::move(a));
    std::size_t at = 0;
    for_each_member(j, "objects", [&](const Json& one) {
        if (at >= dataset.objects.size()) return;
        Object& object = dataset.objects[at++];
        apply_info(one, info_of(object));
        if (auto* mesh = std::get_if<CellMesh>(&object)) {
            apply_entities(one, *mesh);
            mesh->twins = twins_from(member(one, "twins"));
        }
    });
    for_each_member(j, "models", [&](const Json& one) {
        if (auto model = model_from(one, dataset.objects)) dataset.models.push_back(std::move(*model));
    });
    return true;
}

}  // namespace geomend
