// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gocad/gocad_support.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

struct Counts {
    const char* file;
    std::size_t objects, points, elements;  // points and triangles (or segments) of all objects
};

class RealGocad : public testing::TestWithParam<Counts> {};

std::pair<std::size_t, std::size_t> count(const Dataset& d) {
    std::pair<std::size_t, std::size_t> sum{0, 0};
    for (const Object& object : d.objects) {
        if (const auto* s = std::get_if<Surface>(&object)) sum = {sum.first + s->points.size(), sum.second + s->polygons.size()};
        if (const auto* l = std::get_if<PolylineSet>(&object)) sum = {sum.first + l->points.size(), sum.second + l->edges.size()};
        if (const auto* p = std::get_if<PointSet>(&object)) sum.first += p->points.size();
    }
    return sum;
}

TEST_P(RealGocad, HasItsCountsAndComesBack) {
    const auto path = real_data(std::string("gocad/") + GetParam().file);
    if (!path) GTEST_SKIP() << "no real data";
    const auto input = Input::open(path->string());
    ASSERT_TRUE(input.ok());
    const auto read = gocad::read_gocad(*input, {});
    ASSERT_TRUE(read.ok()) << to_string(read.why().error.where) << ' ' << read.why().error.message;
    EXPECT_EQ(read->objects.size(), GetParam().objects);
    EXPECT_EQ(count(*read), std::pair(GetParam().points, GetParam().elements));
    const std::string format = read->models.empty() ? "gocad-ts" : "gocad-ml";
    const std::string once = written(*read, format);
    const auto again = read_text(once);
    ASSERT_TRUE(again.ok()) << again.why().error.message;
    ASSERT_EQ(again->objects.size(), read->objects.size());
    for (std::size_t i = 0; i != read->objects.size(); ++i) {
        const auto* a = std::get_if<Surface>(&read->objects[i]);
        const auto* b = std::get_if<Surface>(&again->objects[i]);
        if (a == nullptr || b == nullptr) continue;
        EXPECT_TRUE(a->points == b->points && a->polygons.corners == b->polygons.corners && a->alias == b->alias);
        EXPECT_EQ(a->labels.ids, b->labels.ids);
        ASSERT_EQ(a->info.attributes.size(), b->info.attributes.size());
        for (std::size_t k = 0; k != a->info.attributes.size(); ++k) EXPECT_EQ(a->info.attributes[k].values, b->info.attributes[k].values);
    }
    for (std::size_t m = 0; m != read->models.size(); ++m) {
        EXPECT_EQ(read->models[m].regions.size(), again->models.at(m).regions.size());
        EXPECT_EQ(read->models[m].faces.size(), again->models[m].faces.size());
    }
    EXPECT_EQ(written(*again, format), once);
}

INSTANTIATE_TEST_SUITE_P(
    Files, RealGocad,
    testing::Values(Counts{"2triangles.ts", 1, 4, 2}, Counts{"surf2d_multi.ts", 2, 92, 92}, Counts{"ts-2props.ts", 1, 4, 2},
                    Counts{"geom_with_properties.ts", 1, 5215, 10066}, Counts{"tsurf_eks.ts", 1, 159, 253},
                    Counts{"normal_lines.pl", 1, 11391, 11374}, Counts{"points.vs", 1, 6, 0}, Counts{"auscope/tsTest.ts", 1, 582, 989},
                    Counts{"auscope/vsTest.vs", 1, 2764, 0}, Counts{"auscope/test002.ts", 1, 3, 1}, Counts{"auscope/test014.ts", 1, 3, 1},
                    Counts{"auscope/test026.ts", 1, 3, 1}, Counts{"auscope/2layer.gp", 3, 9, 6}, Counts{"auscope/gpTest.gp", 6, 6, 0},
                    Counts{"scec_cfm/GVFA-WWFZ-EAST-Scodie_Lineament-CFM1.ts", 1, 6, 4},
                    Counts{"scec_cfm/CASC-BMMR-BLDM-Bald_Mountain_Big_Lagoon-CFM7_500m.ts", 1, 27155, 53375},
                    Counts{"modelA1.ml", 9, 5118, 7932}, Counts{"not_sealed_cube.ml", 6, 24, 12}, Counts{"split_cube.ml", 2, 20, 22}),
    [](const testing::TestParamInfo<Counts>& one) {
        std::string name = one.param.file;
        for (char& c : name) {
            if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
        }
        return name;
    });

TEST(RealGocadModel, TrianglesAndListsOfTheModelsAreThose) {
    for (const auto& [file, faces, regions, triangles] :
         {std::tuple{"gocad/modelA1.ml", 21u, 5u, 7932u}, std::tuple{"gocad/modelA4.ml", 55u, 9u, 48903u},
          std::tuple{"gocad/CloudSpin.ml", 115u, 8u, 30751u}, std::tuple{"gocad/CloudSpin_fixed.ml", 115u, 8u, 30751u}}) {
        const auto path = real_data(file);
        if (!path) GTEST_SKIP() << "no real data";
        const auto read = gocad::read_gocad(*Input::open(path->string()), {});
        ASSERT_TRUE(read.ok()) << file << read.why().error.message;
        ASSERT_EQ(read->models.size(), 1u);
        EXPECT_EQ(read->models[0].faces.size(), faces) << file;
        EXPECT_EQ(read->models[0].regions.size(), regions) << file;
        EXPECT_EQ(count(*read).second, triangles) << file;
    }
}

TEST(RealGocadDamaged, FilesMadeWrongAreRefusedWithTheirLine) {
    for (const char* file : {"010.ts", "012.ts", "016.ts", "018.ts", "020.vs", "034.ts", "036.ts"}) {
        const auto path = real_data(std::string("gocad/auscope/test") + file);
        if (!path) GTEST_SKIP() << "no real data";
        const auto read = gocad::read_gocad(*Input::open(path->string()), {});
        ASSERT_FALSE(read.ok()) << file;
        EXPECT_NE(read.why().error.where.line, 0u) << file;
        EXPECT_FALSE(read.why().error.where.file.empty());
    }
}

}  // namespace
}  // namespace geomend::test
