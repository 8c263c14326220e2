// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gocad/gocad_support.h"
#include "support/real_data.h"

using namespace geomend;
using namespace geomend::test;

namespace {

const char* const two_volumes =
    "GOCAD TSolid 1\nHEADER {\nname:ts\n}\n"
    "TETRA_PROPERTIES phi\nTETRA_NO_DATA_VALUES -99999\nTETRA_ESIZES 1\n"
    "TVOLUME A\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nVRTX 4 0 0 1\n"
    "TETRA 1 2 3 4 0.25\n# CTETRA A none none none -f\n"
    "TVOLUME B\nATOM 5 1\nATOM 6 2\nATOM 7 3\nVRTX 8 0 0 -1\n"
    "TETRA 5 7 6 8 0.5\n# CTETRA B none none none +f\n"
    "MODEL\nSURFACE f\nTFACE 1\nKEYVERTICES 1 2 3\nTRGL 1 2 3\nMODEL_REGION A +1\nMODEL_REGION B -1\nEND\n";

const char* const light =
    "GOCAD LightTSolid 1\nHEADER {\nname: l\n}\n"
    "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n"
    "VRTX 1 0 0 0 XYZ\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nVRTX 4 0 0 -1\nSHAREDVRTX 5 1\nVRTX 6 0 0 1\nSHAREDVRTX 7 2\nSHAREDVRTX 8 3\n"
    "TETRA 1 2 3 4\n# CTETRA \"Top 1\" none none none -(boundary)\"f 1\"\n"
    "TETRA 5 8 7 6\n# CTETRA Base none none none +(boundary)\"f 1\"\n"
    "MODEL\nSURFACE \"f 1\"\nTFACE 1\nKEYVERTICES 1 2 3\nTRGL 1 2 3\nMODEL_REGION \"Top 1\" +1\nMODEL_REGION Base -1\nEND\n";

const CellMesh& mesh_at(const Dataset& dataset, std::size_t i) { return std::get<CellMesh>(dataset.objects.at(i)); }

double six_volumes(const CellMesh& mesh, std::size_t cell) {
    const auto t = mesh.cell_nodes(cell);
    std::array<Vec3, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t c = 0; c < 3; ++c) e[i][c] = mesh.points[t[i + 1]][c] - mesh.points[t[0]][c];
    }
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

void expect_same_mesh(const CellMesh& a, const CellMesh& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.alias, b.alias);
    EXPECT_EQ(a.types, b.types);
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.cell_entity, b.cell_entity);
    ASSERT_EQ(a.entities.size(), b.entities.size());
    for (std::size_t e = 0; e < a.entities.size(); ++e) EXPECT_EQ(a.entities[e].name, b.entities[e].name);
    EXPECT_EQ(a.facet_names, b.facet_names);
    ASSERT_EQ(a.facet_tags.size(), b.facet_tags.size());
    for (std::size_t f = 0; f < a.facet_tags.size(); ++f) {
        EXPECT_EQ(a.facet_tags[f].name, b.facet_tags[f].name);
        EXPECT_EQ(a.facet_tags[f].sign, b.facet_tags[f].sign);
        EXPECT_EQ(a.facet_tags[f].boundary, b.facet_tags[f].boundary);
    }
}

// The mesh as other formats hold it: one node per position, cells as they are.
CellMesh welded(CellMesh mesh) {
    std::vector<std::uint32_t> number(mesh.points.size(), no_index);
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
        if (!mesh.alias.empty() && mesh.alias[i] != no_index) continue;
        number[i] = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh.points[i]);
    }
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
        if (number[i] == no_index) number[i] = number[mesh.alias[i]];
    }
    for (std::uint32_t& node : mesh.nodes) node = number[node];
    mesh.points = std::move(points);
    mesh.alias.clear();
    mesh.point_labels = {};
    std::erase_if(mesh.info.attributes, [](const Attribute& a) { return a.location == AttributeLocation::point; });
    std::erase_if(mesh.info.sets, [](const NamedSet& s) { return s.location == AttributeLocation::point; });
    return mesh;
}

}  // namespace

TEST(Solid, TSolidHasVolumesTwinsValuesAndTheSidesOfItsModel) {
    const Dataset data = dataset_of(two_volumes);
    ASSERT_EQ(data.objects.size(), 1u);
    const CellMesh& mesh = mesh_at(data, 0);
    EXPECT_EQ(mesh.points.size(), 8u);
    EXPECT_EQ(std::ranges::count(mesh.alias, no_index), 5);
    ASSERT_EQ(mesh.cell_count(), 3u);  // two tetrahedra, one triangle
    EXPECT_EQ(six_volumes(mesh, 0), 1.0);
    EXPECT_EQ(six_volumes(mesh, 1), 1.0);
    const Attribute* phi = find_attribute(mesh.info.attributes, "phi", AttributeLocation::cell);
    ASSERT_NE(phi, nullptr);
    EXPECT_EQ(value_as_double(*phi, 0), 0.25);
    EXPECT_EQ(value_as_double(*phi, 1), 0.5);
    ASSERT_EQ(data.models.size(), 1u);
    ASSERT_EQ(data.models[0].regions.size(), 2u);
    EXPECT_EQ(data.models[0].regions[0].name, "A");
    ASSERT_EQ(data.models[0].regions[0].sides.size(), 1u);
    EXPECT_TRUE(data.models[0].regions[0].sides[0].front);
    EXPECT_FALSE(data.models[0].regions[1].sides.at(0).front);
}

TEST(Solid, LightTSolidIsTurnedUpAndKeepsFlagsAndFacetTags) {
    const Dataset data = dataset_of(light);
    ASSERT_EQ(data.objects.size(), 1u);
    const CellMesh& mesh = mesh_at(data, 0);
    EXPECT_EQ(six_volumes(mesh, 0), 1.0);
    EXPECT_EQ(six_volumes(mesh, 1), 1.0);
    ASSERT_GE(mesh.entities.size(), 2u);
    EXPECT_EQ(mesh.entities[0].name, "Top 1");
    EXPECT_EQ(mesh.entities[1].name, "Base");
    ASSERT_EQ(mesh.facet_tags.size(), 8u);
    EXPECT_EQ(mesh.facet_tags[3].sign, -1);
    EXPECT_EQ(mesh.facet_tags[7].sign, 1);
    EXPECT_TRUE(mesh.facet_tags[3].boundary);
    EXPECT_EQ(mesh.facet_names.at(mesh.facet_tags[3].name), "f 1");
    ASSERT_EQ(mesh.info.sets.size(), 1u);
    EXPECT_EQ(mesh.info.sets[0].name, "gocad.control:XYZ");
    EXPECT_EQ(mesh.info.sets[0].members, (std::vector<std::uint32_t>{0}));
}

TEST(Solid, ComesBackAsItWasFromBothKinds) {
    for (const auto& [text, format] : {std::pair{two_volumes, "gocad-so"}, std::pair{light, "gocad-lso"}}) {
        const Dataset data = dataset_of(text);
        std::vector<Loss> losses;
        const std::string once = written(data, format, &losses);
        EXPECT_TRUE(losses.empty()) << (losses.empty() ? "" : losses[0].what);
        const Dataset back = dataset_of(once);
        ASSERT_EQ(back.objects.size(), 1u);
        expect_same_mesh(mesh_at(data, 0), mesh_at(back, 0));
        EXPECT_EQ(written(back, format), once);
    }
}

TEST(Solid, CoordinatesComeBackBitByBit) {
    Dataset data = dataset_of(two_volumes);
    CellMesh& mesh = std::get<CellMesh>(data.objects[0]);
    mesh.points[3] = {0.1 + 0.2, -1e-300, 123456.78901234567};
    mesh.points[7] = {1.0 / 3, 5e15 / 7, -0.1};
    const Dataset back = dataset_of(written(data, "gocad-so"));
    EXPECT_EQ(mesh_at(back, 0).points, mesh.points);
}

TEST(Solid, AMeshWithoutTwinsGetsThemWhereVolumesMeet) {
    Dataset data = dataset_of(two_volumes);
    std::get<CellMesh>(data.objects[0]) = welded(mesh_at(data, 0));
    ASSERT_EQ(mesh_at(data, 0).points.size(), 5u);
    for (const char* format : {"gocad-so", "gocad-lso"}) {
        const std::string text = written(data, format);
        const Dataset back = dataset_of(text);
        ASSERT_EQ(back.objects.size(), 1u);
        expect_same_mesh(mesh_at(dataset_of(two_volumes), 0), mesh_at(back, 0));
    }
}

TEST(Solid, TwinsHaveTheValuesAndSetsOfTheirNode) {
    Dataset data = dataset_of(two_volumes);
    CellMesh mesh = welded(mesh_at(data, 0));
    Attribute v;
    v.name = "v";
    v.values = std::vector<double>{1, 2, 3, 4, 5};
    mesh.info.attributes.push_back(v);
    mesh.info.sets.push_back({"r", AttributeLocation::point, {1, 4}});
    data.objects[0] = std::move(mesh);
    const Dataset back = dataset_of(written(data, "gocad-so"));
    EXPECT_EQ(values_of(mesh_at(back, 0).info, "v"), (std::vector<double>{1, 2, 3, 4, 1, 2, 3, 5}));
    ASSERT_EQ(mesh_at(back, 0).info.sets.size(), 1u);
    EXPECT_EQ(mesh_at(back, 0).info.sets[0].members, (std::vector<std::uint32_t>{1, 5, 7}));
}

TEST(Solid, UnitsAndKindsThatNobodyStatedAreNotInvented) {
    std::string text = two_volumes;
    text.erase(text.find("TETRA_NO_DATA_VALUES"), std::string("TETRA_NO_DATA_VALUES -99999\n").size());
    const Dataset back = dataset_of(written(dataset_of(text), "gocad-so"));
    const Attribute* phi = find_attribute(mesh_at(back, 0).info.attributes, "phi", AttributeLocation::cell);
    ASSERT_NE(phi, nullptr);
    EXPECT_EQ(phi->unit, "");
    EXPECT_EQ(phi->kind, "");
    EXPECT_EQ(phi->property_class, "");
    EXPECT_FALSE(phi->no_data.has_value());
    EXPECT_TRUE(phi->annotations.empty());
}

TEST(Solid, LinesOfSurfacesAreALossOfIdentityLonelyLinesOneOfSubstance) {
    Dataset data = dataset_of(two_volumes);
    CellMesh& mesh = std::get<CellMesh>(data.objects[0]);
    mesh.add_cell(CellType::line, std::array<std::uint32_t, 2>{0, 1});
    mesh.cell_entity.push_back(no_index);
    for (Attribute& a : mesh.info.attributes) std::get<std::vector<double>>(a.values).push_back(-99999);
    std::vector<Loss> losses;
    written(data, "gocad-so", &losses);
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].loss_class, LossClass::identity);
    mesh.points.push_back({9, 9, 9});
    mesh.alias.push_back(no_index);
    mesh.point_labels = {};
    mesh.nodes.back() = 8;
    written(data, "gocad-so", &losses);
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].loss_class, LossClass::substance);
}

TEST(Solid, EndingAtAnyLineIsNeverASilentSuccess) {
    for (const std::string& whole : {std::string(two_volumes), std::string(light)}) {
        for (std::size_t end = whole.find('\n'); end + 1 < whole.size(); end = whole.find('\n', end + 1)) {
            const auto read = read_text(whole.substr(0, end + 1));
            if (read.ok()) {
                EXPECT_FALSE(read->findings.empty()) << whole.substr(0, end);
            }
        }
    }
}

TEST(RealSolid, WeldedMeshesComeBackWithAsManyNodesAsGocadHadWritten) {
    for (const auto& [name, nodes] :
         {std::pair{"gocad/modelA4.so", 10216u}, std::pair{"gocad/cube_model_equi.so", 69u}, std::pair{"gocad/test.lso", 470u}}) {
        const auto path = real_data(name);
        if (!path) GTEST_SKIP();
        auto input = Input::open(path->string());
        ASSERT_TRUE(input.ok());
        auto read = gocad::read_gocad(*input, {});
        ASSERT_TRUE(read.ok());
        Dataset data = std::move(*read);
        const CellMesh original = mesh_at(data, 0);
        EXPECT_EQ(original.points.size(), nodes) << name;
        std::get<CellMesh>(data.objects[0]) = welded(original);
        const Dataset back = dataset_of(written(data, std::string_view(name).ends_with(".lso") ? "gocad-lso" : "gocad-so"));
        ASSERT_EQ(back.objects.size(), 1u);
        const CellMesh& mesh = mesh_at(back, 0);
        EXPECT_EQ(mesh.points.size(), nodes) << name;
        ASSERT_EQ(mesh.entities.size(), original.entities.size());
        for (std::size_t e = 0; e < mesh.entities.size(); ++e) EXPECT_EQ(mesh.entities[e].name, original.entities[e].name);
    }
}
