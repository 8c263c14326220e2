// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/record_lines.h"

#include <gtest/gtest.h>

namespace geomend::gocad {
namespace {

constexpr std::string_view text =
    "GOCAD TSurf 1\n"          // 1
    "HEADER {\n"               // 2
    "name: first one\n"        // 3
    "}\n"                      // 4
    "TFACE\n"                  // 5
    "VRTX 1 0 0 0\n"           // 6
    "PVRTX 2 1 0 0 5\n"        // 7
    "ATOM 3 1\n"               // 8
    "TRGL 1 2 3\n"             // 9
    "TFACE\n"                  // 10
    "  TRGL 3 2 1\r\n"         // 11
    "BORDER 7 1 2\n"           // 12
    "END\n"                    // 13
    "GOCAD TSurf 1\n"          // 14
    "HEADER {name:second}\n"   // 15
    "TFACE\n"                  // 16
    "TRGL 1 2 3\n"             // 17
    "END\n"                    // 18
    "GOCAD Model3d 1\n"        // 19
    "HEADER {\n"               // 20
    "name:m\n"                 // 21
    "}\n"                      // 22
    "REGION 5  upper part \n"  // 23
    " 1 0\n"                   // 24
    "LAYER \"L 1\"\n"          // 25
    " 5 0\n"                   // 26
    "FAULT_BLOCK west\n"       // 27
    "REGION 6  twice\n"        // 28
    "REGION 7  twice\n"        // 29
    "END";                     // 30

std::uint64_t line_of(RecordQuery query, std::string_view in = text) { return record_lines(in, std::vector{std::move(query)}).front(); }

TEST(RecordLines, OfElementsOfAnObject) {
    EXPECT_EQ(line_of({RecordQuery::triangle, "first one", 2, {}}), 11u) << "counted over all TFACEs";
    EXPECT_EQ(line_of({RecordQuery::triangle, "second", 1, {}}), 17u);
    EXPECT_EQ(line_of({RecordQuery::triangle, "second", 2, {}}), 0u);
    EXPECT_EQ(line_of({RecordQuery::point, "first one", 2, {}}), 7u);
    EXPECT_EQ(line_of({RecordQuery::point, "first one", 3, {}}), 8u);
    EXPECT_EQ(line_of({RecordQuery::border, "first one", 7, {}}), 12u);
    EXPECT_EQ(line_of({RecordQuery::border, "second", 7, {}}), 0u);
}

TEST(RecordLines, OfTheListsOfAModel) {
    EXPECT_EQ(line_of({RecordQuery::region, {}, 0, "upper part"}), 23u);
    EXPECT_EQ(line_of({RecordQuery::layer, {}, 0, "L 1"}), 25u);
    EXPECT_EQ(line_of({RecordQuery::fault_block, {}, 0, "west"}), 27u);
    EXPECT_EQ(line_of({RecordQuery::layer, {}, 0, "west"}), 0u);
}

TEST(RecordLines, AreNotGivenWhereNamesDoNotTellThemApart) {
    EXPECT_EQ(line_of({RecordQuery::region, {}, 0, "twice"}), 0u);
    const std::string two = std::string(text) + "\n" + std::string(text);
    EXPECT_EQ(line_of({RecordQuery::triangle, "second", 1, {}}, two), 0u);
}

TEST(RecordLines, AreFoundForManyQueriesAtOnceAndInNoText) {
    const std::vector<RecordQuery> queries{{RecordQuery::triangle, "first one", 1, {}}, {RecordQuery::triangle, "first one", 1, {}}};
    EXPECT_EQ(record_lines(text, queries), (std::vector<std::uint64_t>{9, 9}));
    EXPECT_EQ(record_lines("", queries), (std::vector<std::uint64_t>{0, 0}));
}

}  // namespace
}  // namespace geomend::gocad
