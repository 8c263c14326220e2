// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_pieces.h"

#include <algorithm>
#include <cmath>

#include "base/text_cursor.h"
#include "formats/drop.h"

namespace geomend::vtk {

namespace {

constexpr std::uint64_t most_points = 0xfffffffeu;

struct KindRow {
    DatasetKind kind;
    const char* element;
};
constexpr KindRow kinds[] = {{DatasetKind::unstructured, "UnstructuredGrid"},
                             {DatasetKind::poly, "PolyData"},
                             {DatasetKind::structured, "StructuredGrid"},
                             {DatasetKind::image, "ImageData"},
                             {DatasetKind::rectilinear, "RectilinearGrid"}};

class PieceReader {
public:
    PieceReader(const XmlDocument& doc, const XmlEncoding& encoding, DatasetKind kind, const XmlElement& piece, ReadNotes& notes)
        : doc_(doc), encoding_(encoding), kind_(kind), piece_(piece), notes_(notes) {}

    Result<Piece> run() {
        Result<void> done = kind_ == DatasetKind::unstructured ? unstructured() : kind_ == DatasetKind::poly ? poly() : lattice();
        if (!done) return std::move(done).why();
        return std::move(out_);
    }

private:
    const XmlDocument& doc_;
    const XmlEncoding& encoding_;
    DatasetKind kind_;
    const XmlElement& piece_;
    ReadNotes& notes_;
    Piece out_;

    Failure fail(const char* code, const XmlElement& at, const std::string& message) const {
        return unreadable(code, doc_.where(at), message);
    }

    Result<std::uint64_t> count(std::string_view name, bool needed) const {
        bool found = false;
        const std::string_view text = doc_.raw_attribute(piece_, name, &found);
        if (!found && !needed) return std::uint64_t{0};
        const auto value = count_attribute(doc_, piece_, name);
        if (!value)
            return fail("F005", piece_, "expected a count in " + std::string(name) + ", found '" + std::string(text.substr(0, 40)) + "'");
        if (*value > most_points)
            return fail("F014", piece_, std::string(name) + " is " + std::to_string(*value) + ", more than the file can hold");
        return *value;
    }

    static std::string array_name(const XmlDocument& doc, const XmlElement& array) { return doc.attribute(array, "Name"); }

    const XmlElement* named_array(const XmlElement& section, std::string_view name) const {
        for (const XmlElement* a = doc_.child(section, "DataArray"); a != nullptr; a = doc_.child(section, "DataArray", a)) {
            if (same_word(doc_.raw_attribute(*a, "Name"), name)) return a;
        }
        return nullptr;
    }

    // ---- points ----

    template <class T>
    Result<void> take_points(const std::vector<T>& values, const XmlElement& array) {
        out_.points.resize(values.size() / 3);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto x = static_cast<double>(values[i]);
            if (!std::isfinite(x))
                return fail("F006", array, "expected a finite coordinate, found " + number_text(x) + " at point " + std::to_string(i / 3));
            out_.points[i / 3][i % 3] = x;
        }
        return {};
    }

    Result<void> read_points(std::uint64_t count) {
        const XmlElement* section = doc_.child(piece_, "Points");
        const XmlElement* array = section != nullptr ? doc_.child(*section, "DataArray") : nullptr;
        if (array == nullptr) {
            if (count == 0) return {};
            return fail("F012", piece_, "expected a DataArray inside Points for " + std::to_string(count) + " points, found none");
        }
        const auto components = components_of(doc_, *array, 3);
        if (!components) return std::move(components).why();
        if (*components != 3) return fail("F012", *array, "expected points of 3 components, found " + std::to_string(*components));
        auto values = decode_array(doc_, encoding_, *array, 3 * count);
        if (!values) return std::move(values).why();
        out_.single_precision = std::holds_alternative<std::vector<float>>(*values);
        return std::visit(
            [&](const auto& v) -> Result<void> {
                if constexpr (std::is_arithmetic_v<typename std::decay_t<decltype(v)>::value_type>) return take_points(v, *array);
                else return fail("F013", *array, "expected numbers as coordinates, found text");
            },
            *values);
    }

    // ---- numbers of points and offsets ----

    /// Integers of any type, each from 0 and below `limit`.
    template <class To>
    Result<std::vector<To>> integers(const XmlElement& array, std::optional<std::uint64_t> expected, std::uint64_t limit,
                                     const char* what) const {
        auto values = decode_array(doc_, encoding_, array, expected);
        if (!values) return std::move(values).why();
        return std::visit(
            [&](auto& v) -> Result<std::vector<To>> {
                using From = typename std::decay_t<decltype(v)>::value_type;
                if constexpr (!std::is_integral_v<From>) {
                    return fail("F013", array, std::string("expected integers as ") + what);
                } else if constexpr (std::is_same_v<From, To>) {
                    for (std::size_t i = 0; i < v.size(); ++i) {
                        if (v[i] >= limit) return out_of_range(array, i, std::to_string(v[i]), limit, what);
                    }
                    return std::move(v);
                } else {
                    std::vector<To> to(v.size());
                    for (std::size_t i = 0; i < v.size(); ++i) {
                        if (std::cmp_less(v[i], 0) || std::cmp_greater_equal(v[i], limit))
                            return out_of_range(array, i, std::to_string(v[i]), limit, what);
                        to[i] = static_cast<To>(v[i]);
                    }
                    return to;
                }
            },
            *values);
    }

    Failure out_of_range(const XmlElement& array, std::size_t i, const std::string& found, std::uint64_t limit, const char* what) const {
        return fail("F007", array,
                    std::string("expected ") + what + " from 0 to " + std::to_string(limit == 0 ? 0 : limit - 1) +
                        (limit == 0 ? " (there are none)" : "") + ", found " + found + " at position " + std::to_string(i));
    }

    struct Cells {
        CellList list;
        const XmlElement* offsets = nullptr;
        const XmlElement* connectivity = nullptr;
    };

    Result<Cells> read_cells(const XmlElement* section, std::uint64_t count, const char* what) const {
        Cells cells;
        if (section != nullptr) {
            cells.connectivity = named_array(*section, "connectivity");
            cells.offsets = named_array(*section, "offsets");
        }
        if (count == 0) return cells;
        if (cells.connectivity == nullptr || cells.offsets == nullptr)
            return fail("F012", section != nullptr ? *section : piece_,
                        "expected arrays 'connectivity' and 'offsets' for " + std::to_string(count) + " " + what);
        auto ends = integers<std::uint64_t>(*cells.offsets, count, std::uint64_t{1} << 62, "offsets");
        if (!ends) return std::move(ends).why();
        std::uint64_t before = 0;
        for (std::size_t i = 0; i < ends->size(); ++i) {
            if ((*ends)[i] < before) return fail("F008", *cells.offsets, "the offsets of the cells go down at cell " + std::to_string(i));
            before = (*ends)[i];
        }
        auto corners = integers<std::uint32_t>(*cells.connectivity, before, out_.points.size(), "a point number");
        if (!corners) return std::move(corners).why();
        cells.list.corners = std::move(*corners);
        ends->insert(ends->begin(), 0);
        cells.list.offsets = std::move(*ends);
        return cells;
    }

    // ---- unstructured ----

    Result<void> unstructured() {
        const auto points = count("NumberOfPoints", true);
        if (!points) return points.why();
        const auto cells = count("NumberOfCells", true);
        if (!cells) return cells.why();
        if (auto done = read_points(*points); !done) return done;
        const XmlElement* section = doc_.child(piece_, "Cells");
        auto list = read_cells(section, *cells, "cells");
        if (!list) return std::move(list).why();
        MeshBuilder builder(out_.mesh);
        if (*cells != 0) {
            if (auto done = build_cells(*section, *list, builder); !done) return done;
        }
        if (auto done = read_attributes(points.value(), cells.value()); !done) return done;
        builder.fit(out_.attributes);
        out_.empty_cells = builder.empty_cells();
        out_.corner_cells = builder.corner_cells();
        return {};
    }

    Result<void> build_cells(const XmlElement& section, Cells& cells, MeshBuilder& builder) {
        const XmlElement* types_array = named_array(section, "types");
        if (types_array == nullptr) return fail("F012", section, "expected an array 'types' of cell types, found none");
        auto types = integers<std::uint32_t>(*types_array, cells.list.size(), 256, "a cell type");
        if (!types) return std::move(types).why();
        const bool polyhedra = std::ranges::find(*types, 42u) != types->end();
        CellList streams;
        if (polyhedra) {
            auto read = face_streams(section, *types);
            if (!read) return std::move(read).why();
            streams = std::move(*read);
        }
        builder.reserve(cells.list.size(), cells.list.corners.size());
        for (std::size_t i = 0; i < cells.list.size(); ++i) {
            const std::uint32_t type = (*types)[i];
            const CellProblem problem = type == 42 ? builder.add_polyhedron(cells.list[i], streams[i]) : builder.add(type, cells.list[i]);
            if (problem == CellProblem::none) continue;
            const std::string cell = "cell " + std::to_string(i);
            if (problem == CellProblem::unknown_type)
                return fail("F013", *types_array, cell + " is a " + unknown_cell_name(type) + ", which cannot be read");
            if (problem == CellProblem::bad_faces)
                return fail("F012", section, "the faces of " + cell + ", a polyhedron, are not well formed");
            return fail("F008", *cells.offsets,
                        cell + " of type " + std::to_string(type) + " has " + std::to_string(cells.list[i].size()) + " points");
        }
        return {};
    }

    /// Faces of each cell as MeshBuilder takes them (without the leading number of faces); empty for other cells.
    Result<CellList> face_streams(const XmlElement& section, const std::vector<std::uint32_t>& types) const {
        const XmlElement* faces = named_array(section, "faces");
        const XmlElement* ends = named_array(section, "faceoffsets");
        if (faces == nullptr || ends == nullptr) return newer_face_streams(section, types);
        auto values = decode_array(doc_, encoding_, *ends, types.size());
        if (!values) return std::move(values).why();
        std::vector<std::int64_t> last(types.size());
        for (std::size_t i = 0; i < types.size(); ++i) {
            last[i] = std::visit(
                [&](const auto& v) -> std::int64_t {
                    if constexpr (std::is_integral_v<typename std::decay_t<decltype(v)>::value_type>)
                        return static_cast<std::int64_t>(v[i]);
                    else return -1;
                },
                *values);
        }
        auto stream = integers<std::uint32_t>(*faces, std::nullopt, 0xffffffffu, "a face entry");
        if (!stream) return std::move(stream).why();
        CellList all;
        all.corners.reserve(stream->size());
        std::int64_t first = 0;
        for (std::size_t i = 0; i < types.size(); ++i) {
            if (types[i] == 42) {
                if (last[i] <= first || std::cmp_greater(last[i], stream->size()))
                    return fail("F008", *ends,
                                "the face offset of cell " + std::to_string(i) + " is " + std::to_string(last[i]) +
                                    ", expected one above " + std::to_string(first) + " and up to " + std::to_string(stream->size()));
                if (auto done = take_faces(*faces, *stream, first, last[i], i, all); !done) return std::move(done).why();
                first = last[i];
            }
            all.offsets.push_back(all.corners.size());
        }
        return all;
    }

    Result<void> take_faces(const XmlElement& faces, const std::vector<std::uint32_t>& stream, std::int64_t first, std::int64_t last,
                            std::size_t cell, CellList& all) const {
        const std::uint32_t face_count = stream[static_cast<std::size_t>(first)];
        std::int64_t at = first + 1;
        std::uint32_t found = 0;
        while (at < last && found < face_count) {
            const std::int64_t size = stream[static_cast<std::size_t>(at)];
            if (size > last - at - 1) break;
            all.corners.push_back(static_cast<std::uint32_t>(size));
            for (std::int64_t k = 1; k <= size; ++k) {
                const std::uint32_t point = stream[static_cast<std::size_t>(at + k)];
                if (point >= out_.points.size())
                    return fail("F007", faces,
                                "a face of cell " + std::to_string(cell) + " names point " + std::to_string(point) + ", but there are " +
                                    std::to_string(out_.points.size()));
                all.corners.push_back(point);
            }
            at += size + 1;
            ++found;
        }
        if (found == face_count && at == last) return {};
        return fail("F008", faces,
                    "cell " + std::to_string(cell) + " says that it has " + std::to_string(face_count) +
                        " faces, which does not fit its face offsets");
    }

    // VTK 9.4 and later: faces once, and lists of faces per polyhedron.
    Result<CellList> newer_face_streams(const XmlElement& section, const std::vector<std::uint32_t>& types) const {
        const XmlElement* nodes = named_array(section, "face_connectivity");
        const XmlElement* node_ends = named_array(section, "face_offsets");
        const XmlElement* faces = named_array(section, "polyhedron_to_faces");
        const XmlElement* face_ends = named_array(section, "polyhedron_offsets");
        if (nodes == nullptr || node_ends == nullptr || faces == nullptr || face_ends == nullptr)
            return fail("F012", section, "expected arrays 'faces' and 'faceoffsets' for polyhedra, found none");
        constexpr std::uint64_t any = std::uint64_t{1} << 62;
        auto node_list = integers<std::uint32_t>(*nodes, std::nullopt, out_.points.size(), "a point number");
        if (!node_list) return std::move(node_list).why();
        auto node_end_list = integers<std::uint64_t>(*node_ends, std::nullopt, any, "offsets");
        if (!node_end_list) return std::move(node_end_list).why();
        auto face_list = integers<std::uint32_t>(*faces, std::nullopt, node_end_list->size(), "a face number");
        if (!face_list) return std::move(face_list).why();
        auto face_end_list = integers<std::uint64_t>(*face_ends, types.size(), any, "offsets");
        if (!face_end_list) return std::move(face_end_list).why();
        CellList all;
        std::uint64_t first = 0;
        const std::uint64_t budget = 64 * (node_list->size() + face_list->size()) + 1024;  // a face belongs to two cells
        for (std::size_t i = 0; i < types.size(); ++i) {
            const std::uint64_t last = types[i] == 42 ? (*face_end_list)[i] : first;
            if (last < first || last > face_list->size())
                return fail("F008", *face_ends, "the offsets of the faces go down or too far at cell " + std::to_string(i));
            for (; first < last; ++first) {
                const std::uint32_t face = (*face_list)[first];
                const std::uint64_t begin = face == 0 ? 0 : (*node_end_list)[face - 1], end = (*node_end_list)[face];
                if (begin > end || end > node_list->size())
                    return fail("F008", *node_ends, "the offsets of the face points go down or too far");
                all.corners.push_back(static_cast<std::uint32_t>(end - begin));
                all.corners.insert(all.corners.end(), node_list->begin() + static_cast<std::ptrdiff_t>(begin),
                                   node_list->begin() + static_cast<std::ptrdiff_t>(end));
                if (all.corners.size() > budget) return fail("F014", *faces, "the polyhedra use the same faces too often");
            }
            all.offsets.push_back(all.corners.size());
        }
        return all;
    }

    // ---- poly ----

    Result<void> poly() {
        const auto points = count("NumberOfPoints", true);
        if (!points) return points.why();
        if (auto done = read_points(*points); !done) return done;
        struct Section {
            const char* count;
            const char* element;
            const char* what;
            CellList* list;
        };
        const Section sections[] = {{"NumberOfVerts", "Verts", "vertex cells", &out_.poly.verts},
                                    {"NumberOfLines", "Lines", "lines", &out_.poly.lines},
                                    {"NumberOfPolys", "Polys", "polygons", &out_.poly.polys},
                                    {"NumberOfStrips", "Strips", "strips", &out_.poly.strips}};
        for (const Section& s : sections) {
            const auto n = count(s.count, false);
            if (!n) return n.why();
            auto cells = read_cells(doc_.child(piece_, s.element), *n, s.what);
            if (!cells) return std::move(cells).why();
            *s.list = std::move(cells->list);
        }
        return read_attributes(points.value(), out_.poly.cell_count());
    }

    // ---- lattices ----

    Result<void> lattice() {
        auto extent = read_extent(doc_, piece_, "Extent");
        if (!extent) return std::move(extent).why();
        out_.extent = *extent;
        const auto dims = dims_of(out_.extent);
        const std::uint64_t points = sample_count(dims);
        std::uint64_t cells = points == 0 ? 0 : 1;
        for (const std::uint32_t n : dims) cells *= n > 1 ? n - 1 : 1;
        if (kind_ == DatasetKind::structured) {
            if (auto done = read_points(points); !done) return done;
        } else if (kind_ == DatasetKind::rectilinear) {
            if (auto done = read_coordinates(dims); !done) return done;
        }
        return read_attributes(points, cells);
    }

    Result<void> read_coordinates(const std::array<std::uint32_t, 3>& dims) {
        const XmlElement* section = doc_.child(piece_, "Coordinates");
        if (section == nullptr) return fail("F012", piece_, "expected Coordinates, found none");
        const XmlElement* array = nullptr;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            array = doc_.child(*section, "DataArray", array);
            if (array == nullptr) return fail("F012", *section, "expected 3 arrays of coordinates, found " + std::to_string(axis));
            auto values = decode_array(doc_, encoding_, *array, dims[axis]);
            if (!values) return std::move(values).why();
            Attribute a;
            a.values = std::move(*values);
            out_.single_precision = out_.single_precision || std::holds_alternative<std::vector<float>>(a.values);
            for (std::size_t i = 0; i < dims[axis]; ++i) {
                const double x = value_as_double(a, i);
                if (!std::isfinite(x)) return fail("F006", *array, "expected a finite coordinate, found " + number_text(x));
                out_.coordinates[axis].push_back(x);
            }
        }
        return {};
    }

    // ---- attributes ----

    Result<void> read_attributes(std::uint64_t points, std::uint64_t cells) {
        if (auto done = read_section("PointData", AttributeLocation::point, points); !done) return done;
        return read_section("CellData", AttributeLocation::cell, cells);
    }

    Result<void> read_section(const char* element, AttributeLocation location, std::uint64_t count) {
        const XmlElement* section = doc_.child(piece_, element);
        if (section == nullptr) return {};
        for (const XmlElement* array : doc_.children(*section)) {
            if (array->name != "DataArray" && array->name != "Array") continue;
            if (later_time_step(*array)) continue;
            Attribute a;
            a.location = location;
            a.name = array_name(doc_, *array);
            if (auto done = read_attribute(*array, count, a); !done) return done;
            static constexpr const char* roles[] = {"Scalars", "Vectors", "Normals", "TCoords", "Tensors", "GlobalIds", "PedigreeIds"};
            for (const char* role : roles) {
                if (!a.name.empty() && doc_.attribute(*section, role) == a.name) {
                    a.annotations.emplace_back(std::string(attribute_role_key), role);
                    break;
                }
            }
            out_.attributes.push_back(std::move(a));
        }
        return {};
    }

    bool later_time_step(const XmlElement& array) {
        const std::string_view steps = trimmed(doc_.raw_attribute(array, "TimeStep"));
        if (steps.empty() || steps.starts_with("0")) return false;
        drop(notes_.findings, notes_.losses,
             {LossClass::substance, array_name(doc_, array), "values of later time steps", "only the first time step is read", 1,
              doc_.where(array)});
        return true;
    }

    Result<void> read_attribute(const XmlElement& array, std::uint64_t count, Attribute& a) const {
        const auto components = components_of(doc_, array, 1);
        if (!components) return std::move(components).why();
        a.components = static_cast<std::uint32_t>(*components);
        auto values = decode_array(doc_, encoding_, array, count * *components);
        if (!values) return std::move(values).why();
        a.values = std::move(*values);
        read_details(doc_, array, a);
        if (doc_.raw_attribute(array, "IdType") == "1") a.annotations.emplace_back("vtk.type", "vtkIdType");
        return {};
    }

public:
    /// Component names and the unit, where VTK's information keys have them.
    static void read_details(const XmlDocument& doc, const XmlElement& array, Attribute& a) {
        if (a.components <= 64) {
            std::vector<std::string> names(a.components);
            bool any = false;
            for (std::uint32_t i = 0; i < a.components; ++i) {
                names[i] = doc.attribute(array, "ComponentName" + std::to_string(i));
                any = any || !names[i].empty();
            }
            if (any) a.component_names = std::move(names);
        }
        for (const XmlElement* key = doc.child(array, "InformationKey"); key != nullptr; key = doc.child(array, "InformationKey", key)) {
            if (doc.raw_attribute(*key, "name") == "UNITS_LABEL") a.unit = resolve_entities(key->text);
        }
    }
};

}  // namespace

const char* element_name(DatasetKind kind) {
    for (const KindRow& row : kinds) {
        if (row.kind == kind) return row.element;
    }
    return "";
}

std::optional<DatasetKind> kind_of_type(std::string_view type, bool& parallel) {
    for (const KindRow& row : kinds) {
        if (type == row.element || (type.starts_with('P') && type.substr(1) == row.element)) {
            parallel = type != row.element;
            return row.kind;
        }
    }
    return std::nullopt;
}

Result<Extent> read_extent(const XmlDocument& document, const XmlElement& element, std::string_view attribute) {
    Extent extent{};
    const std::string text = document.attribute(element, attribute);
    TextCursor cursor(text);
    cursor.next_line();
    for (std::int64_t& e : extent) {
        if (cursor.integer(e) != NumberStatus::ok)
            return unreadable("F012", document.where(element),
                              "expected six integers in " + std::string(attribute) + ", found '" + text.substr(0, 80) + "'");
    }
    double points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t lo = extent[2 * axis], hi = extent[2 * axis + 1];
        constexpr std::int64_t far = std::int64_t{1} << 31;
        if (lo <= -far || hi >= far || hi < lo - 1 || hi - lo >= far - 1)
            return unreadable("F014", document.where(element), "the extent '" + text.substr(0, 80) + "' is not possible");
        points *= static_cast<double>(hi - lo + 1);
    }
    if (points > static_cast<double>(most_points))
        return unreadable("F014", document.where(element), "the extent '" + text.substr(0, 80) + "' has more points than can be held");
    return extent;
}

std::array<std::uint32_t, 3> dims_of(const Extent& extent) {
    std::array<std::uint32_t, 3> dims{};
    for (std::size_t axis = 0; axis < 3; ++axis) dims[axis] = static_cast<std::uint32_t>(extent[2 * axis + 1] - extent[2 * axis] + 1);
    return dims;
}

Result<void> read_pieces(const XmlDocument& document, DatasetKind kind, const ReadOptions& options, std::vector<Piece>& pieces,
                         ReadNotes& notes) {
    auto encoding = encoding_of(document);
    if (!encoding) return std::move(encoding).why();
    const XmlElement* dataset = document.child(document.root(), element_name(kind));
    if (dataset == nullptr)
        return unreadable("F012", document.where(document.root()),
                          std::string("expected an element ") + element_name(kind) + ", found none");
    for (const XmlElement* piece = document.child(*dataset, "Piece"); piece != nullptr; piece = document.child(*dataset, "Piece", piece)) {
        if (options.monitor != nullptr && options.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {document.file}, "reading was stopped");
        auto read = PieceReader(document, *encoding, kind, *piece, notes).run();
        if (!read) return std::move(read).why();
        pieces.push_back(std::move(*read));
    }
    return {};
}

Result<std::vector<Attribute>> read_field_data(const XmlDocument& document, const XmlElement* field_data) {
    std::vector<Attribute> fields;
    if (field_data == nullptr) return fields;
    auto encoding = encoding_of(document);
    if (!encoding) return std::move(encoding).why();
    for (const XmlElement* array : document.children(*field_data)) {
        if (array->name != "DataArray" && array->name != "Array") continue;
        Attribute a;
        a.location = AttributeLocation::object;
        a.name = document.attribute(*array, "Name");
        const auto components = components_of(document, *array, 1);
        if (!components) return std::move(components).why();
        const auto tuples = stated_count(document, *array, "NumberOfTuples");
        if (!tuples) return std::move(tuples).why();
        std::optional<std::uint64_t> expected;
        if (*tuples) {
            if (**tuples > most_points)
                return unreadable("F014", document.where(*array),
                                  "the field array '" + a.name.substr(0, 80) + "' asks for more than the file can hold");
            expected = **tuples * *components;
        }
        auto values = decode_array(document, *encoding, *array, expected);
        if (!values) return std::move(values).why();
        a.values = std::move(*values);
        a.components = static_cast<std::uint32_t>(value_count(a));
        if (*components > 1) a.annotations.emplace_back("vtk.components", std::to_string(*components));
        PieceReader::read_details(document, *array, a);
        a.component_names.clear();
        fields.push_back(std::move(a));
    }
    return fields;
}

}  // namespace geomend::vtk
