// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk_model.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/vtk/vtk_merge.h"
#include "formats/vtk/vtk_model_parts.h"
#include "formats/vtk/xml_names.h"
#include "formats/vtk/xml_read.h"
#include "model/attribute_names.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

using Json = nlohmann::ordered_json;

std::string or_number(const std::string& name, const char* what, std::size_t i) {
    return name.empty() ? std::string(what) + " " + std::to_string(i + 1) : name;
}

Attribute vertex_numbers(const std::vector<VertexId>& nodes) {
    Attribute a;
    a.name = model_vertex;
    std::vector<std::uint32_t> ids;
    ids.reserve(nodes.size());
    for (const VertexId v : nodes) ids.push_back(v.value);
    a.values = std::move(ids);
    return a;
}

class BlockMaker {
public:
    explicit BlockMaker(const BrepData& brep) : brep_(brep) {}

    std::vector<ModelBlock> run() {
        for (std::size_t i = 0; i < brep_.corners.size(); ++i) corner(i);
        for (std::size_t i = 0; i < brep_.lines.size(); ++i) line(i);
        for (std::size_t i = 0; i < brep_.surfaces.size(); ++i) surface(i);
        for (std::size_t i = 0; i < brep_.regions.size(); ++i) region(i);
        return std::move(blocks_);
    }

private:
    const BrepData& brep_;
    std::vector<ModelBlock> blocks_;

    template <class Kind>
    void add(const char* group, std::string name, Kind object) {
        object.info.name = name;
        object.info.crs = brep_.crs;
        blocks_.push_back({group, std::move(name), std::move(object)});
    }

    std::vector<Vec3> positions(const std::vector<VertexId>& nodes) const {
        std::vector<Vec3> points;
        points.reserve(nodes.size());
        for (const VertexId v : nodes) points.push_back(brep_.vertices[v.value]);
        return points;
    }

    void corner(std::size_t i) {
        PointSet set;
        const std::vector<VertexId> nodes{brep_.corners[i].vertex};
        set.points = positions(nodes);
        set.info.attributes.push_back(vertex_numbers(nodes));
        add("Corners", or_number(brep_.corners[i].name, "corner", i), std::move(set));
    }

    // A closed line repeats its first vertex as a vertex number, not as a point.
    void line(std::size_t i) {
        const BrepData::Line& l = brep_.lines[i];
        std::vector<VertexId> nodes = l.vertices;
        const bool closed = nodes.size() > 2 && nodes.front() == nodes.back();
        if (closed) nodes.pop_back();
        PolylineSet set;
        set.points = positions(nodes);
        const auto n = static_cast<std::uint32_t>(nodes.size());
        for (std::uint32_t p = 0; p + 1 < n; ++p) set.edges.push_back({p, p + 1});
        if (closed) set.edges.push_back({n - 1, 0});
        set.parts.push_back({0, 0, {}});
        set.info.attributes.push_back(vertex_numbers(nodes));
        add("Lines", or_number(l.name, "line", i), std::move(set));
    }

    void surface(std::size_t i) {
        const BrepData::Surface& s = brep_.surfaces[i];
        Surface out;
        out.points = positions(s.nodes);
        out.polygons = s.polygons;
        out.info.role = s.role;
        out.info.role_text = s.role_text;
        out.info.attributes = s.attributes;
        out.info.annotations = s.annotations;
        if (s.interface_id.valid()) out.info.feature = brep_.interfaces[s.interface_id.value].name;
        out.info.attributes.push_back(vertex_numbers(s.nodes));
        add("Surfaces", or_number(s.name, "surface", i), std::move(out));
    }

    void region(std::size_t i) {
        const BrepData::Region& r = brep_.regions[i];
        if (r.cell_types.empty()) {
            add("Regions", or_number(r.name, "region", i), shell(r));
            return;
        }
        CellMesh mesh;
        mesh.points = positions(r.nodes);
        mesh.types = r.cell_types;
        mesh.offsets = r.cell_offsets;
        mesh.nodes = r.cell_nodes;
        mesh.cell_faces = r.cell_faces;
        mesh.face_offsets = r.face_offsets;
        mesh.face_nodes = r.face_nodes;
        mesh.info.attributes = r.attributes;
        mesh.info.annotations = r.annotations;
        std::vector<std::uint32_t> of_node;
        for (const VertexId v : r.nodes) of_node.push_back(v.value);
        for (const Attribute& a : brep_.vertex_attributes) {
            if (find_attribute(mesh.info.attributes, a.name, AttributeLocation::point) != nullptr) continue;
            mesh.info.attributes.push_back(a);
            take_values(mesh.info.attributes.back(), of_node);
        }
        mesh.info.attributes.push_back(vertex_numbers(r.nodes));
        add("Regions", or_number(r.name, "region", i), std::move(mesh));
    }

    // A hollow region shows as its sides, wound so that they look outward.
    Surface shell(const BrepData::Region& r) const {
        Surface out;
        std::vector<std::uint32_t> number(brep_.vertices.size(), no_index);
        std::vector<VertexId> nodes;
        std::vector<std::uint32_t> polygon;
        for (const BrepData::Side& side : r.sides) {
            const BrepData::Surface& s = brep_.surfaces[side.surface.value];
            for (std::size_t p = 0; p < s.polygons.size(); ++p) {
                polygon.clear();
                for (const std::uint32_t node : s.polygons[p]) {
                    std::uint32_t& n = number[s.nodes[node].value];
                    if (n == no_index) {
                        n = static_cast<std::uint32_t>(nodes.size());
                        nodes.push_back(s.nodes[node]);
                    }
                    polygon.push_back(n);
                }
                if (side.front) std::ranges::reverse(polygon);  // the region lies in front, so outward is behind
                out.polygons.push_back(polygon);
            }
        }
        out.points = positions(nodes);
        out.info.attributes.push_back(vertex_numbers(nodes));
        return out;
    }
};

/// The words of a B-Rep as a Dataset: what model_from_blocks will fill with geometry.
class WordMaker {
public:
    explicit WordMaker(const BrepData& brep) : brep_(brep) {}

    Dataset surfaces(Json& groups) {
        Dataset words;
        place_.resize(brep_.surfaces.size());
        std::vector<std::vector<std::uint32_t>> members(brep_.interfaces.size());
        for (std::uint32_t s = 0; s < brep_.surfaces.size(); ++s) {
            const InterfaceId id = brep_.surfaces[s].interface_id;
            if (id.valid()) members[id.value].push_back(s);
            else members.push_back({s});
        }
        for (std::size_t m = 0; m < members.size(); ++m) {
            if (members[m].empty()) continue;
            Surface object = interface_words(m, members[m]);
            for (std::uint32_t part = 0; part < members[m].size(); ++part)
                place_[members[m][part]] = {static_cast<std::uint32_t>(words.objects.size()), part};
            words.objects.emplace_back(std::move(object));
            groups.push_back(members[m]);
        }
        words.models.push_back(model());
        return words;
    }

    Dataset cells() {
        Dataset words;
        CellMesh mesh;
        mesh.info.name = brep_.name;
        mesh.info.crs = brep_.crs;
        mesh.entities = model_entities(brep_);
        const std::size_t first_surface = brep_.corners.size() + brep_.lines.size();
        place_.resize(brep_.surfaces.size());
        for (std::size_t s = 0; s < place_.size(); ++s) place_[s] = {0, static_cast<std::uint32_t>(first_surface + s)};
        const auto add_words = [&](const std::vector<Attribute>& attributes, bool polygons) {
            for (const Attribute& a : attributes) {
                const AttributeLocation location =
                    polygons && a.location == AttributeLocation::polygon ? AttributeLocation::cell : a.location;
                if (find_attribute(mesh.info.attributes, a.name, location) != nullptr) continue;
                mesh.info.attributes.push_back(a);
                mesh.info.attributes.back().location = location;
                mesh.info.attributes.back().values = {};
            }
        };
        for (const auto& r : brep_.regions) add_words(r.attributes, false);
        add_words(brep_.vertex_attributes, false);
        for (const auto& s : brep_.surfaces) add_words(s.attributes, true);
        words.objects.emplace_back(std::move(mesh));
        words.models.push_back(model());
        return words;
    }

private:
    const BrepData& brep_;
    struct Place {
        std::uint32_t object, part;
    };
    std::vector<Place> place_;

    Surface interface_words(std::size_t m, const std::vector<std::uint32_t>& members) const {
        Surface object;
        const BrepData::Surface& first = brep_.surfaces[members.front()];
        object.info.crs = brep_.crs;
        object.info.name = first.name;
        object.info.role = first.role;
        object.info.role_text = first.role_text;
        object.info.annotations = first.annotations;
        if (m < brep_.interfaces.size()) {
            const BrepData::Interface& i = brep_.interfaces[m];
            object.info.name = i.name;
            object.info.role = i.role;
            object.info.role_text = i.role_text;
            object.info.feature = i.feature;
            if (!i.annotations.empty()) object.info.annotations = i.annotations;
        }
        object.parts.resize(members.size());
        for (const std::uint32_t s : members) {
            for (const Attribute& a : brep_.surfaces[s].attributes) {
                if (find_attribute(object.info.attributes, a.name, a.location) != nullptr) continue;
                object.info.attributes.push_back(a);
                object.info.attributes.back().values = {};
            }
        }
        return object;
    }

    StatedModel model() const {
        StatedModel model;
        model.name = brep_.name;
        model.crs = brep_.crs;
        model.annotations = brep_.annotations;
        for (std::size_t i = 0; i < brep_.surfaces.size(); ++i) {
            const BrepData::Surface& s = brep_.surfaces[i];
            StatedModel::Face face;
            face.number = static_cast<std::int64_t>(i) + 1;
            face.object = place_[i].object;
            face.part = place_[i].part;
            face.name = s.name;
            face.role = s.role;
            face.role_text = s.role_text;
            if (s.interface_id.valid()) face.interface_name = brep_.interfaces[s.interface_id.value].name;
            model.faces.push_back(std::move(face));
        }
        add_regions(model);
        for (const BrepData::Feature& f : brep_.features) {
            model.features.push_back({f.name, {}});
            for (const SurfaceId surface : f.surfaces) model.features.back().faces.push_back(surface.value);
        }
        for (const BrepData::Corner& c : brep_.corners) {
            if (!c.name.empty()) model.corners.push_back({c.name, brep_.vertices[c.vertex.value]});
        }
        return model;
    }

    static std::vector<StatedModel::Side> sides(const std::vector<BrepData::Side>& all) {
        std::vector<StatedModel::Side> out;
        out.reserve(all.size());
        for (const BrepData::Side& s : all) out.push_back({s.surface.value, s.front});
        return out;
    }

    void add_regions(StatedModel& model) const {
        const std::uint32_t first = brep_.universe.empty() ? 0 : 1;
        auto number = static_cast<std::int64_t>(brep_.surfaces.size());
        if (first == 1) model.regions.push_back({++number, "Universe", true, sides(brep_.universe)});
        for (const BrepData::Region& r : brep_.regions) model.regions.push_back({++number, r.name, false, sides(r.sides)});
        const auto lists = [&](const std::vector<BrepData::RegionList>& from, std::vector<StatedModel::RegionList>& to) {
            for (const BrepData::RegionList& l : from) {
                to.push_back({l.name, {}, l.unresolved});
                to.back().regions.reserve(l.regions.size());
                for (const RegionId r : l.regions) to.back().regions.push_back(first + r.value);
            }
        };
        lists(brep_.layers, model.layers);
        lists(brep_.fault_blocks, model.fault_blocks);
    }
};

bool has_cells(const BrepData& brep) {
    return std::ranges::any_of(brep.regions, [](const BrepData::Region& r) { return !r.cell_types.empty(); });
}

/// The B-Rep with attributes of names that XML can hold and that differ, where they are not so already. Parts of one interface, which have
/// the same attributes, get the same names, so that they fit together again.
std::optional<BrepData> with_xml_names(const BrepData& brep) {
    const auto lists = [](auto& b) {
        std::vector<decltype(&b.vertex_attributes)> all{&b.vertex_attributes};
        for (auto& s : b.surfaces) all.push_back(&s.attributes);
        for (auto& r : b.regions) all.push_back(&r.attributes);
        return all;
    };
    if (std::ranges::all_of(lists(brep), [](const auto* list) { return has_xml_names(*list); })) return {};
    BrepData copy = brep;
    for (std::vector<Attribute>* list : lists(copy)) make_xml_names(*list);
    return copy;
}

}  // namespace

ModelBlocks blocks_of_brep(const BrepData& given) {
    const auto renamed = with_xml_names(given);
    const BrepData& brep = renamed ? *renamed : given;
    ModelBlocks all;
    all.blocks = BlockMaker(brep).run();
    // The blocks are joined by these names; the own ones come back with the words of the whole.
    for (ModelBlock& block : all.blocks) {
        for (Attribute& a : info_of(block.object).attributes)
            std::erase_if(a.annotations, [](const auto& one) { return one.first == own_name_key; });
    }
    Json j = Json::object();
    j["model"] = 1;
    j["counts"] = {brep.corners.size(), brep.lines.size(), brep.surfaces.size(), brep.regions.size()};
    WordMaker words(brep);
    if (has_cells(brep)) {
        j["kind"] = "cells";
        Json entities = Json::array();
        for (const auto& e : model_entities(brep))
            entities.push_back(Json{{"dimension", e.dimension}, {"tag", e.tag}, {"boundary", e.boundary}});
        j["entities"] = std::move(entities);
        all.dataset = dataset_text(words.cells());
    } else {
        j["kind"] = "surfaces";
        Json groups = Json::array();
        all.dataset = dataset_text(words.surfaces(groups));
        j["objects"] = std::move(groups);
    }
    all.structure = j.dump(-1, ' ', true, Json::error_handler_t::replace);
    return all;
}

bool is_model_text(std::string_view structure) {
    const Json j = Json::parse(structure, nullptr, false);
    return j.is_object() && j.contains("model") && j.contains("counts") && j.contains("kind");
}

std::optional<Dataset> model_from_blocks(std::string_view structure, std::string_view dataset_words, Dataset blocks) {
    const Json j = Json::parse(structure, nullptr, false);
    SortedBlocks sorted = sort_blocks(std::move(blocks));
    const Json& counts = j["counts"];
    if (!counts.is_array() || counts.size() != 4) return std::nullopt;
    for (std::size_t g = 0; g < 4; ++g) {
        if (counts[g] != Json(sorted.groups[g].size())) return std::nullopt;
    }
    std::vector<std::vector<std::uint32_t>> objects;
    std::vector<CellMesh::Entity> entities;
    try {
        if (j["kind"] == "surfaces") {
            objects = j.at("objects").get<std::vector<std::vector<std::uint32_t>>>();
        } else {
            for (const Json& one : j.at("entities")) {
                CellMesh::Entity e;
                e.dimension = one.at("dimension").get<int>();
                e.tag = one.at("tag").get<std::int64_t>();
                e.boundary = one.at("boundary").get<std::vector<std::int64_t>>();
                entities.push_back(std::move(e));
            }
        }
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    Dataset out = std::move(sorted.rest);
    std::vector<Object> made;
    if (j["kind"] == "surfaces") made = surfaces_of_blocks(sorted, objects);
    else if (auto mesh = mesh_of_blocks(sorted, std::move(entities), out.losses)) made.emplace_back(std::move(*mesh));
    if (made.empty()) return std::nullopt;
    out.objects.insert(out.objects.begin(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
    apply_own_text(dataset_words, out);
    return out;
}

}  // namespace geomend::vtk
