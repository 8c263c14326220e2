// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "topology/keys.h"
#include "topology/model_maker.h"

namespace geomend::test {
namespace {

std::vector<Finding> findings_of_keys(Dataset& data) {
    data.findings.clear();
    topology::report_stated_keys("m.ml", data);
    return data.findings;
}

TEST(StatedKeys, ThatFitAreNotReported) {
    auto m = two_blocks();
    for (auto& face : m.model().faces) face.line = 7;
    EXPECT_TRUE(findings_of_keys(m.data).empty());
}

TEST(StatedKeys, ThatDoNotFitAreReportedOnceForEachCodeAtTheFirstRecord) {
    auto m = two_blocks();
    auto& faces = m.model().faces;
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f].line = 10 + f;
    for (const std::size_t f : {1, 2}) std::swap((*faces[f].key)[1], (*faces[f].key)[2]);
    faces[0].key = Triangle{at(0, 0, 0), at(5, 0, 0), at(0, 5, 0)};
    const auto found = findings_of_keys(m.data);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].code, "F106");
    EXPECT_EQ(found[0].count, 2u);
    EXPECT_EQ(found[0].elements, (std::vector<std::int64_t>{faces[1].number, faces[2].number}));
    EXPECT_EQ(to_string(found[0].where), "m.ml:11");
    EXPECT_EQ(found[1].code, "F116");
    EXPECT_EQ(to_string(found[1].where), "m.ml:10");
}

TEST(StatedKeys, WithoutAPlaceInTheFileAreLeftToTheModel) {
    auto m = two_blocks();
    m.model().faces[0].key = Triangle{at(0, 0, 0), at(5, 0, 0), at(0, 5, 0)};
    EXPECT_TRUE(findings_of_keys(m.data).empty());
}

/// A surface of three parts, each a triangle of its own, and a model whose faces have the keys of the parts in another order.
Dataset three_parts(const std::array<std::uint32_t, 3>& part_of_key) {
    Dataset data;
    Surface surface;
    StatedModel model;
    for (std::uint32_t part = 0; part < 3; ++part) {
        const double x = 10 * part;
        surface.points.insert(surface.points.end(), {{x, 0, 0}, {x + 5, 0, 0}, {x, 5, 0}});
        surface.parts.push_back({3 * part, part});
        surface.polygons.push_back(std::array{3 * part, 3 * part + 1, 3 * part + 2});
    }
    for (std::uint32_t f = 0; f < 3; ++f) {
        StatedModel::Face face;
        face.number = 20 + f;
        face.line = 5 + f;
        face.object = 0;
        face.part = f;
        const std::uint32_t first = 3 * part_of_key[f];
        face.key = Triangle{surface.points[first + 1], surface.points[first + 2], surface.points[first]};
        model.faces.push_back(face);
    }
    data.objects.emplace_back(std::move(surface));
    data.models.push_back(std::move(model));
    return data;
}

std::vector<std::uint32_t> parts_found(Dataset data) {
    topology::find_parts_by_keys(data);
    std::vector<std::uint32_t> parts;
    for (const auto& face : data.models[0].faces) parts.push_back(face.part);
    return parts;
}

TEST(StatedKeys, TellWhichPartARecordIsOfWhateverItsNumber) {
    EXPECT_EQ(parts_found(three_parts({0, 1, 2})), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(parts_found(three_parts({2, 0, 1})), (std::vector<std::uint32_t>{2, 0, 1}));
}

TEST(StatedKeys, ThatDoNotTellAllPartsApartChangeNothing) {
    EXPECT_EQ(parts_found(three_parts({2, 2, 1})), (std::vector<std::uint32_t>{0, 1, 2})) << "two records with one key";
    Dataset data = three_parts({2, 0, 1});
    (*data.models[0].faces[1].key)[0][2] = 7;
    EXPECT_EQ(parts_found(data), (std::vector<std::uint32_t>{0, 1, 2})) << "a key that is nowhere";
}

}  // namespace
}  // namespace geomend::test
