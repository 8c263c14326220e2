// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/utf8.h"
#include "vtk/xml_support.h"

namespace geomend::test {
namespace {

const std::vector<FormatOptions> encodings{{}, {{"compress", "yes"}}, {{"encoding", "ascii"}}};

template <class T>
Attribute attribute(const std::string& name, AttributeLocation location, std::vector<T> values, std::uint32_t components = 1) {
    Attribute a;
    a.name = name;
    a.location = location;
    a.components = components;
    a.values = std::move(values);
    return a;
}

const Vec3 awkward{400000.33333333331, 5.1e6 + 1.0 / 3, -0.1};

Surface two_part_surface() {
    Surface s;
    s.info.name = "Top \"A\" <x> & \xC3\xA9";
    s.info.role = FeatureRole::horizon;
    s.info.role_text = "top";
    s.info.crs.axis_units = {"m", "m", "m"};
    s.info.crs.z_positive = ZPositive::depth;
    s.info.crs.z_positive_stated = true;
    s.points = {awkward, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0.1}, {2, 1, 0}};
    const std::array<std::uint32_t, 3> t{0, 1, 2};
    const std::array<std::uint32_t, 4> q{1, 4, 5, 3};
    s.polygons.push_back(t);
    s.polygons.push_back(q);
    s.parts = {{0, 0}, {3, 1}};
    s.labels.ids = {11, 12, 13, 14, 15, 99};
    s.alias.assign(6, no_index);
    s.alias[3] = 1;
    s.border_corners = {0, 2};
    Attribute porosity = attribute("porosity", AttributeLocation::point, std::vector<double>{0.1, 0.2, 1.0 / 3, -99999, 0.5, 0.6});
    porosity.unit = "frac";
    porosity.no_data = -99999;
    s.info.attributes = {porosity, attribute("facies", AttributeLocation::polygon, std::vector<std::int8_t>{-3, 4})};
    s.info.sets.push_back({"north", AttributeLocation::point, {1, 5}});
    s.info.annotations.push_back({"gocad.header", "*solid*color:1 0 0 1"});
    return s;
}

void expect_same(const Surface& a, const Surface& b) {
    EXPECT_EQ(a.info.name, b.info.name);
    EXPECT_EQ(a.info.role, b.info.role);
    EXPECT_EQ(a.info.crs, b.info.crs);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.polygons.corners, b.polygons.corners);
    EXPECT_EQ(a.polygons.offsets, b.polygons.offsets);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t i = 0; i < a.parts.size(); ++i) EXPECT_EQ(a.parts[i].first_polygon, b.parts[i].first_polygon);
    EXPECT_EQ(a.labels.ids, b.labels.ids);
    EXPECT_EQ(a.alias, b.alias);
    EXPECT_EQ(a.border_corners, b.border_corners);
    ASSERT_EQ(b.info.sets.size(), a.info.sets.size());
    for (std::size_t i = 0; i < a.info.sets.size(); ++i) EXPECT_EQ(b.info.sets[i].members, a.info.sets[i].members);
    expect_same_attributes(a.info.attributes, b.info.attributes);
}

TEST(XmlRoundTrip, SurfacesComeBackFromEachFormatAndEncoding) {
    Dataset data;
    data.objects.emplace_back(two_part_surface());
    for (const char* format : {"vtp", "vtu", "vtm"}) {
        for (const FormatOptions& options : encodings) {
            SCOPED_TRACE(format);
            expect_same(two_part_surface(), only_object<Surface>(through_xml(data, format, options)));
        }
    }
}

TEST(XmlRoundTrip, SeveralObjectsShareAFileAndComeBackApart) {
    PointSet points;
    points.info.name = "samples";
    points.points = {awkward, {7, 7, 7}};
    points.info.attributes = {attribute("porosity", AttributeLocation::point, std::vector<double>{5, 6}),
                              attribute("facies", AttributeLocation::point, std::vector<std::string>{"sand", "shale"})};
    Dataset data;
    data.objects = {points, two_part_surface(), two_part_surface()};
    std::get<Surface>(data.objects[2]).info.name = "Base";
    for (const char* format : {"vtp", "vtu", "vtm"}) {
        SCOPED_TRACE(format);
        const Dataset back = through_xml(data, format);
        ASSERT_EQ(back.objects.size(), 3u);
        ASSERT_TRUE(std::holds_alternative<PointSet>(back.objects[0]));
        EXPECT_EQ(std::get<PointSet>(back.objects[0]).points, points.points);
        expect_same_attributes(points.info.attributes, info_of(back.objects[0]).attributes);
        ASSERT_TRUE(std::holds_alternative<Surface>(back.objects[1]));
        expect_same(two_part_surface(), std::get<Surface>(back.objects[1]));
        EXPECT_EQ(info_of(back.objects[2]).name, "Base");
    }
}

// Properties that share a name, at one location and across locations, with words of their own.
Surface surface_with_equal_names() {
    Surface s = two_part_surface();
    s.info.attributes = {attribute("v", AttributeLocation::point, std::vector<double>{1, 2, 3, 4, 5, 6}),
                         attribute("v", AttributeLocation::point, std::vector<double>{-1, -2, -3, -4, -5, -6}),
                         attribute("v", AttributeLocation::polygon, std::vector<double>{7, 8}),
                         attribute("v", AttributeLocation::polygon, std::vector<std::int32_t>{9, 10})};
    for (std::size_t i = 0; i < 4; ++i) s.info.attributes[i].unit = std::string(i + 1, 'm');
    return s;
}

TEST(XmlRoundTrip, AttributesOfOneNameStayApart) {
    for (const std::size_t objects : {1u, 2u}) {
        Dataset data;
        for (std::size_t i = 0; i < objects; ++i) data.objects.emplace_back(surface_with_equal_names());
        for (const char* format : {"vtp", "vtu", "vtm"}) {
            SCOPED_TRACE(std::string(format) + " with " + std::to_string(objects));
            const Dataset back = through_xml(data, format);
            ASSERT_EQ(back.objects.size(), objects);
            for (const Object& object : back.objects) {
                const auto wanted = surface_with_equal_names().info.attributes;
                ASSERT_EQ(info_of(object).attributes.size(), wanted.size());
                for (const Attribute& a : wanted) {
                    const auto back_again = std::ranges::find(info_of(object).attributes, a.unit, &Attribute::unit);
                    ASSERT_NE(back_again, info_of(object).attributes.end()) << a.unit;
                    EXPECT_EQ(back_again->name, a.name);
                    EXPECT_EQ(back_again->location, a.location);
                    EXPECT_EQ(back_again->values, a.values);
                }
            }
        }
    }
}

// Names as old files have them: Latin-1, with control characters, and the same in UTF-8 beside them.
Surface surface_with_strange_names() {
    Surface s = two_part_surface();
    s.info.name =
        "S\xE9"
        "dimentaire";
    s.info.groups = {"Mod\xE8le"};
    const std::vector<double> values{1, 2, 3, 4, 5, 6};
    s.info.attributes = {attribute("Porosit\xE9", AttributeLocation::point, values),
                         attribute("Porosit\xC3\xA9", AttributeLocation::point, values),
                         attribute("two\nlines\x01", AttributeLocation::point, values),
                         attribute("\xFF\xFE", AttributeLocation::polygon, std::vector<double>{1, 2, 3, 4}, 2)};
    s.info.attributes.back().component_names = {"\xE0", "b"};
    return s;
}

TEST(XmlRoundTrip, NamesOfMarkupComeBackFromFilesThatOthersCanRead) {
    Dataset data;
    Surface s = two_part_surface();
    const std::string name = "a<b & \"c\" 'd' &lt;";
    s.info.attributes = {attribute(name, AttributeLocation::point, std::vector<double>{1, 2, 3, 4, 5, 6}),
                         attribute(name + "2", AttributeLocation::polygon, std::vector<double>{1, 2, 3, 4}, 2)};
    s.info.attributes[0].annotations.emplace_back("vtk.role", "Scalars");
    s.info.attributes[1].component_names = {name, "b"};
    data.objects.emplace_back(s);
    for (const char* format : {"vtp", "vtu", "vtm"}) {
        for (const FormatOptions& options : encodings) {
            SCOPED_TRACE(format);
            const TemporaryFolder folder;
            const auto back = read_xml_file(write_xml(data, folder, format, options));
            ASSERT_TRUE(back.ok()) << back.why().error.message;
            ASSERT_EQ(back->objects.size(), 1u);
            const auto& read = info_of(back->objects[0]).attributes;
            ASSERT_EQ(read.size(), 2u);
            for (std::size_t i = 0; i < 2; ++i) {
                EXPECT_EQ(read[i].name, s.info.attributes[i].name);
                EXPECT_EQ(read[i].component_names, s.info.attributes[i].component_names);
                EXPECT_EQ(annotation(read[i], "vtk.role"), annotation(s.info.attributes[i], "vtk.role"));
            }
        }
    }
}

// The position of a twin is that of another point: so a point that was moved, or whose twin is a twin itself, is no twin.
TEST(XmlRoundTrip, TwinsThatCannotBeAreNone) {
    Surface s = two_part_surface();
    s.alias = {no_index, no_index, 2, 1, 0, 3};
    Dataset data;
    data.objects.emplace_back(s);
    for (const char* format : {"vtp", "vtu"}) {
        const TemporaryFolder folder;
        const auto back = read_xml_file(write_xml(data, folder, format));
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        EXPECT_EQ(std::get<Surface>(back->objects[0]).alias,
                  (std::vector<std::uint32_t>{no_index, no_index, no_index, 1, no_index, no_index}))
            << format;
    }
}

/// What stands before the values, which are no text.
std::string markup_of(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    return bytes.substr(0, bytes.find("<AppendedData"));
}

TEST(XmlRoundTrip, NamesThatXmlCannotHoldComeBackFromFilesThatOthersCanRead) {
    for (const std::size_t objects : {1u, 2u}) {
        Dataset data;
        for (std::size_t i = 0; i < objects; ++i) data.objects.emplace_back(surface_with_strange_names());
        for (const char* format : {"vtp", "vtu", "vtm", "pvd"}) {
            SCOPED_TRACE(std::string(format) + " with " + std::to_string(objects));
            const TemporaryFolder folder;
            const auto path = write_xml(data, folder, format);
            for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
                if (!entry.is_regular_file()) continue;
                const std::string markup = markup_of(entry.path());
                EXPECT_TRUE(is_utf8(markup)) << entry.path();
                EXPECT_EQ(markup.find('\x01'), std::string::npos) << entry.path();
            }
            const auto back = read_xml_file(path);
            ASSERT_TRUE(back.ok()) << back.why().error.message;
            ASSERT_EQ(back->objects.size(), objects);
            const auto wanted = surface_with_strange_names().info;
            for (const Object& object : back->objects) {
                EXPECT_EQ(info_of(object).name, wanted.name);
                EXPECT_EQ(info_of(object).groups, wanted.groups);
                ASSERT_EQ(info_of(object).attributes.size(), wanted.attributes.size());
                for (std::size_t i = 0; i < wanted.attributes.size(); ++i) {
                    EXPECT_EQ(info_of(object).attributes[i].name, wanted.attributes[i].name);
                    EXPECT_EQ(info_of(object).attributes[i].component_names, wanted.attributes[i].component_names);
                }
            }
        }
    }
}

TEST(XmlWrite, FilesWhoseOwnNameXmlCannotHoldNameTheirParts) {
    Dataset data;
    data.objects.emplace_back(two_part_surface());
    struct Case {
        std::string file, part;  // as the index has to name the part
    };
    for (const auto& [name, part] :
         {Case{"caf\xE9.vtm", "caf\xC3\xA9/caf\xC3\xA9_0.vtp"}, Case{"a & b.vtm", "a &amp; b/a &amp; b_0.vtp"},
          Case{"caf\xE9.pvd", "caf\xC3\xA9/caf\xC3\xA9_0_0.vtp"}, Case{"\"q\".pvd", "&quot;q&quot;/&quot;q&quot;_0_0.vtp"}}) {
        SCOPED_TRACE(name);
        const TemporaryFolder folder;
        OutputSet out(folder / name);
        const std::string format = name.substr(name.size() - 3);
        ASSERT_TRUE(format_named(format).write(data, out, {}).ok());
        ASSERT_TRUE(out.commit().ok());
        EXPECT_NE(read_file(folder / name).find("file=\"" + part + "\""), std::string::npos);
        const auto back = read_xml_file(folder / name);
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        EXPECT_EQ(back->objects.size(), 1u);
    }
}

// ParaView would draw 9999900 as a spike.
TEST(XmlRoundTrip, SamplesWithoutAHeightAreHiddenFromVtkAndKeepTheirValue) {
    Raster raster;
    raster.dims = {2, 2, 1};
    Attribute height;
    height.name = "height";
    height.values = std::vector<double>{1, 9999900, 3, 4};
    height.no_data = 9999900;
    raster.info.attributes.push_back(height);
    raster.height_attribute = 0;
    Dataset data;
    data.objects.emplace_back(raster);
    const TemporaryFolder folder;
    const auto path = write_xml(data, folder, "vti", {{"encoding", "ascii"}});
    const std::string text = read_file(path);
    const std::size_t marks = text.find("Name=\"vtkGhostType\"");
    ASSERT_NE(marks, std::string::npos);
    EXPECT_NE(text.find("0 2 0 0", marks), std::string::npos);
    const auto back = read_xml_file(path);
    ASSERT_TRUE(back.ok()) << back.why().error.message;
    const auto& attributes = info_of(back->objects.at(0)).attributes;
    ASSERT_EQ(attributes.size(), 1u);
    EXPECT_EQ(attributes[0].values, height.values);
}

TEST(XmlRoundTrip, PolylinesKeepPartsAndEdges) {
    PolylineSet lines;
    lines.points = {awkward, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
    lines.edges = {{0, 1}, {1, 2}, {2, 0}, {3, 4}};
    lines.parts = {{0, 0, {}}, {3, 3, {}}};
    lines.info.attributes = {attribute("z", AttributeLocation::point, std::vector<float>{1, 2, 3, 4, 5})};
    Dataset data;
    data.objects.emplace_back(lines);
    for (const char* format : {"vtp", "vtu", "vtm"}) {
        SCOPED_TRACE(format);
        const auto back = only_object<PolylineSet>(through_xml(data, format));
        EXPECT_EQ(back.points, lines.points);
        EXPECT_EQ(back.edges, lines.edges);
        EXPECT_EQ(back.parts.size(), 2u);
        expect_same_attributes(lines.info.attributes, back.info.attributes);
    }
}

CellMesh mixed_mesh() {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, awkward};
    const std::array<std::uint32_t, 4> tet{0, 1, 2, 3};
    const std::array<std::uint32_t, 3> tri{0, 2, 1};
    mesh.add_cell(CellType::tetrahedron, tet);
    mesh.add_cell(CellType::triangle, tri);
    mesh.types.push_back(CellType::polyhedron);
    mesh.nodes.insert(mesh.nodes.end(), {3, 1, 2, 4});
    mesh.offsets.push_back(mesh.nodes.size());
    mesh.cell_faces = {0, 0, 0, 4};
    mesh.face_offsets = {0, 3, 6, 9, 12};
    mesh.face_nodes = {3, 1, 2, 3, 4, 1, 1, 4, 2, 2, 4, 3};
    mesh.entities.resize(2);
    mesh.entities[0] = {3, 7, "block", FeatureRole::unknown, "", {3}, {}, std::nullopt};
    mesh.entities[1] = {2, 3, "fault", FeatureRole::fault, "normal_fault", {}, {}, std::nullopt};
    mesh.cell_entity = {0, 1, no_index};
    mesh.cell_labels.ids = {5, 6, 8};
    mesh.info.attributes = {attribute("u64", AttributeLocation::cell, std::vector<std::uint64_t>{~0ull, 1, 2}),
                            attribute("vector", AttributeLocation::point, std::vector<double>(15, 1.0 / 3), 3),
                            attribute("words", AttributeLocation::cell, std::vector<std::string>{"a", "", "c d"})};
    return mesh;
}

TEST(XmlRoundTrip, MeshesKeepEntitiesPolyhedraAndTypes) {
    Dataset data;
    data.objects.emplace_back(mixed_mesh());
    for (const FormatOptions& options : encodings) {
        const auto back = only_object<CellMesh>(through_xml(data, "vtu", options));
        const CellMesh mesh = mixed_mesh();
        EXPECT_EQ(back.points, mesh.points);
        EXPECT_EQ(back.types, mesh.types);
        EXPECT_EQ(back.nodes, mesh.nodes);
        EXPECT_EQ(back.face_nodes, mesh.face_nodes);
        EXPECT_EQ(back.cell_faces, mesh.cell_faces);
        EXPECT_EQ(back.cell_entity, mesh.cell_entity);
        EXPECT_EQ(back.cell_labels.ids, mesh.cell_labels.ids);
        ASSERT_EQ(back.entities.size(), 2u);
        EXPECT_EQ(back.entities[0].boundary, mesh.entities[0].boundary);
        EXPECT_EQ(back.entities[1].name, "fault");
        EXPECT_EQ(back.entities[1].role, FeatureRole::fault);
        expect_same_attributes(mesh.info.attributes, back.info.attributes);
    }
}

TEST(XmlRoundTrip, GridsKeepDeadCellsAndRastersTheirFrame) {
    StructuredGrid grid;
    grid.dims = {3, 2, 2};
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 3; ++i) grid.points.push_back({i + 0.1, j + 1.0 / 3, -1.0 * k});
    grid.dead_cells = {0, 1};
    Dataset data;
    data.objects.emplace_back(grid);
    const auto back = only_object<StructuredGrid>(through_xml(data, "vts"));
    EXPECT_EQ(back.points, grid.points);
    EXPECT_EQ(back.dead_cells, grid.dead_cells);
    EXPECT_TRUE(back.info.attributes.empty());

    Raster raster;
    raster.dims = {2, 3, 1};
    raster.origin = awkward;
    raster.step = {{{0.1, 0.2, 0}, {-0.2, 0.1, 0}, {0, 0, -1.0 / 3}}};
    raster.info.attributes = {attribute("depth", AttributeLocation::point, std::vector<float>{1, 2, 3, 4, 5, 6})};
    raster.height_attribute = 0;
    data.objects = {raster};
    const auto image = only_object<Raster>(through_xml(data, "vti"));
    EXPECT_EQ(image.origin, raster.origin);
    EXPECT_EQ(image.step, raster.step);
    EXPECT_EQ(image.height_attribute, 0u);
    expect_same_attributes(raster.info.attributes, image.info.attributes);

    raster.coordinates = {std::vector<double>{0, 1.0 / 3}, std::vector<double>{0, 1, 5.5}, std::vector<double>{2}};
    data.objects = {raster};
    EXPECT_EQ(only_object<Raster>(through_xml(data, "vtr")).coordinates, raster.coordinates);
}

TEST(XmlRoundTrip, SinglePrecisionComesBackAsSuchOnlyWhereItIsExact) {
    const std::string text =
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float32\" "
        "NumberOfComponents=\"3\" format=\"ascii\">0.1 2 3</DataArray></Points></Piece></PolyData></VTKFile>";
    Dataset data = must_read_xml(text);
    const TemporaryFolder folder;
    EXPECT_NE(read_file(write_xml(data, folder, "vtp")).find("\"Float32\" Name=\"Points\""), std::string::npos);
    std::get<PointSet>(data.objects[0]).points[0] = awkward;
    EXPECT_NE(read_file(write_xml(data, folder, "vtp")).find("\"Float64\" Name=\"Points\""), std::string::npos);
}

TEST(XmlWrite, ListsWhatDoesNotFit) {
    Well well;
    well.info.name = "W1";
    well.path = {{0, 0, 0}, {0, 0, -100}};
    well.measured_depth = {0, 100};
    well.markers.resize(2);
    Dataset data;
    data.objects = {well, Raster{}};
    const TemporaryFolder folder;
    std::vector<Loss> losses;
    const auto back = read_xml_file(write_xml(data, folder, "vtp", {}, &losses));
    ASSERT_EQ(losses.size(), 2u);
    EXPECT_EQ(losses[0].loss_class, LossClass::substance);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(only_object<PolylineSet>(*back).points, well.path);
}

TEST(XmlWrite, RefusesWrongOptionsAndNothing) {
    const TemporaryFolder folder;
    OutputSet out(folder / "model.vtu");
    Dataset data;
    EXPECT_EQ(vtk::write_vtu(data, out, {}).why().kind, FailureKind::cannot_hold);
    data.objects.emplace_back(mixed_mesh());
    EXPECT_EQ(vtk::write_vtu(data, out, {{{"encoding", "morse"}}, nullptr}).why().kind, FailureKind::usage);
    EXPECT_EQ(vtk::write_vtp(data, out, {}).why().kind, FailureKind::cannot_hold);
}

// ---- B-Rep ----

BrepData tetrahedron_model(bool with_cell) {
    BrepData b;
    b.name = "one tet";
    b.vertices = {{0, 0, 0}, {1.0 / 3, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::array<std::array<std::uint32_t, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    for (std::uint32_t i = 0; i < 4; ++i) b.corners.push_back({"c" + std::to_string(i), VertexId(i)});
    const std::array<std::array<std::uint32_t, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
    for (const auto& e : edges) {
        BrepData::Line line;
        line.vertices = {VertexId(e[0]), VertexId(e[1])};
        line.corners = {CornerId(e[0]), CornerId(e[1])};
        b.lines.push_back(line);
    }
    b.interfaces.resize(2);
    b.interfaces[0].name = "walls";
    b.interfaces[0].role = FeatureRole::boundary;
    b.interfaces[1].name = "F1";
    b.interfaces[1].role = FeatureRole::fault;
    for (std::uint32_t i = 0; i < 4; ++i) {
        BrepData::Surface s;
        s.name = "s" + std::to_string(i);
        s.interface_id = InterfaceId(i == 3 ? 1u : 0u);
        s.role = i == 3 ? FeatureRole::fault : FeatureRole::boundary;
        for (const std::uint32_t v : faces[i]) s.nodes.push_back(VertexId(v));
        const std::array<std::uint32_t, 3> t{0, 1, 2};
        s.polygons.push_back(t);
        s.neighbours.assign(3, no_index);
        if (i != 1) s.attributes = {attribute("throw", AttributeLocation::point, std::vector<double>{i + 0.1, i + 0.2, i + 0.3})};
        b.interfaces[s.interface_id.value].surfaces.push_back(SurfaceId(i));
        b.surfaces.push_back(std::move(s));
    }
    BrepData::Region r;
    r.name = "inside";
    for (std::uint32_t i = 0; i < 4; ++i) r.sides.push_back({SurfaceId(i), false});
    for (std::uint32_t i = 0; i < 4; ++i) b.universe.push_back({SurfaceId(i), true});
    if (with_cell) {
        for (std::uint32_t i = 0; i < 4; ++i) r.nodes.push_back(VertexId(i));
        r.cell_types = {CellType::tetrahedron};
        r.cell_offsets = {0, 4};
        r.cell_nodes = {0, 1, 2, 3};
        r.attributes = {attribute("poro", AttributeLocation::cell, std::vector<float>{0.25f}),
                        attribute("p", AttributeLocation::point, std::vector<double>{1, 2, 3, 1.0 / 3})};
        for (auto& s : b.surfaces) s.attributes.clear();
    }
    b.regions.push_back(r);
    b.layers.push_back({"L", {RegionId(0u)}, {}});
    return b;
}

Dataset model_dataset(bool with_cell) {
    auto brep = Brep::make(tetrahedron_model(with_cell));
    EXPECT_TRUE(brep.ok());
    Dataset data;
    if (brep) data.breps.push_back(std::move(brep).value());
    return data;
}

TEST(XmlModel, IsOneBlockPerCornerLineSurfaceAndRegion) {
    const TemporaryFolder folder;
    const std::string index = read_file(write_xml(model_dataset(false), folder, "vtm"));
    for (const char* block : {"name=\"Corners\"", "name=\"Lines\"", "name=\"Surfaces\"", "name=\"Regions\"", "name=\"c0\"",
                              "name=\"line 6\"", "name=\"s3\"", "name=\"inside\"", "file=\"model/model_0.vtp\""}) {
        EXPECT_NE(index.find(block), std::string::npos) << block;
    }
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "model")) files += entry.is_regular_file() ? 1u : 0u;
    EXPECT_EQ(files, 15u);
}

TEST(XmlModel, ComesBackAsSurfacesPerInterfaceWithItsRegions) {
    const Dataset back = through_xml(model_dataset(false), "vtm");
    ASSERT_EQ(back.objects.size(), 2u);
    const auto& walls = std::get<Surface>(back.objects[0]);
    EXPECT_EQ(walls.info.name, "walls");
    EXPECT_EQ(walls.info.role, FeatureRole::boundary);
    ASSERT_EQ(walls.parts.size(), 3u);
    EXPECT_EQ(walls.points.size(), 9u);
    EXPECT_EQ(walls.points[2], (Vec3{1.0 / 3, 0, 0}));
    const auto& values = std::get<std::vector<double>>(find_attribute(walls.info.attributes, "throw", AttributeLocation::point)->values);
    EXPECT_EQ(values[0], 0.1);
    EXPECT_TRUE(std::isnan(values[3]));
    EXPECT_EQ(values[8], 2.3);
    ASSERT_EQ(back.models.size(), 1u);
    const StatedModel& model = back.models[0];
    EXPECT_EQ(model.name, "one tet");
    ASSERT_EQ(model.faces.size(), 4u);
    EXPECT_EQ(model.faces[3].interface_name, "F1");
    EXPECT_EQ(model.faces[2].part, 2u);
    ASSERT_EQ(model.regions.size(), 2u);
    EXPECT_TRUE(model.regions[0].universe);
    EXPECT_EQ(model.regions[1].name, "inside");
    ASSERT_EQ(model.regions[1].sides.size(), 4u);
    EXPECT_FALSE(model.regions[1].sides[0].front);
    ASSERT_EQ(model.layers.size(), 1u);
    EXPECT_EQ(model.layers[0].regions, std::vector<std::uint32_t>{1});
}

TEST(XmlModel, ComesBackAsATaggedMeshWhereRegionsHoldCells) {
    const Dataset back = through_xml(model_dataset(true), "vtm");
    const auto mesh = only_object<CellMesh>(back);
    EXPECT_EQ(mesh.points, tetrahedron_model(true).vertices);
    EXPECT_EQ(mesh.cell_count(), 4u + 6u + 4u + 1u);
    ASSERT_EQ(mesh.entities.size(), 15u);
    EXPECT_EQ(mesh.entities.back().name, "inside");
    EXPECT_EQ(mesh.types.back(), CellType::tetrahedron);
    const Attribute* poro = find_attribute(mesh.info.attributes, "poro", AttributeLocation::cell);
    ASSERT_NE(poro, nullptr);
    EXPECT_EQ(std::get<std::vector<float>>(poro->values).back(), 0.25f);
    const Attribute* p = find_attribute(mesh.info.attributes, "p", AttributeLocation::point);
    ASSERT_NE(p, nullptr);
    EXPECT_EQ(std::get<std::vector<double>>(p->values), (std::vector<double>{1, 2, 3, 1.0 / 3}));
    ASSERT_EQ(back.models.size(), 1u);
    EXPECT_EQ(back.models[0].faces[3].part, 13u);
    EXPECT_TRUE(back.losses.empty());
}

TEST(XmlModel, SeveralComeBackEachByItselfAlsoWithOneName) {
    Dataset data;
    for (const double x : {0.0, 5.0, 9.0}) {
        BrepData moved = tetrahedron_model(x == 9);  // the last one holds a cell
        for (Vec3& v : moved.vertices) v[0] += x;
        auto brep = Brep::make(std::move(moved));
        ASSERT_TRUE(brep.ok());
        data.breps.push_back(std::move(brep).value());
    }
    PointSet beside;
    beside.info.name = "beside";
    beside.points = {{1, 2, 3}};
    data.objects.emplace_back(beside);
    const Dataset back = through_xml(data, "vtm");
    EXPECT_TRUE(back.losses.empty());
    EXPECT_TRUE(back.findings.empty());
    ASSERT_EQ(back.models.size(), 3u);
    ASSERT_EQ(back.objects.size(), 6u);
    for (std::size_t m = 0; m < 3; ++m) {
        EXPECT_EQ(back.models[m].name, "one tet");
        ASSERT_EQ(back.models[m].faces.size(), 4u);
        EXPECT_EQ(back.models[m].faces[3].object, m == 2 ? 4u : 2 * m + 1);
        ASSERT_EQ(back.models[m].regions.size(), 2u);
    }
    const auto& second_walls = std::get<Surface>(back.objects[2]);
    EXPECT_EQ(second_walls.info.name, "walls");
    EXPECT_EQ(second_walls.points[0], (Vec3{5, 0, 0}));
    EXPECT_EQ(std::get<CellMesh>(back.objects[4]).points[0], (Vec3{9, 0, 0}));
    EXPECT_EQ(std::get<PointSet>(back.objects[5]).points, beside.points);
}

TEST(XmlModel, OfSeveralOnlyThatOfWhichABlockIsGoneIsReadBlockByBlock) {
    Dataset data = model_dataset(false);
    BrepData moved = tetrahedron_model(false);
    moved.name = "another";
    for (Vec3& v : moved.vertices) v[0] += 5;
    data.breps.push_back(Brep::make(std::move(moved)).value());
    const TemporaryFolder folder;
    const auto path = write_xml(data, folder, "vtm");
    std::string index = read_file(path);
    const std::size_t line = index.find("<DataSet index=\"1\" name=\"c1\"", index.find("name=\"another\""));
    ASSERT_NE(line, std::string::npos);
    index.erase(line, index.find('\n', line) - line);
    write_file(path, index);
    const auto back = read_xml_file(path);
    ASSERT_TRUE(back.ok());
    ASSERT_EQ(back->models.size(), 1u);
    EXPECT_EQ(back->models[0].name, "one tet");
    EXPECT_EQ(back->objects.size(), 2u + 14u);
    ASSERT_FALSE(back->findings.empty());
    EXPECT_EQ(back->findings.back().code, "F113");
    EXPECT_NE(back->findings.back().message.find("'another'"), std::string::npos) << back->findings.back().message;
}

TEST(XmlModel, IsReadBlockByBlockWhereOneIsGone) {
    const TemporaryFolder folder;
    const auto path = write_xml(model_dataset(false), folder, "vtm");
    std::string index = read_file(path);
    const std::size_t line = index.find("<DataSet index=\"1\" name=\"s1\"");
    ASSERT_NE(line, std::string::npos);
    index.erase(line, index.find('\n', line) - line);
    write_file(path, index);
    const auto back = read_xml_file(path);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->objects.size(), 14u);
    ASSERT_FALSE(back->findings.empty());
    EXPECT_EQ(back->findings.back().code, "F113");
}

}  // namespace
}  // namespace geomend::test
