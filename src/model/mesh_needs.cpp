// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/mesh_needs.h"

#include <algorithm>
#include <array>
#include <string>

namespace geomend {

namespace {

constexpr auto tet_and_hex = static_cast<CellKinds>(tetrahedra | hexahedra);
constexpr auto no_pyramid = static_cast<CellKinds>(tetrahedra | wedges | hexahedra);

// Columns: target, cells, order, sorted, splitting, winding, middle nodes, names, face sets, face sides, edge sets, node sets, values
// at points, values of cells, longest name, network, faces once, one name space.
constexpr std::array<MeshNeeds, 20> rows{{
    {"abaqus", simple_cells, 2, CellOrder::any, Splitting::as_given, CornerOrder::outward, false, Naming::words, true, true, true, true,
     false, false, 80},
    {"avs-ucd", simple_cells, 1, CellOrder::any, Splitting::as_given, CornerOrder::outward, false, Naming::numbers, false, false, false,
     false, true, true, 0},
    {"cgns", simple_cells, 2, CellOrder::by_region_and_type, Splitting::as_given, CornerOrder::outward, false, Naming::texts, true, true,
     false, true, true, true, 32, false, false, true},
    {"code-aster", simple_cells, 1, CellOrder::by_type, Splitting::on_faults, CornerOrder::outward, false, Naming::words, true, true, true,
     true, false, false, 24, false, false, true},
    {"csmp", simple_cells, 1, CellOrder::by_region_and_type, Splitting::as_given, CornerOrder::outward, false, Naming::words, true, false,
     true, false, false, false, 0, true, true, true},
    {"exodus", simple_cells, 1, CellOrder::by_region_and_type, Splitting::as_given, CornerOrder::outward, false, Naming::texts, true, true,
     false, true, true, true, 32},
    {"feflow", no_pyramid, 1, CellOrder::any, Splitting::none, CornerOrder::outward, false, Naming::texts, false, false, true, false, false,
     false, 0},
    {"geos", simple_cells, 1, CellOrder::any, Splitting::as_given, CornerOrder::outward, false, Naming::texts, true, true, false, true,
     true, true, 0},
    {"gmsh", simple_cells, 2, CellOrder::any, Splitting::as_given, CornerOrder::outward, true, Naming::texts, true, true, true, true, true,
     true, 0},
    {"gprs", all_cells, 1, CellOrder::any, Splitting::none, CornerOrder::either, false, Naming::numbers, false, false, false, false, false,
     false, 0, true},
    {"light-tsolid", tetrahedra, 1, CellOrder::by_region, Splitting::on_all_surfaces, CornerOrder::outward, false, Naming::texts, true,
     true, false, false, true, true, 0},
    {"medit", no_pyramid, 1, CellOrder::by_type, Splitting::as_given, CornerOrder::outward, false, Naming::numbers, true, false, true,
     false, false, false, 0, false, true},
    {"mfem", tet_and_hex, 1, CellOrder::any, Splitting::as_given, CornerOrder::outward, false, Naming::numbers, true, false, false, false,
     false, false, 0, false, true},
    {"modflow-disu", all_cells, 1, CellOrder::any, Splitting::none, CornerOrder::either, false, Naming::numbers, false, false, false, false,
     false, false, 0, true},
    {"openfoam", all_cells, 1, CellOrder::any, Splitting::as_given, CornerOrder::outward, false, Naming::words, true, true, false, true,
     false, false, 0, true, true},
    {"pflotran", all_cells, 1, CellOrder::any, Splitting::none, CornerOrder::either, false, Naming::words, true, false, false, false, false,
     false, 32, true},
    {"tetgen", tetrahedra, 2, CellOrder::any, Splitting::as_given, CornerOrder::outward, false, Naming::numbers, true, false, false, false,
     true, false, 0, true, true},
    {"tough2", all_cells, 1, CellOrder::any, Splitting::none, CornerOrder::either, false, Naming::words, false, false, false, false, false,
     false, 5, true},
    {"tsolid", tetrahedra, 1, CellOrder::by_region, Splitting::on_all_surfaces, CornerOrder::outward, false, Naming::texts, true, true,
     false, false, true, true, 0},
    {"vtk", all_cells, 2, CellOrder::any, Splitting::as_given, CornerOrder::outward, true, Naming::texts, true, true, true, true, true,
     true, 0},
}};

class LossList {
public:
    explicit LossList(const MeshNeeds& needs) : needs_(needs) {}

    void add(LossClass loss_class, std::string entity, std::string what, const char* why, std::uint64_t count = 1) {
        add_loss(list_, {loss_class, std::move(entity), std::move(what), std::string(needs_.target) + " " + why, count});
    }
    void name(const std::string& name, const char* of) {
        if (needs_.names == Naming::numbers) add(LossClass::identity, name, std::string("name of the ") + of, "has numbers only");
        else if (needs_.longest_name > 0 && name.size() > needs_.longest_name)
            add(LossClass::identity, name, "the end of the name", "has shorter names");
    }
    std::vector<Loss> taken() { return std::move(list_); }

private:
    const MeshNeeds& needs_;
    std::vector<Loss> list_;
};

void add_cell_losses(const VolumeMesh& mesh, const MeshNeeds& needs, LossList& list) {
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        const std::string& region = mesh->regions[block.region];
        if ((kind_of(block.type) & needs.cells) == 0) {
            list.add(LossClass::substance, region, std::string("cells: ") + to_string(linear_type(block.type)), "has no such cells",
                     block.count);
        } else if (is_second_order(block.type) && needs.order < 2) {
            list.add(LossClass::substance, region, "nodes on edges", "has cells of first order only", block.count);
        } else if (has_middle_nodes(block.type) && !needs.middle_nodes) {
            list.add(LossClass::substance, region, "nodes in the middle of faces and cells", "has nodes on edges only", block.count);
        }
    }
}

void add_set_losses(const VolumeMesh& mesh, const MeshNeeds& needs, LossList& list) {
    for (const auto& set : mesh->face_sets) {
        if (set.surface == no_index && !needs.face_sets) continue;  // what lies between or around regions, which nobody stated
        if (!needs.face_sets) list.add(LossClass::substance, set.name, "face set", "has no face sets", set.faces.size());
        else if (!needs.face_sides && set.side != FaceSide::none) list.add(LossClass::identity, set.name, "side of faces", "has no sides");
        if (needs.face_sets) list.name(set.name, "face set");
    }
    for (const auto& set : mesh->edge_sets) {
        if (!needs.edge_sets) list.add(LossClass::substance, set.name, "edge set", "has no edge sets", set.edges.size());
        else list.name(set.name, "edge set");
    }
    for (const auto& set : mesh->node_sets) {
        if (!needs.node_sets) list.add(LossClass::substance, set.name, "node set", "has no node sets", set.nodes.size());
        else list.name(set.name, "node set");
    }
}

}  // namespace

CellKinds kind_of(CellType type) {
    switch (linear_type(type)) {
        case CellType::tetrahedron:
            return tetrahedra;
        case CellType::pyramid:
            return pyramids;
        case CellType::wedge:
            return wedges;
        case CellType::hexahedron:
            return hexahedra;
        case CellType::polyhedron:
            return polyhedra;
        default:
            return prisms;
    }
}

bool has_middle_nodes(CellType type) { return type == CellType::triquadratic_hexahedron || type == CellType::biquadratic_wedge; }

std::span<const MeshNeeds> mesh_needs() { return rows; }

const MeshNeeds* find_mesh_needs(std::string_view target) {
    const auto at =
        std::lower_bound(rows.begin(), rows.end(), target, [](const MeshNeeds& row, std::string_view t) { return row.target < t; });
    return at != rows.end() && at->target == target ? &*at : nullptr;
}

std::vector<Loss> losses(const VolumeMesh& mesh, const MeshNeeds& needs) {
    LossList list(needs);
    add_cell_losses(mesh, needs, list);
    for (const std::string& region : mesh->regions) list.name(region, "region");
    add_set_losses(mesh, needs, list);
    for (const Attribute& a : mesh->attributes) {
        const bool kept =
            a.location == AttributeLocation::point ? needs.point_values : a.location == AttributeLocation::cell && needs.cell_values;
        if (!kept) list.add(LossClass::substance, "", "attribute '" + a.name + "'", "has no place for it");
    }
    return list.taken();
}

}  // namespace geomend
