// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_exodus.h"

#include <algorithm>
#include <array>
#include <set>

#include "formats/meshes/mesh_writing.h"
#include "formats/meshes/netcdf_file.h"

namespace geomend::meshes {

namespace {

using Type = NetcdfFile::Type;
using Values = NetcdfFile::Values;

constexpr std::size_t longest_name = 32;

struct ElementType {
    CellType type;
    const char* name;
    std::span<const std::uint8_t> order;  ///< per node of Exodus ours
    std::span<const std::uint8_t> sides;  ///< per face of ours the number of the side, from 1
};

constexpr std::uint8_t in_order[] = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr std::uint8_t wedge_order[] = {0, 2, 1, 3, 5, 4};  // the first triangle looks into the cell, ours out of it
constexpr std::uint8_t tetrahedron_sides[] = {4, 1, 2, 3}, wedge_sides[] = {4, 5, 3, 2, 1}, hexahedron_sides[] = {5, 6, 1, 2, 3, 4},
                       pyramid_sides[] = {5, 1, 2, 3, 4};
constexpr std::array element_types = {ElementType{CellType::tetrahedron, "TETRA", {in_order, 4}, tetrahedron_sides},
                                      ElementType{CellType::pyramid, "PYRAMID", {in_order, 5}, pyramid_sides},
                                      ElementType{CellType::wedge, "WEDGE", {wedge_order, 6}, wedge_sides},
                                      ElementType{CellType::hexahedron, "HEX", {in_order, 8}, hexahedron_sides}};

const ElementType& element_of(CellType type) { return *std::ranges::find(element_types, type, &ElementType::type); }

std::string numbered(const char* name, std::size_t number) { return name + std::to_string(number); }

/// A variable of values: one component of an attribute.
struct Component {
    std::string name;
    const Attribute* attribute = nullptr;
    std::uint32_t component = 0;
};

class ExodusWriter {
public:
    ExodusWriter(const VolumeMesh& mesh, std::vector<Loss>& losses) : mesh_(mesh), losses_(losses) {}

    Result<void> write(OutputFile& file);

private:
    std::uint32_t count(const std::string& name, std::size_t size) { return file_.dimension(name, static_cast<std::uint32_t>(size)); }
    void add_points();
    void add_blocks();
    void add_side_sets();
    void add_node_sets();
    void add_values(AttributeLocation location);
    void add_numbers(const char* name, std::uint32_t dimension, std::size_t number, bool are_ids);
    void add_names(const char* name, std::uint32_t dimension, std::vector<std::string> names);
    std::vector<Component> components(AttributeLocation location);

    const VolumeMesh& mesh_;
    std::vector<Loss>& losses_;
    NetcdfFile file_;
    std::uint32_t name_length_ = 0, step_ = 0;
    std::uint32_t nodes_ = 0, block_count_ = 0;
    std::vector<std::uint32_t> block_sizes_;  // dimensions
};

/// Numbers from 1, or as many ones: what is there.
void ExodusWriter::add_numbers(const char* name, std::uint32_t dimension, std::size_t number, bool are_ids) {
    file_.variable(name, Type::int32, {dimension}, [number, are_ids](Values& values) {
        for (std::size_t i = 1; i <= number; ++i) values.integer(are_ids ? static_cast<std::int32_t>(i) : 1);
    });
    if (are_ids) file_.of_last("name", "ID");
}

void ExodusWriter::add_names(const char* name, std::uint32_t dimension, std::vector<std::string> names) {
    file_.variable(name, Type::text, {dimension, name_length_}, [names = std::move(names)](Values& values) {
        for (const std::string& n : names) {
            values.text(n.substr(0, longest_name), longest_name + 1);
        }
    });
}

void ExodusWriter::add_points() {
    const auto space = count("num_dim", 3);
    nodes_ = count("num_nodes", mesh_->vertices.size());
    add_names("coor_names", space, {"x", "y", "z"});
    constexpr std::array names{"coordx", "coordy", "coordz"};
    for (std::size_t k = 0; k < 3; ++k) {
        file_.variable(names[k], Type::float64, {nodes_}, [this, k](Values& values) {
            for (const Vec3& p : mesh_->vertices) values.real(p[k]);
        });
    }
}

void ExodusWriter::add_blocks() {
    count("num_elem", mesh_->cell_count());
    block_count_ = count("num_el_blk", mesh_->blocks.size());
    std::vector<std::string> names;
    std::set<std::string> used(mesh_->regions.begin(), mesh_->regions.end());
    for (const auto& b : mesh_->blocks) {
        const bool is_further = !names.empty() && mesh_->blocks[names.size() - 1].region == b.region;
        std::string name = mesh_->regions[b.region];
        if (is_further) {
            const std::string type = std::string(" ") + element_of(b.type).name;
            name = name.substr(0, longest_name - 8) + type;
            for (int n = 2; !used.insert(name).second; ++n)
                name = mesh_->regions[b.region].substr(0, longest_name - 14) + "_" + std::to_string(n) + type;
        }
        names.push_back(std::move(name));
    }
    add_numbers("eb_status", block_count_, mesh_->blocks.size(), false);
    add_numbers("eb_prop1", block_count_, mesh_->blocks.size(), true);
    add_names("eb_names", block_count_, std::move(names));
    for (std::size_t b = 0; b < mesh_->blocks.size(); ++b) {
        const auto& block = mesh_->blocks[b];
        const ElementType& element = element_of(block.type);
        block_sizes_.push_back(count(numbered("num_el_in_blk", b + 1), block.count));
        const auto corners = count(numbered("num_nod_per_el", b + 1), element.order.size());
        file_.variable(numbered("connect", b + 1), Type::int32, {block_sizes_.back(), corners}, [this, &block, &element](Values& values) {
            for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
                const auto nodes = mesh_->nodes_of(c);
                for (const std::uint8_t i : element.order) values.integer(static_cast<std::int32_t>(nodes[i] + 1));
            }
        });
        file_.of_last("elem_type", element.name);
    }
}

void ExodusWriter::add_side_sets() {
    std::vector<const VolumeMeshData::FaceSet*> sets;  // a set without members would be a dimension without size: that of records
    for (const auto& set : mesh_->face_sets) {
        if (!set.faces.empty()) sets.push_back(&set);
    }
    if (sets.empty()) return;
    const auto number = count("num_side_sets", sets.size());
    add_numbers("ss_status", number, sets.size(), false);
    add_numbers("ss_prop1", number, sets.size(), true);
    std::vector<std::string> names;
    for (const auto* set : sets) names.push_back(set->name);
    add_names("ss_names", number, std::move(names));
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const auto size = count(numbered("num_side_ss", s + 1), sets[s]->faces.size());
        file_.variable(numbered("elem_ss", s + 1), Type::int32, {size}, [set = sets[s]](Values& values) {
            for (const CellFaceRef& f : set->faces) values.integer(static_cast<std::int32_t>(f.cell + 1));
        });
        file_.variable(numbered("side_ss", s + 1), Type::int32, {size}, [this, set = sets[s]](Values& values) {
            for (const CellFaceRef& f : set->faces) values.integer(element_of(mesh_.block_of(f.cell).type).sides[f.face]);
        });
    }
}

void ExodusWriter::add_node_sets() {
    std::vector<const VolumeMeshData::NodeSet*> sets;
    for (const auto& set : mesh_->node_sets) {
        if (!set.nodes.empty()) sets.push_back(&set);
    }
    if (sets.empty()) return;
    const auto number = count("num_node_sets", sets.size());
    add_numbers("ns_status", number, sets.size(), false);
    add_numbers("ns_prop1", number, sets.size(), true);
    std::vector<std::string> names;
    for (const auto* set : sets) names.push_back(set->name);
    add_names("ns_names", number, std::move(names));
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const auto size = count(numbered("num_nod_ns", s + 1), sets[s]->nodes.size());
        file_.variable(numbered("node_ns", s + 1), Type::int32, {size}, [set = sets[s]](Values& values) {
            for (const std::uint32_t n : set->nodes) values.integer(static_cast<std::int32_t>(n + 1));
        });
    }
}

/// One variable for each component, with names that differ.
std::vector<Component> ExodusWriter::components(AttributeLocation location) {
    constexpr std::array axes{"_x", "_y", "_z"};
    std::vector<Component> all;
    std::set<std::string> used;
    for (const Attribute& a : mesh_->attributes) {
        if (a.location != location) continue;
        if (is_text(a)) {
            add_loss(losses_, {LossClass::substance, "", "attribute '" + a.name + "'", "exodus holds numbers only", 1});
            continue;
        }
        for (std::uint32_t c = 0; c < a.components; ++c) {
            const std::string end = a.components == 1 ? "" : a.components == 3 ? axes[c] : "_" + std::to_string(c + 1);
            std::string name = a.name.substr(0, longest_name - end.size()) + end;
            for (int n = 2; !used.insert(name).second; ++n)
                name = a.name.substr(0, longest_name - end.size() - 4) + "_" + std::to_string(n) + end;
            if (name != a.name + end)
                add_loss(losses_, {LossClass::identity, "", "the name of attribute '" + a.name + "'", "exodus has shorter names", 1});
            all.push_back({std::move(name), &a, c});
        }
    }
    return all;
}

void ExodusWriter::add_values(AttributeLocation location) {
    const bool at_points = location == AttributeLocation::point;
    const auto all = components(location);
    if (all.empty()) return;
    const auto number = count(at_points ? "num_nod_var" : "num_elem_var", all.size());
    std::vector<std::string> names;
    for (const Component& c : all) names.push_back(c.name);
    add_names(at_points ? "name_nod_var" : "name_elem_var", number, std::move(names));
    const auto write = [](const Component& c, std::size_t first, std::size_t things) {
        return [c, first, things](Values& values) {
            for (std::size_t i = first; i < first + things; ++i)
                values.real(value_as_double(*c.attribute, i * c.attribute->components + c.component));
        };
    };
    if (!at_points) {
        file_.variable("elem_var_tab", Type::int32, {block_count_, number}, [cells = mesh_->blocks.size() * all.size()](Values& values) {
            for (std::size_t i = 0; i < cells; ++i) values.integer(1);
        });
    }
    for (std::size_t v = 0; v < all.size(); ++v) {
        if (at_points) {
            file_.variable(numbered("vals_nod_var", v + 1), Type::float64, {step_, nodes_}, write(all[v], 0, mesh_->vertices.size()));
            continue;
        }
        for (std::size_t b = 0; b < mesh_->blocks.size(); ++b)
            file_.variable(numbered("vals_elem_var", v + 1) + numbered("eb", b + 1), Type::float64, {step_, block_sizes_[b]},
                           write(all[v], mesh_->blocks[b].first, mesh_->blocks[b].count));
    }
}

Result<void> ExodusWriter::write(OutputFile& file) {
    file_.attribute("api_version", 5.1F);
    file_.attribute("version", 5.1F);
    file_.attribute("floating_point_word_size", std::int32_t{8});
    file_.attribute("file_size", std::int32_t{1});
    file_.attribute("title", in_a_line(mesh_->name).substr(0, 80));
    count("len_string", longest_name + 1);
    count("len_line", 81);
    name_length_ = count("len_name", longest_name + 1);
    count("four", 4);
    step_ = count("time_step", 0);
    file_.variable("time_whole", Type::float64, {step_}, [](Values& values) { values.real(0); });
    add_points();
    add_blocks();
    add_side_sets();
    add_node_sets();
    add_values(AttributeLocation::point);
    add_values(AttributeLocation::cell);
    return file_.write(file);
}

}  // namespace

Result<std::vector<Loss>> write_exodus(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses = common_losses(mesh, "exodus");
    ExodusWriter writer(mesh, losses);
    if (auto written = writer.write(out.main_file()); !written) return std::move(written).why();
    return losses;
}

}  // namespace geomend::meshes
