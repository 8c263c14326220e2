// SPDX-License-Identifier: AGPL-3.0-or-later
// The records of a legacy file become one object.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/vtk/legacy.h"
#include "formats/vtk/legacy_file.h"
#include "formats/vtk/vtk_structure.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

constexpr std::string_view ghost_name = "vtkGhostType";
constexpr std::uint8_t hidden_point = 2, hidden_cell = 32;

std::string_view role_word(LegacyRole role) {
    switch (role) {
        case LegacyRole::scalars:
        case LegacyRole::color_scalars:
            return "Scalars";
        case LegacyRole::vectors:
            return "Vectors";
        case LegacyRole::normals:
            return "Normals";
        case LegacyRole::tensors:
        case LegacyRole::tensors6:
            return "Tensors";
        case LegacyRole::texture:
            return "TCoords";
        case LegacyRole::global_ids:
            return "GlobalIds";
        case LegacyRole::pedigree_ids:
            return "PedigreeIds";
        case LegacyRole::edge_flags:
            return "EdgeFlag";
        case LegacyRole::field:
            break;
    }
    return {};
}

// Types of which the values in memory do not tell the word in the file.
bool type_needs_note(LegacyType type) {
    return type == LegacyType::bit || type == LegacyType::char8 || type == LegacyType::id_type || type == LegacyType::long64 ||
           type == LegacyType::unsigned_long;
}

Attribute attribute_of(LegacyArray&& array, AttributeLocation location) {
    Attribute a;
    a.name = std::move(array.name);
    a.location = location;
    a.components = array.components;
    a.values = std::move(array.values);
    a.unit = std::move(array.unit);
    a.component_names = std::move(array.component_names);
    if (const auto role = role_word(array.role); !role.empty()) a.annotations.emplace_back(attribute_role_key, role);
    if (array.role == LegacyRole::color_scalars) a.annotations.emplace_back("vtk.record", "COLOR_SCALARS");
    if (type_needs_note(array.type)) a.annotations.emplace_back("vtk.type", type_word(array.type));
    if (!array.lookup_table.empty() && !same_word(array.lookup_table, "default"))
        a.annotations.emplace_back("vtk.lookup_table", array.lookup_table);
    if (!array.lookup_values.empty()) {
        std::string text;
        for (const double v : array.lookup_values) {
            if (!text.empty()) text += ' ';
            append_number(text, v);
        }
        a.annotations.emplace_back("vtk.lookup_values", std::move(text));
    }
    if (!array.information.empty()) a.annotations.emplace_back("vtk.information", std::move(array.information));
    return a;
}

template <class T>
std::uint64_t non_finite_in(const std::vector<T>& values) {
    return static_cast<std::uint64_t>(std::ranges::count_if(values, [](T v) { return !std::isfinite(v); }));
}

std::uint64_t non_finite_values(const AttributeValues& values) {
    if (const auto* d = std::get_if<std::vector<double>>(&values)) return non_finite_in(*d);
    if (const auto* f = std::get_if<std::vector<float>>(&values)) return non_finite_in(*f);
    return 0;
}

class Mapper {
public:
    Mapper(LegacyScanner& scanner, LegacyFile& file) : s_(scanner), file_(file) {}

    bool run(Dataset& data);

private:
    bool image(Raster& raster);
    bool rectilinear(Raster& raster);
    bool structured(StructuredGrid& grid);
    bool unstructured(CellMesh& mesh);
    bool polydata(Object& object);

    bool need_dims();
    bool sections(ObjectInfo& info, std::uint64_t points, std::uint64_t cells);
    void fields(ObjectInfo& info);
    bool corners_exist(const LegacyCells& list, const char* what);
    bool corner_fault(const LegacyCells& list, std::uint64_t cell, std::uint64_t corner, const char* what);
    bool polyhedron(MeshBuilder& builder, std::uint64_t cell);
    bool cell_fault(CellProblem problem, std::uint64_t cell);
    void hide_cells(StructuredGrid& grid);
    void note_points(ObjectInfo& info, const char* dataset);
    void back_to_structure(Object& object);

    LegacyScanner& s_;
    LegacyFile& file_;
    std::string text_, structure_;  // what geomend itself put into the file
    std::vector<Finding> findings_;
};

bool Mapper::need_dims() { return file_.dims.has_value() || s_.fail("F012", s_.offset(), "the dataset has no DIMENSIONS record"); }

bool Mapper::sections(ObjectInfo& info, std::uint64_t points, std::uint64_t cells) {
    for (LegacySection& section : file_.sections) {
        const std::uint64_t expected = section.of_cells ? cells : points;
        if (section.arrays.empty()) continue;
        if (section.count != expected)
            return s_.fail("F008", section.offset,
                           std::string(section.of_cells ? "CELL_DATA" : "POINT_DATA") + " states " + std::to_string(section.count) +
                               (section.of_cells ? " cells" : " points") + ", the dataset has " + std::to_string(expected));
        for (LegacyArray& array : section.arrays) {
            const std::uint64_t at = array.offset, strange = non_finite_values(array.values);
            info.attributes.push_back(
                attribute_of(std::move(array), section.of_cells ? AttributeLocation::cell : AttributeLocation::point));
            if (strange != 0)
                findings_.push_back(make_finding("F120", "attribute '" + info.attributes.back().name + "' has values that are not finite",
                                                 s_.location(at), strange));
        }
    }
    return true;
}

// Arrays of the dataset itself. Ours holds what the format has no place for.
void Mapper::fields(ObjectInfo& info) {
    for (LegacyArray& array : file_.fields) {
        const auto* strings = std::get_if<std::vector<std::string>>(&array.values);
        const bool ours = strings != nullptr && strings->size() == 1 && (array.name == text_field || array.name == structure_field);
        if (ours) {
            (array.name == text_field ? text_ : structure_) = strings->front();
            continue;
        }
        const std::string shape = std::to_string(array.components) + ' ' + std::to_string(array.tuples);
        if (array.tuples == 0) {
            info.annotations.push_back({"vtk.field", array.name + ' ' + shape});
            continue;
        }
        const bool one = array.tuples == 1;
        Attribute a = attribute_of(std::move(array), AttributeLocation::object);
        if (!one) {
            a.components = static_cast<std::uint32_t>(value_count(a));
            a.component_names.clear();
            a.annotations.emplace_back("vtk.shape", shape);
        }
        info.attributes.push_back(std::move(a));
    }
}

void Mapper::note_points(ObjectInfo& info, const char* dataset) {
    info.annotations.push_back({std::string(dataset_key), dataset});
    if (file_.points_stated && file_.points_type == LegacyType::float32) info.precision = CoordinatePrecision::single_precision;
}

bool Mapper::image(Raster& raster) {
    if (!need_dims()) return false;
    raster.dims = *file_.dims;
    raster.origin = file_.origin.value_or(Vec3{0, 0, 0});
    const Vec3 spacing = file_.spacing.value_or(Vec3{1, 1, 1});
    for (std::size_t axis = 0; axis < 3; ++axis) raster.step[axis][axis] = spacing[axis];
    note_points(raster.info, "ImageData");
    return sections(raster.info, sample_count(raster.dims), lattice_cell_count(raster.dims));
}

bool Mapper::rectilinear(Raster& raster) {
    if (!need_dims()) return false;
    raster.dims = *file_.dims;
    constexpr const char* names[] = {"X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!file_.coordinates_stated[axis])
            return s_.fail("F008", s_.offset(), std::string("the dataset has no ") + names[axis] + " record");
        if (file_.coordinates[axis].size() != raster.dims[axis])
            return s_.fail("F008", s_.offset(),
                           std::string(names[axis]) + " holds " + std::to_string(file_.coordinates[axis].size()) +
                               " values, DIMENSIONS ask for " + std::to_string(raster.dims[axis]));
        raster.origin[axis] = file_.coordinates[axis].front();
    }
    raster.coordinates = std::move(file_.coordinates);
    note_points(raster.info, "RectilinearGrid");
    return sections(raster.info, sample_count(raster.dims), lattice_cell_count(raster.dims));
}

bool Mapper::structured(StructuredGrid& grid) {
    if (!need_dims()) return false;
    grid.dims = *file_.dims;
    if (file_.points.size() != sample_count(grid.dims))
        return s_.fail("F008", file_.points_offset,
                       "POINTS holds " + std::to_string(file_.points.size()) + " points, DIMENSIONS ask for " +
                           std::to_string(sample_count(grid.dims)));
    if (!file_.blanking.empty() && file_.blanking.size() != file_.points.size())
        return s_.fail(
            "F008", file_.blanking_offset,
            "BLANKING holds " + std::to_string(file_.blanking.size()) + " values for " + std::to_string(file_.points.size()) + " points");
    grid.points = std::move(file_.points);
    note_points(grid.info, "StructuredGrid");
    if (!sections(grid.info, grid.points.size(), lattice_cell_count(grid.dims))) return false;
    hide_cells(grid);
    return true;
}

// A cell is dead where it, or one of its points, is hidden. Point flags stay as an attribute.
void Mapper::hide_cells(StructuredGrid& grid) {
    auto& attributes = grid.info.attributes;
    if (!file_.blanking.empty() && find_attribute(attributes, std::string(ghost_name), AttributeLocation::point) == nullptr) {
        Attribute a;
        a.name = ghost_name;
        auto& flags = a.values.emplace<std::vector<std::uint8_t>>(file_.blanking.size());
        for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = file_.blanking[i] != 0 ? 0 : hidden_point;
        attributes.push_back(std::move(a));
    }
    const auto flags_of = [&](AttributeLocation location) -> const std::vector<std::uint8_t>* {
        const Attribute* a = find_attribute(attributes, std::string(ghost_name), location);
        return a == nullptr || a->components != 1 ? nullptr : std::get_if<std::vector<std::uint8_t>>(&a->values);
    };
    const std::uint64_t cells = lattice_cell_count(grid.dims);
    std::vector<std::uint8_t> dead(static_cast<std::size_t>(cells), 0);
    if (const auto* flags = flags_of(AttributeLocation::point); flags != nullptr && cells != 0) {
        const auto cells_along = [&](std::size_t a) { return std::max(grid.dims[a], 2u) - 1; };
        const auto reach = [&](std::size_t a) { return grid.dims[a] > 1 ? 1u : 0u; };
        std::size_t cell = 0;
        for (std::uint32_t k = 0; k < cells_along(2); ++k)
            for (std::uint32_t j = 0; j < cells_along(1); ++j)
                for (std::uint32_t i = 0; i < cells_along(0); ++i, ++cell)
                    for (std::uint32_t corner = 0; corner < 8; ++corner) {
                        const std::uint32_t di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
                        if (di > reach(0) || dj > reach(1) || dk > reach(2)) continue;
                        const std::size_t p = (std::size_t{k + dk} * grid.dims[1] + j + dj) * grid.dims[0] + i + di;
                        if (((*flags)[p] & hidden_point) != 0) dead[cell] = 1;
                    }
    }
    if (const auto* flags = flags_of(AttributeLocation::cell); flags != nullptr) {
        bool only_hidden = true;
        for (std::size_t i = 0; i < dead.size(); ++i) {
            if (((*flags)[i] & hidden_cell) != 0) dead[i] = 1;
            only_hidden = only_hidden && ((*flags)[i] & ~hidden_cell) == 0;
        }
        if (only_hidden) {
            std::erase_if(attributes, [](const Attribute& a) { return a.name == ghost_name && a.location == AttributeLocation::cell; });
        }
    }
    if (std::ranges::find(dead, 1) != dead.end()) grid.dead_cells = std::move(dead);
}

// The file's own count of values before a corner: the old layout has the size before each list.
bool Mapper::corner_fault(const LegacyCells& list, std::uint64_t cell, std::uint64_t corner, const char* what) {
    const std::uint64_t value = list.cells.corners[corner];
    const std::uint64_t i = corner + (list.counted ? cell + 1 : 0);
    return s_.fail_at("F007", s_.value_location(list.values_offset, list.values_type, i),
                      std::string("cell ") + std::to_string(cell) + " of " + what + " uses point " + std::to_string(value) +
                          ", but the points end at " + std::to_string(static_cast<std::int64_t>(file_.points.size()) - 1));
}

bool Mapper::corners_exist(const LegacyCells& list, const char* what) {
    const std::size_t points = file_.points.size();
    const auto& corners = list.cells.corners;
    std::size_t first_bad = 0;
    while (first_bad < corners.size() && corners[first_bad] < points) ++first_bad;
    if (first_bad == corners.size()) return true;
    const auto after = std::ranges::upper_bound(list.cells.offsets, first_bad);
    return corner_fault(list, static_cast<std::uint64_t>(after - list.cells.offsets.begin()) - 1, first_bad, what);
}

bool Mapper::cell_fault(CellProblem problem, std::uint64_t cell) {
    const std::uint32_t type = file_.types[cell];
    const bool known = problem != CellProblem::unknown_type;
    const Location where = known ? s_.value_location(file_.cells.values_offset, file_.cells.values_type,
                                                     file_.cells.cells.offsets[cell] + (file_.cells.counted ? cell : 0))
                                 : s_.value_location(file_.types_values_offset, LegacyType::int32, cell);
    if (!known)
        return s_.fail_at("F013", where, "cell " + std::to_string(cell) + " is a " + unknown_cell_name(type) + ", which cannot be read");
    if (problem == CellProblem::bad_faces)
        return s_.fail_at(
            "F008", where,
            "the faces of polyhedron " + std::to_string(cell) + " do not fill its list of values, or have fewer than 3 points");
    return s_.fail_at("F008", where,
                      "cell " + std::to_string(cell) + " of CELL_TYPES " + std::to_string(type) + " cannot have " +
                          std::to_string(file_.cells.cells[cell].size()) + " points");
}

// Number of faces, and for each face its number of points and the points.
bool Mapper::polyhedron(MeshBuilder& builder, std::uint64_t cell) {
    const auto stream = file_.cells.cells[cell];
    if (stream.empty()) return cell_fault(CellProblem::bad_faces, cell);
    std::uint64_t at = 1;
    for (std::uint32_t face = 0; face < stream[0]; ++face) {
        if (at >= stream.size() || stream[at] > stream.size() - at - 1) return cell_fault(CellProblem::bad_faces, cell);
        for (std::uint64_t k = at + 1; k <= at + stream[at]; ++k) {
            if (stream[k] >= file_.points.size()) return corner_fault(file_.cells, cell, file_.cells.cells.offsets[cell] + k, "CELLS");
        }
        at += stream[at] + 1;
    }
    if (at != stream.size()) return cell_fault(CellProblem::bad_faces, cell);
    const CellProblem problem = builder.add_polyhedron({}, stream.subspan(1));
    return problem == CellProblem::none || cell_fault(problem, cell);
}

bool Mapper::unstructured(CellMesh& mesh) {
    const CellList& cells = file_.cells.cells;
    if (!file_.types_stated && cells.size() != 0) return s_.fail("F008", file_.cells.offset, "CELLS stands without CELL_TYPES");
    if (cells.size() != file_.types.size())
        return s_.fail("F008", file_.types_offset,
                       "CELL_TYPES holds " + std::to_string(file_.types.size()) + " values for " + std::to_string(cells.size()) + " cells");
    if (cells.size() >= no_index) return s_.fail("F014", file_.cells.offset, "more than 4294967294 cells cannot be read");
    const bool polyhedra = std::ranges::find(file_.types, 42u) != file_.types.end();
    if (!polyhedra && !corners_exist(file_.cells, "CELLS")) return false;
    MeshBuilder builder(mesh);
    builder.reserve(cells.size(), cells.corners.size());
    for (std::uint64_t i = 0; i < cells.size(); ++i) {
        if ((i & 0xffff) == 0 && s_.stopped()) return false;
        if (file_.types[i] == 42) {
            if (!polyhedron(builder, i)) return false;
            continue;
        }
        if (polyhedra) {
            for (std::uint64_t k = cells.offsets[i]; k < cells.offsets[i + 1]; ++k) {
                if (cells.corners[k] >= file_.points.size()) return corner_fault(file_.cells, i, k, "CELLS");
            }
        }
        const CellProblem problem = builder.add(file_.types[i], cells[i]);
        if (problem != CellProblem::none) return cell_fault(problem, i);
    }
    if (builder.empty_cells() != 0)
        drop(findings_, file_.losses,
             {.loss_class = LossClass::identity,
              .what = "empty cells",
              .why = "they have no nodes",
              .count = builder.empty_cells(),
              .where = s_.location(file_.types_offset),
              .code = "F119",
              .message = "empty cells are left out"});
    drop_further_points(builder.corner_cells(), s_.location(file_.types_offset), findings_, file_.losses);
    const std::uint64_t point_count = file_.points.size();
    mesh.points = std::move(file_.points);
    note_points(mesh.info, "UnstructuredGrid");
    if (!sections(mesh.info, point_count, cells.size())) return false;
    builder.fit(mesh.info.attributes);
    return true;
}

bool Mapper::polydata(Object& object) {
    const std::pair<LegacyCells*, const char*> lists[] = {
        {&file_.verts, "VERTICES"}, {&file_.lines, "LINES"}, {&file_.polys, "POLYGONS"}, {&file_.strips, "TRIANGLE_STRIPS"}};
    for (const auto& [list, name] : lists) {
        if (!corners_exist(*list, name)) return false;
    }
    PolyData data;
    data.verts = std::move(file_.verts.cells);
    data.lines = std::move(file_.lines.cells);
    data.polys = std::move(file_.polys.cells);
    data.strips = std::move(file_.strips.cells);
    data.points = std::move(file_.points);
    if (data.cell_count() >= no_index) return s_.fail("F014", file_.polys.offset, "more than 4294967294 cells cannot be read");
    note_points(data.info, "PolyData");
    if (!sections(data.info, data.points.size(), data.cell_count())) return false;
    object = object_from_polydata(std::move(data));
    return true;
}

// The raster that a grid was, where its points still stand on the lattice exactly.
bool raster_of(const StructuredGrid& grid, std::string_view structure, Raster& raster) {
    if (!grid.dead_cells.empty() || grid.points.empty()) return false;
    raster.dims = grid.dims;
    raster.origin = grid.points.front();
    const std::array<std::size_t, 3> next{1, grid.dims[0], std::size_t{grid.dims[0]} * grid.dims[1]};
    for (std::size_t d = 0; d < 3; ++d) {
        if (grid.dims[d] == 1) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) raster.step[d][axis] = grid.points[next[d]][axis] - grid.points[0][axis];
    }
    raster.info = grid.info;
    Object object = std::move(raster);
    if (!restore_structure(structure, object)) return false;
    raster = std::get<Raster>(std::move(object));
    std::size_t at = 0;
    for (std::uint32_t k = 0; k < raster.dims[2]; ++k)
        for (std::uint32_t j = 0; j < raster.dims[1]; ++j)
            for (std::uint32_t i = 0; i < raster.dims[0]; ++i) {
                if (sample_position(raster, i, j, k) != grid.points[at++]) return false;
            }
    return true;
}

void Mapper::back_to_structure(Object& object) {
    if (const auto* grid = std::get_if<StructuredGrid>(&object);
        grid != nullptr && structure_.find(R"("kind":"raster")") != std::string::npos) {
        Raster raster;
        if (raster_of(*grid, structure_, raster)) object = std::move(raster);
        return;
    }
    if (!restore_structure(structure_, object))
        info_of(object).annotations.push_back({"vtk.field", std::string(structure_field) + ' ' + structure_});
}

constexpr std::string_view kind_word(LegacyKind kind) {
    switch (kind) {
        case LegacyKind::structured_points:
            return "STRUCTURED_POINTS";
        case LegacyKind::structured_grid:
            return "STRUCTURED_GRID";
        case LegacyKind::rectilinear_grid:
            return "RECTILINEAR_GRID";
        case LegacyKind::unstructured_grid:
            return "UNSTRUCTURED_GRID";
        case LegacyKind::polydata:
            return "POLYDATA";
        default:
            return "FIELD";
    }
}

bool Mapper::run(Dataset& data) {
    data.format = "vtk";
    data.variant = "legacy " + std::to_string(file_.major_version) + '.' + std::to_string(file_.minor_version) +
                   (file_.binary ? " binary, " : " text, ") + std::string(kind_word(file_.kind));
    Object object;
    bool good = true;
    switch (file_.kind) {
        case LegacyKind::structured_points:
            good = image(object.emplace<Raster>());
            break;
        case LegacyKind::rectilinear_grid:
            good = rectilinear(object.emplace<Raster>());
            break;
        case LegacyKind::structured_grid:
            good = structured(object.emplace<StructuredGrid>());
            break;
        case LegacyKind::unstructured_grid:
            good = unstructured(object.emplace<CellMesh>());
            break;
        case LegacyKind::polydata:
            good = polydata(object);
            break;
        default:
            break;
    }
    if (!good) return false;
    if (file_.kind == LegacyKind::field) {
        ObjectInfo none;
        fields(none);
        for (const Attribute& a : none.attributes)
            list_dropped(data.losses, {LossClass::substance, a.name, "array '" + a.name + "'", "it stands on no geometry"});
        findings_.push_back(make_finding("F119", "the file holds arrays only, and no geometry", s_.location(0), 1));
    } else {
        ObjectInfo& info = info_of(object);
        fields(info);
        std::vector<Annotation> own = std::move(info.annotations);
        if (!file_.title.empty()) own.push_back({"vtk.title", file_.title});
        info.annotations.clear();
        if (!structure_.empty()) back_to_structure(object);
        data.objects.push_back(std::move(object));
        if (!text_.empty() && !apply_dataset_text(text_, data))
            info_of(data.objects[0]).annotations.push_back({"vtk.field", "geomend " + text_});
        // What this file says of itself goes before what an earlier one said.
        auto& annotations = info_of(data.objects[0]).annotations;
        std::erase_if(annotations, [&](const Annotation& a) { return std::ranges::find(own, a.key, &Annotation::key) != own.end(); });
        annotations.insert(annotations.begin(), own.begin(), own.end());
    }
    std::ranges::move(file_.findings, std::back_inserter(data.findings));
    std::ranges::move(findings_, std::back_inserter(data.findings));
    for (Loss& loss : file_.losses) add_loss(data.losses, std::move(loss));
    return true;
}

}  // namespace

Result<Dataset> read_legacy(const Input& input, const ReadOptions& options) {
    if (input.bytes().empty()) return unreadable("F002", {input.name()}, "the file is empty");
    LegacyScanner scanner(input, options.monitor);
    LegacyFile file;
    Dataset data;
    if (!parse_legacy(scanner, file) || !Mapper(scanner, file).run(data)) return scanner.take_failure();
    // The format has no place for a name: one that says nothing more is called after its file, as in XML.
    if (data.objects.size() == 1 && info_of(data.objects[0]).name.empty())
        info_of(data.objects[0]).name = std::filesystem::path(input.base_name()).stem().string();
    return data;
}

int sniff_legacy(std::string_view head, std::string_view) {
    constexpr std::string_view signature = "# vtk DataFile Version";
    return same_word(head.substr(0, signature.size()), signature) ? 100 : 0;
}

}  // namespace geomend::vtk
