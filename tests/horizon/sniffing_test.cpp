// SPDX-License-Identifier: AGPL-3.0-or-later
#include <set>

#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

std::string found(std::string_view content, std::string_view name) {
    std::string best = "none";
    int best_score = 0;
    for (const Format& row : horizon::formats()) {
        const int score = row.sniff(content, name);
        if (score > best_score) best = row.name;
        best_score = std::max(score, best_score);
    }
    return best;
}

TEST(Sniffing, ContentDecidesWhateverTheExtension) {
    for (const char* name : {"a.txt", "a", "a.dat", "a.xyz"}) {
        EXPECT_EQ(found("-996 2 25.0 50.0\n0 1 0 1\n", name), "irap-grid") << name;
        EXPECT_EQ(found(std::string("\0\0\0\x20\xff\xff\xfc\x1c\0\0\0\2", 12), name), "irap-grid-binary") << name;
        EXPECT_EQ(found("!\n! c\n@GRID FILE, GRID, 4\n20, 1e30, , 7, 1\n", name), "zmap") << name;
        EXPECT_EQ(found("FSASCI 0 1 COMPUTED 0 1E30\n", name), "cps3") << name;
        EXPECT_EQ(found("FFASCI 0 1 \"LINES\" 0 1e+10\n", name), "cps3-lines") << name;
        EXPECT_EQ(found("# Petrel Points with attributes\n# Unit in depth: m\n", name), "petrel-points") << name;
        EXPECT_EQ(found("Float a\n1 2 3 4\n", name), "irap-points") << name;
        EXPECT_EQ(found("x,y,z\n1,2,3\n", name), "points-table") << name;
        EXPECT_EQ(found("!\n@FAULTS, FAULT, 80, 1\n", name), "zmap-lines") << name;
    }
}

// Rows of three numbers may be points, lines or anything: the extension says it, or --from.
TEST(Sniffing, TablesOfNumbersAreWhatTheirExtensionSays) {
    for (const char* name : {"a.xyz", "a.poi", "A.POI", "a.irapp"}) {
        EXPECT_EQ(found("1 2 3\n4 5 6\n", name), "irap-points") << name;
        EXPECT_EQ(found("1 2 3\n4 5 6\n999.0 999.0 999.0\n", name), "irap-points") << name;
    }
    for (const char* name : {"a.pol", "a.irapl", "a.txt", "a"}) {
        EXPECT_EQ(found("1 2 3\n4 5 6\n", name), "none") << name;
        EXPECT_EQ(found("1 2 3\n4 5 6\n999.0 999.0 999.0\n", name), "irap-polygons") << name;
    }
}

TEST(Sniffing, OtherFamiliesAreLeftAlone) {
    const std::vector<std::string> others = {"GOCAD TSurf 1\nHEADER {\nname:a\n}\n",
                                             "# comment first\nGOCAD VSet 1\n",
                                             "# vtk DataFile Version 3.0\nt\nASCII\n",
                                             "<?xml version=\"1.0\"?>\n<VTKFile>\n",
                                             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                                             "$NOD\n1\n1 0 0 0\n",
                                             "SPECGRID\n 1 1 3 1 F /\n",
                                             "-- comment\nCOORD\n0 0 0 0 0 0\n/\n",
                                             "ncols 4\nnrows 3\n",
                                             "@article, {a}\n",
                                             "",
                                             std::string("\0\0\0\x10", 4) + "SPECGRID"};
    for (const std::string& content : others) {
        for (const Format& row : horizon::formats()) EXPECT_EQ(row.sniff(content, "a.xyz"), 0) << row.name << ": " << content;
    }
}

TEST(Sniffing, AHeadThatIsCutInALineIsNoObstacle) {
    EXPECT_GT(format("irap-points").sniff("1 2 3\n4 5 6\n7 8", "a.xyz"), 0);
    EXPECT_GT(format("irap-polygons").sniff("1 2 3\n999 999 999\n7 8", "a"), 0);
}

TEST(TableOfFormats, SaysWhatWasTriedAndWhatIsReadAlone) {
    std::set<std::string_view> read_alone, fixtures;
    for (const Format& row : horizon::formats()) {
        EXPECT_NE(row.read, nullptr) << row.name;
        EXPECT_FALSE(row.extensions.empty()) << row.name;
        EXPECT_FALSE(row.lossy_note.empty()) << row.name;
        if (row.write == nullptr) read_alone.insert(row.name);
        if (row.tried_on == "fixtures only: no real file was found") fixtures.insert(row.name);
        else EXPECT_EQ(row.tried_on, "real files") << row.name;
    }
    EXPECT_EQ(read_alone, (std::set<std::string_view>{"ijxyz", "points-table", "zmap-lines"}));
    EXPECT_EQ(fixtures, (std::set<std::string_view>{"cps3", "cps3-lines", "ijxyz", "petrel-points"}));
}

}  // namespace
}  // namespace geomend::test
