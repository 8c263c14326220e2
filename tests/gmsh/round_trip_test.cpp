// SPDX-License-Identifier: AGPL-3.0-or-later
// clang-format off: rapidcheck needs gtest before it
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
// clang-format on

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/gmsh/write_geo.h"
#include "gmsh_support.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

const std::vector<FormatOptions> all_ways = {{{"version", "2.2"}, {"order", "2"}},
                                             {{"version", "2.2"}, {"binary", "yes"}, {"order", "2"}},
                                             {{"version", "4.1"}, {"order", "2"}},
                                             {{"version", "4.1"}, {"binary", "yes"}, {"order", "2"}}};

std::string way_text(const FormatOptions& way) {
    std::string text;
    for (const auto& [key, value] : way) text += key + "=" + value + " ";
    return text;
}

// Cells by their number: type, positions of their nodes, name of their entity.
using CellPicture = std::map<std::int64_t, std::tuple<CellType, std::vector<Vec3>, std::string, std::int64_t>>;

CellPicture picture(const CellMesh& m) {
    CellPicture p;
    for (std::size_t i = 0; i < m.cell_count(); ++i) {
        std::vector<Vec3> positions;
        for (const std::uint32_t n : m.cell_nodes(i)) positions.push_back(m.points[n]);
        const bool entity = !m.cell_entity.empty() && m.cell_entity[i] != no_index;
        p[m.cell_labels[i]] = {m.types[i], positions, entity ? m.entities[m.cell_entity[i]].name : "",
                               entity ? m.entities[m.cell_entity[i]].tag : 0};
    }
    return p;
}

void expect_same(const CellMesh& a, const CellMesh& b, const std::string& way) {
    EXPECT_EQ(a.points.size(), b.points.size()) << way;
    EXPECT_TRUE(picture(a) == picture(b)) << way;
    std::map<std::tuple<int, std::int64_t>, std::string> groups_a, groups_b;
    for (const auto& g : a.groups) groups_a[{g.dimension, g.tag}] = g.name;
    for (const auto& g : b.groups) groups_b[{g.dimension, g.tag}] = g.name;
    EXPECT_EQ(groups_a, groups_b) << way;
}

TEST(MshRoundTrip, AScriptOverPointsInAVolumeWithoutElementsOrBoundaryIsWritten) {
    Dataset d;
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 2, 3}};
    mesh.entities.resize(1);
    mesh.entities[0].tag = 7;
    d.objects.emplace_back(std::move(mesh));
    const TemporaryFolder folder;
    OutputSet outputs(folder / "out.geo");
    ASSERT_TRUE(gmsh::write_geo(d, outputs, {}).ok());
    ASSERT_TRUE(outputs.commit().ok());
    const auto back = read_text(read_file(folder / "out.msh"));
    ASSERT_TRUE(back.ok()) << back.why().error.message;
    EXPECT_EQ(mesh_of(*back).points.size(), 2u);
    EXPECT_EQ(read_file(folder / "out.geo").find("Volume"), std::string::npos);
}

TEST(MshRoundTrip, MeshEntitiesAndGroupsComeBack) {
    const auto d = read_text(two_tets_41());
    for (const FormatOptions& way : all_ways) {
        const Written w = write_text(*d, way);
        const auto back = read_text(w.bytes);
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        expect_same(mesh_of(*d), mesh_of(*back), way_text(way));
        EXPECT_TRUE(std::ranges::none_of(w.losses, [](const Loss& l) { return l.loss_class != LossClass::style; })) << way_text(way);
        EXPECT_TRUE(back->findings.empty()) << way_text(way);
        if (way_text(way).find("4.1") != std::string::npos) {
            EXPECT_EQ(mesh_of(*back).entities[4].boundary, (std::vector<std::int64_t>{-4}));
        }
    }
}

TEST(MshRoundTrip, WritingAgainGivesTheSameBytes) {
    const auto d = read_text(two_tets_41());
    for (const FormatOptions& way : all_ways) {
        const std::string once = write_text(*d, way).bytes;
        EXPECT_EQ(write_text(*read_text(once), way).bytes, once) << way_text(way);
    }
}

Attribute attribute(std::string name, AttributeLocation location, std::uint32_t components, AttributeValues values) {
    Attribute a;
    a.name = std::move(name);
    a.location = location;
    a.components = components;
    a.values = std::move(values);
    return a;
}

TEST(MshRoundTrip, PropertiesKeepTypesUnitsNoDataAndComponents) {
    auto d = read_text(two_tets_41());
    auto& info = info_of(d->objects[0]);
    info.attributes.push_back(attribute("poro", AttributeLocation::cell, 1, std::vector<float>{0.1f, -99999, 0.3f, -99999, 0.5f}));
    info.attributes.back().no_data = -99999;
    info.attributes.back().unit = "%";
    info.attributes.push_back(attribute("uv", AttributeLocation::point, 2, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 1e-300}));
    info.attributes.back().component_names = {"u", "v"};
    info.attributes.push_back(attribute("say \"hi\" $", AttributeLocation::point, 1, std::vector<std::int32_t>{1, -2, 3, 4, 5}));
    info.attributes.push_back(attribute("text", AttributeLocation::point, 1, std::vector<std::string>(5, "a")));
    info.attributes.push_back(attribute("big", AttributeLocation::cell, 1, std::vector<std::int64_t>{1, 2, 3, 4, std::int64_t{1} << 62}));
    for (const FormatOptions& way : all_ways) {
        const Written w = write_text(*d, way);
        EXPECT_EQ(std::ranges::count(w.losses, LossClass::substance, &Loss::loss_class), 2) << way_text(way);
        const auto back = read_text(w.bytes);
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        const auto& attributes = mesh_of(*back).info.attributes;
        ASSERT_EQ(attributes.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            const Attribute* a = find_attribute(attributes, info.attributes[i].name, info.attributes[i].location);
            ASSERT_NE(a, nullptr) << info.attributes[i].name;
            EXPECT_EQ(a->values, info.attributes[i].values) << way_text(way) << a->name;
            EXPECT_EQ(a->components, info.attributes[i].components);
            EXPECT_EQ(a->no_data, info.attributes[i].no_data);
            EXPECT_EQ(a->unit, info.attributes[i].unit);
            EXPECT_EQ(a->component_names, info.attributes[i].component_names);
        }
    }
}

TEST(MshRoundTrip, AttributesOfOneNameStayApart) {
    auto d = read_text(two_tets_41());
    Surface s;
    s.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 2}};
    for (const auto& triangle : {std::array<std::uint32_t, 3>{0, 1, 2}, std::array<std::uint32_t, 3>{2, 1, 3}})
        s.polygons.push_back(triangle);
    Dataset surface;
    surface.objects.emplace_back(s);
    for (Dataset* data : {&*d, &surface}) {
        ObjectInfo& info = info_of(data->objects[0]);
        info.attributes = {attribute("v", AttributeLocation::point, 1, std::vector<double>{1, 2, 3, 4, 5}),
                           attribute("v", AttributeLocation::point, 1, std::vector<double>{-99999, 20, 30, 40, 50})};
        info.attributes[0].unit = "m";
        info.attributes[1].unit = "ft";
        info.attributes[1].no_data = -99999;
        for (const FormatOptions& way : all_ways) {
            const auto back = read_text(write_text(*data, way).bytes);
            ASSERT_TRUE(back.ok()) << back.why().error.message;
            std::map<std::string, const Attribute*> by_unit;
            for (const Attribute& a : info_of(back->objects[0]).attributes) by_unit[a.unit] = &a;
            for (const Attribute& a : info.attributes) {
                ASSERT_NE(by_unit[a.unit], nullptr) << way_text(way) << a.unit;
                EXPECT_EQ(by_unit[a.unit]->name, "v");
                for (std::size_t i = data == &surface ? 1 : 0; i < 4; ++i) {
                    EXPECT_EQ(value_as_double(*by_unit[a.unit], i), value_as_double(a, i)) << way_text(way) << a.unit;
                }
            }
        }
    }
}

TEST(MshRoundTrip, ElementNodeDataAndTimeStepsComeBack) {
    const auto d =
        read_text(std::string(two_tets_22()) +
                  "$ElementNodeData\n1\n\"stress\"\n1\n0.5\n3\n2\n1\n2\n4 4 1 2 3 4\n5 4 5 6 7 8\n$EndElementNodeData\n"
                  "$NodeData\n1\n\"p\"\n1\n0\n3\n0\n1\n1\n2 1\n$EndNodeData\n$NodeData\n1\n\"p\"\n1\n10\n3\n1\n1\n1\n2 2\n$EndNodeData\n");
    ASSERT_TRUE(d.ok()) << d.why().error.message;
    ASSERT_EQ(mesh_of(*d).info.attributes.size(), 3u);
    EXPECT_EQ(mesh_of(*d).info.attributes[0].components, 4u);
    for (const FormatOptions& way : all_ways) {
        const std::string bytes = write_text(*d, way).bytes;
        EXPECT_NE(bytes.find("$ElementNodeData"), std::string::npos);
        const auto back = read_text(bytes);
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(mesh_of(*back).info.attributes[i].values, mesh_of(*d).info.attributes[i].values) << way_text(way) << i;
            EXPECT_EQ(mesh_of(*back).info.attributes[i].annotations, mesh_of(*d).info.attributes[i].annotations) << way_text(way) << i;
        }
    }
}

TEST(MshRoundTrip, EntitiesInSeveralGroupsPassThroughMsh22) {
    auto d = read_text(two_tets_41());
    auto& mesh = std::get<CellMesh>(d->objects[0]);
    mesh.groups.push_back({3, 50, "all rock"});
    mesh.entities[3].groups.push_back(3);
    mesh.entities[4].groups.push_back(3);
    for (const FormatOptions& way : all_ways) {
        const auto back = read_text(write_text(*d, way).bytes);
        ASSERT_TRUE(back.ok());
        EXPECT_EQ(mesh_of(*back).cell_count(), 5u) << way_text(way);
        EXPECT_EQ(mesh_of(*back).entities[3].groups.size(), 2u) << way_text(way);
    }
}

TEST(MshWriting, SecondOrderCellsGoOutByTheirCornersUnlessAskedFor) {
    CellMesh mesh;
    for (int i = 0; i < 10; ++i) mesh.points.push_back({i * 1.0, i * i * 1.0, i % 3 * 1.0});
    mesh.add_cell(CellType::quadratic_tetrahedron, std::array<std::uint32_t, 10>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    Dataset d;
    d.objects.emplace_back(mesh);
    const Written linear = write_text(d, {});
    EXPECT_EQ(std::ranges::count(linear.losses, LossClass::substance, &Loss::loss_class), 1);
    const auto back = read_text(linear.bytes);
    EXPECT_EQ(mesh_of(*back).types, std::vector{CellType::tetrahedron});
    EXPECT_EQ(mesh_of(*back).points.size(), 4u);
    for (const FormatOptions& way : all_ways) {
        const Written full = write_text(d, way);
        EXPECT_TRUE(std::ranges::none_of(full.losses, [](const Loss& l) { return l.loss_class == LossClass::substance; }));
        EXPECT_EQ(mesh_of(*read_text(full.bytes)).nodes, mesh.nodes);
        EXPECT_TRUE(mesh_of(*read_text(full.bytes)).entities.empty()) << "cells without entities come back without";
    }
}

TEST(MshWriting, SeveralObjectsBecomeEntitiesWithNamedGroups) {
    Dataset d;
    Surface fault;
    fault.info.name = "fault";
    fault.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}, {2, 2, 2}};
    fault.polygons.push_back(std::array<std::uint32_t, 3>{0, 1, 2});
    fault.polygons.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    fault.polygons.push_back(std::array<std::uint32_t, 5>{0, 1, 4, 2, 3});
    PointSet points;
    points.info.name = "wells";
    points.points = {{5, 5, 5}, {6, 6, 6}};
    points.info.attributes.push_back(attribute("q", AttributeLocation::point, 1, std::vector<double>{7, 8}));
    StructuredGrid grid;
    grid.info.name = "grid";
    grid.dims = {2, 2, 3};
    for (int i = 0; i < 12; ++i) grid.points.push_back({i % 2 * 1.0, i / 2 % 2 * 1.0, i / 4 * 1.0});
    grid.dead_cells = {0, 1};
    d.objects = {fault, points, grid};
    for (const FormatOptions& way : all_ways) {
        const Written w = write_text(d, way);
        EXPECT_EQ(std::ranges::count(w.losses, LossClass::substance, &Loss::loss_class), 1) << "the pentagon";
        const auto back = read_text(w.bytes);
        ASSERT_TRUE(back.ok()) << back.why().error.message;
        const CellMesh& m = mesh_of(*back);
        EXPECT_EQ(m.points.size(), 19u);
        std::map<std::string, std::vector<CellType>> found;
        for (std::size_t i = 0; i < m.cell_count(); ++i)
            found[m.groups.at(m.entities.at(m.cell_entity[i]).groups.at(0)).name].push_back(m.types[i]);
        EXPECT_EQ(found["fault"], (std::vector{CellType::triangle, CellType::quad}));
        EXPECT_EQ(found["wells"].size(), 2u);
        EXPECT_EQ(found["grid"], std::vector{CellType::hexahedron});
        const auto at = std::ranges::find(m.types, CellType::hexahedron) - m.types.begin();
        const auto nodes = m.cell_nodes(static_cast<std::size_t>(at));
        EXPECT_EQ(m.points[nodes[2]], (Vec3{1, 1, 0}));
        EXPECT_EQ(m.points[nodes[4]], (Vec3{0, 0, 1}));
        const Attribute* q = find_attribute(m.info.attributes, "q", AttributeLocation::point);
        ASSERT_NE(q, nullptr);
        EXPECT_TRUE(q->no_data.has_value());
    }
}

TEST(MshWriting, WrongOptionsAreRefused) {
    const auto d = read_text(two_tets_41());
    const TemporaryFolder folder;
    for (const auto& option : FormatOptions{{"version", "5"}, {"binary", "maybe"}, {"order", "3"}}) {
        OutputSet outputs(folder / "x.msh");
        WriteOptions options;
        options.options = {option};
        const auto result = gmsh::write_msh(*d, outputs, options);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.why().kind, FailureKind::usage);
    }
}

TEST(MshRoundTrip, RealFilesComeBackTheSame) {
    for (const char* name : {"gmsh/toy_model.msh", "gmsh/cube_v22.msh", "gmsh/cube_v41.msh"}) {
        const auto path = real_data(name);
        if (!path) GTEST_SKIP() << "no real data";
        const auto d = gmsh::read_msh(*Input::open(path->string()), {});
        ASSERT_TRUE(d.ok());
        for (const FormatOptions& way : all_ways) {
            const auto back = read_text(write_text(*d, way).bytes);
            ASSERT_TRUE(back.ok()) << back.why().error.message;
            expect_same(mesh_of(*d), mesh_of(*back), name + way_text(way));
        }
    }
}

RC_GTEST_PROP(MshProperties, AnyMeshComesBack, ()) {
    CellMesh mesh;
    const auto points = *rc::gen::inRange<std::size_t>(4, 30);
    for (std::size_t i = 0; i < points; ++i) {
        mesh.points.push_back(
            {*rc::gen::arbitrary<double>(), *rc::gen::arbitrary<double>() * 1e-200, *rc::gen::arbitrary<double>() * 1e200});
        for (const double x : mesh.points.back()) RC_PRE(std::isfinite(x));
        mesh.point_labels.ids.push_back(static_cast<std::int64_t>(1 + i * *rc::gen::inRange<std::int64_t>(1, 2) * 1000 + i));
    }
    const auto entities = *rc::gen::inRange(1, 5);
    for (int e = 0; e < entities; ++e) {
        CellMesh::Entity entity;
        entity.dimension = e % 4;
        entity.tag = 10 + e;
        mesh.entities.push_back(entity);
    }
    constexpr CellType types[] = {CellType::vertex, CellType::line, CellType::triangle, CellType::tetrahedron};
    const auto cells = *rc::gen::inRange(1, 40);
    for (int i = 0; i < cells; ++i) {
        const int e = *rc::gen::inRange(0, entities);
        const CellType type = types[mesh.entities[static_cast<std::size_t>(e)].dimension];
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t k = 0; k < node_count(type); ++k)
            nodes.push_back(*rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(points)));
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(static_cast<std::uint32_t>(e));
    }
    Dataset d;
    d.objects.emplace_back(mesh);
    const auto back = read_text(write_text(d, all_ways[*rc::gen::inRange<std::size_t>(0, 4)]).bytes);
    RC_ASSERT(back.ok());
    RC_ASSERT(mesh_of(*back).points.size() == mesh.points.size());
    RC_ASSERT(picture(mesh_of(*back)) == picture(mesh));
}

}  // namespace
}  // namespace geomend::test
