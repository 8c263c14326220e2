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

}  // namespace
}  // namespace geomend::test
