// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk_merge.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/vtk/vtk_cells.h"
#include "formats/vtk/vtk_structure.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::string_view owner_array = "geomend.object";

void append_mesh(CellMesh& to, const CellMesh& from) {
    const auto first_point = static_cast<std::uint32_t>(to.points.size());
    const std::uint64_t first_node = to.nodes.size();
    if (!from.cell_faces.empty() && to.cell_faces.empty()) {
        to.cell_faces.assign(to.types.size() + 1, 0);
        to.face_offsets.assign(1, 0);
    }
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    to.types.insert(to.types.end(), from.types.begin(), from.types.end());
    for (std::size_t i = 1; i < from.offsets.size(); ++i) to.offsets.push_back(first_node + from.offsets[i]);
    for (const std::uint32_t n : from.nodes) to.nodes.push_back(first_point + n);
    if (to.cell_faces.empty()) return;
    const std::uint64_t first_face = to.face_offsets.size() - 1, first_face_node = to.face_nodes.size();
    for (std::size_t i = 1; i < from.cell_faces.size(); ++i) to.cell_faces.push_back(first_face + from.cell_faces[i]);
    for (std::size_t i = 1; i < from.face_offsets.size(); ++i) to.face_offsets.push_back(first_face_node + from.face_offsets[i]);
    for (const std::uint32_t n : from.face_nodes) to.face_nodes.push_back(first_point + n);
    to.cell_faces.resize(to.types.size() + 1, to.cell_faces.back());
}

void fill_with_nothing(Attribute& a, std::size_t values) {
    std::visit(
        [&](auto& v) {
            using Value = typename std::decay_t<decltype(v)>::value_type;
            if constexpr (std::is_floating_point_v<Value>) v.resize(values, std::numeric_limits<Value>::quiet_NaN());
            else v.resize(values);
        },
        a.values);
}

void append(Attribute& to, const Attribute& from) {
    std::visit(
        [&](auto& v) {
            const auto& more = std::get<std::decay_t<decltype(v)>>(from.values);
            v.insert(v.end(), more.begin(), more.end());
        },
        to.values);
}

class Merger {
public:
    void add(const Object& object) {
        Object full = object;
        std::vector<Attribute> arrays = structure_arrays(object);
        ObjectInfo& info = info_of(full);
        info.attributes.insert(info.attributes.end(), arrays.begin(), arrays.end());
        CellMesh mesh;
        mesh_from_object(full, mesh);
        const std::size_t points = out_.points.size(), cells = out_.cell_count();
        append_mesh(out_, mesh);
        Json listed = Json::array();
        for (const Attribute& a : mesh.info.attributes) {
            const std::string stored = place(a, a.location == AttributeLocation::cell ? cells : points, object);
            listed.push_back(Json::array({stored, a.name, to_string(a.location)}));
        }
        objects_.push_back(Json{{"structure", structure_text(object)}, {"attributes", std::move(listed)}});
        point_owner_.resize(out_.points.size(), next_);
        cell_owner_.resize(out_.cell_count(), next_);
        ++next_;
    }

    Merged finish() {
        for (Attribute& a : attributes_) fill_with_nothing(a, wanted(a, out_.points.size(), out_.cell_count()));
        out_.info.attributes = std::move(attributes_);
        Attribute owner;
        owner.name = owner_array;
        owner.values = std::move(point_owner_);
        out_.info.attributes.push_back(owner);
        owner.location = AttributeLocation::cell;
        owner.values = std::move(cell_owner_);
        out_.info.attributes.push_back(std::move(owner));
        const Json text{{"merged", 1}, {"objects", std::move(objects_)}};
        return {std::move(out_), text.dump(-1, ' ', true, Json::error_handler_t::replace)};
    }

private:
    CellMesh out_;
    std::vector<Attribute> attributes_;
    std::vector<std::int32_t> point_owner_, cell_owner_;
    std::int32_t next_ = 0;
    Json objects_ = Json::array();

    static std::size_t wanted(const Attribute& a, std::size_t points, std::size_t cells) {
        if (a.location == AttributeLocation::object) return value_count(a);
        return (a.location == AttributeLocation::cell ? cells : points) * a.components;
    }

    // Appends the values behind those of the objects before; returns the name that the array has in the file.
    std::string place(const Attribute& a, std::size_t things_before, const Object& object) {
        std::string name = a.name;
        for (int round = 0;; ++round) {
            Attribute* same = nullptr;
            for (Attribute& other : attributes_) {
                if (other.name == name && other.location == a.location) same = &other;
            }
            if (same == nullptr) {
                attributes_.push_back(a);
                same = &attributes_.back();
                same->name = name;
                if (a.location == AttributeLocation::object) return name;
                std::visit([](auto& v) { v.clear(); }, same->values);
            } else if (same->components != a.components || same->values.index() != a.values.index() ||
                       a.location == AttributeLocation::object) {
                name = a.name + " (" + info_of(object).name + (round == 0 ? "" : " " + std::to_string(round)) + ")";
                continue;
            }
            fill_with_nothing(*same, things_before * a.components);
            append(*same, a);
            return name;
        }
    }
};

const std::vector<std::int32_t>* owners(const CellMesh& mesh, AttributeLocation location) {
    const Attribute* a = find_attribute(mesh.info.attributes, std::string(owner_array), location);
    return a != nullptr && a->components == 1 ? std::get_if<std::vector<std::int32_t>>(&a->values) : nullptr;
}

bool valid_owners(const CellMesh& mesh, const std::vector<std::int32_t>& points, const std::vector<std::int32_t>& cells,
                  std::size_t count) {
    const auto good = [&](std::int32_t o) { return o >= 0 && std::cmp_less(o, count); };
    if (!std::ranges::all_of(points, good) || !std::ranges::all_of(cells, good)) return false;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (const std::uint32_t n : mesh.cell_nodes(c)) {
            if (points[n] != cells[c]) return false;
        }
        if (mesh.cell_faces.empty()) continue;
        for (std::uint64_t f = mesh.face_offsets[mesh.cell_faces[c]]; f < mesh.face_offsets[mesh.cell_faces[c + 1]]; ++f) {
            if (points[mesh.face_nodes[f]] != cells[c]) return false;
        }
    }
    return true;
}

/// The part of a merged mesh that one object owns.
CellMesh own_part(const CellMesh& all, const std::vector<std::uint32_t>& points, const std::vector<std::uint32_t>& cells,
                  const std::vector<std::uint32_t>& new_number) {
    CellMesh mesh;
    mesh.points.reserve(points.size());
    for (const std::uint32_t p : points) mesh.points.push_back(all.points[p]);
    if (!all.cell_faces.empty()) {
        mesh.cell_faces.assign(1, 0);
        mesh.face_offsets.assign(1, 0);
    }
    for (const std::uint32_t c : cells) {
        mesh.types.push_back(all.types[c]);
        for (const std::uint32_t n : all.cell_nodes(c)) mesh.nodes.push_back(new_number[n]);
        mesh.offsets.push_back(mesh.nodes.size());
        if (all.cell_faces.empty()) continue;
        for (std::uint64_t f = all.cell_faces[c]; f < all.cell_faces[c + 1]; ++f) {
            for (std::uint64_t k = all.face_offsets[f]; k < all.face_offsets[f + 1]; ++k)
                mesh.face_nodes.push_back(new_number[all.face_nodes[k]]);
            mesh.face_offsets.push_back(mesh.face_nodes.size());
        }
        mesh.cell_faces.push_back(mesh.face_offsets.size() - 1);
    }
    if (mesh.face_nodes.empty()) {
        mesh.cell_faces.clear();
        mesh.face_offsets.clear();
    }
    return mesh;
}

AttributeLocation location_of(const std::string& word) {
    return word == "cell" ? AttributeLocation::cell : word == "object" ? AttributeLocation::object : AttributeLocation::point;
}

}  // namespace

Merged merge_objects(const std::vector<Object>& objects) {
    Merger merger;
    for (const Object& object : objects) merger.add(object);
    return merger.finish();
}

std::vector<Object> split_objects(std::string_view text, Object& merged) {
    const Json j = Json::parse(text, nullptr, false);
    if (!j.is_object() || !j.contains("merged") || !j.contains("objects") || !j["objects"].is_array()) return {};
    CellMesh all;
    if (!mesh_from_object(merged, all)) return {};
    const auto* point_owner = owners(all, AttributeLocation::point);
    const auto* cell_owner = owners(all, AttributeLocation::cell);
    const Json& listed = j["objects"];
    if (point_owner == nullptr || cell_owner == nullptr || !valid_owners(all, *point_owner, *cell_owner, listed.size())) return {};
    std::vector<std::vector<std::uint32_t>> points(listed.size()), cells(listed.size());
    std::vector<std::uint32_t> new_number(all.points.size());
    for (std::uint32_t p = 0; p < point_owner->size(); ++p) {
        auto& own = points[static_cast<std::size_t>((*point_owner)[p])];
        new_number[p] = static_cast<std::uint32_t>(own.size());
        own.push_back(p);
    }
    for (std::uint32_t c = 0; c < cell_owner->size(); ++c) cells[static_cast<std::size_t>((*cell_owner)[c])].push_back(c);
    std::vector<Object> objects;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        CellMesh mesh = own_part(all, points[i], cells[i], new_number);
        const Json& one = listed[i];
        if (!one.is_object() || !one.contains("structure") || !one["structure"].is_string()) return {};
        if (one.contains("attributes") && one["attributes"].is_array()) {
            for (const Json& a : one["attributes"]) {
                if (!a.is_array() || a.size() != 3 || !a[0].is_string() || !a[1].is_string() || !a[2].is_string()) continue;
                const Attribute* found = find_attribute(all.info.attributes, a[0].get<std::string>(), location_of(a[2].get<std::string>()));
                if (found == nullptr) continue;
                Attribute own = *found;
                own.name = a[1].get<std::string>();
                if (own.location == AttributeLocation::point) take_values(own, points[i]);
                else if (own.location == AttributeLocation::cell) take_values(own, cells[i]);
                mesh.info.attributes.push_back(std::move(own));
            }
        }
        mesh.info.annotations = info_of(merged).annotations;
        Object object = std::move(mesh);
        restore_structure(one["structure"].get<std::string>(), object);
        objects.push_back(std::move(object));
    }
    return objects;
}

PolylineSet polyline_of_well(const Well& well, std::vector<Loss>& losses) {
    PolylineSet line;
    line.info = well.info;
    line.points = well.path;
    for (std::uint32_t i = 0; i + 1 < well.path.size(); ++i) line.edges.push_back({i, i + 1});
    if (!well.path.empty()) line.parts.push_back({0, 0, well.info.name});
    if (well.measured_depth.size() == well.path.size() && !well.path.empty()) {
        Attribute depth;
        depth.name = "measured_depth";
        depth.values = well.measured_depth;
        line.info.attributes.push_back(std::move(depth));
    }
    const auto lose = [&](std::size_t count, const char* what) {
        if (count != 0) add_loss(losses, {LossClass::substance, well.info.name, what, "VTK holds the path of a well only", count});
    };
    lose(well.markers.size(), "markers");
    lose(well.zones.size(), "zones");
    lose(well.curves.size(), "curves");
    return line;
}

Dataset text_only(const Dataset& dataset, const std::vector<Object>& objects, const std::vector<std::size_t>& source) {
    Dataset shells;
    shells.groups = dataset.groups;
    shells.annotations = dataset.annotations;
    for (const Object& object : objects) {
        std::visit(
            [&](const auto& o) {
                std::decay_t<decltype(o)> shell;
                shell.info = words_of(o.info);
                for (const Attribute& a : o.info.attributes) shell.info.attributes.push_back(without_values(a));
                if constexpr (requires { shell.entities; }) shell.entities = o.entities;
                if constexpr (requires { shell.twins; }) shell.twins = o.twins;
                shells.objects.emplace_back(std::move(shell));
            },
            object);
    }
    const bool all_there = source.size() == dataset.objects.size();
    if (all_there) shells.models = dataset.models;
    return shells;
}

}  // namespace geomend::vtk
