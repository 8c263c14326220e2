// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gocad/gocad_support.h"

namespace geomend::test {
namespace {

// A tetrahedron with a triangle hanging inside it.
const std::string header =
    "GOCAD Model3d 1\nHEADER {\nname:m\n*layers*visible: on\n}\nTSURF skin\nTSURF frac\n"
    "TFACE 1  boundary skin\n  0 0 0\n  0 1 0\n  1 0 0\nTFACE 2  fault frac\n  0.1 0.1 0.1\n  0.2 0.1 0.1\n  0.1 0.2 0.1\n"
    "REGION 3  Universe\n  +1  0\nREGION 4  R\n  -1  +2\n  -2\n  0\nSURFACE cracks\n  2  0\nLAYER L\n  4  0\nFAULT_BLOCK B\n  4  9  "
    "0\nEND\n";
const std::string skin =
    "GOCAD TSurf 1\nHEADER {\nname:skin\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nVRTX 4 0 0 1\n"
    "TRGL 1 3 2\nTRGL 1 2 4\nTRGL 2 3 4\nTRGL 3 1 4\nEND\n";
const std::string frac =
    "GOCAD TSurf 1\nHEADER {\nname:frac\n}\nTFACE\nVRTX 1 0.1 0.1 0.1\nVRTX 2 0.2 0.1 0.1\nVRTX 3 0.1 0.2 0.1\nTRGL 1 2 3\nEND\n";
const std::string whole = header + skin + frac;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(GocadModel3d, ListsBecomeTheClaimsOfTheFile) {
    const Dataset d = dataset_of(whole);
    ASSERT_EQ(d.models.size(), 1u);
    const StatedModel& m = d.models[0];
    EXPECT_EQ(m.name, "m");
    ASSERT_EQ(m.faces.size(), 2u);
    EXPECT_EQ(m.faces[1].object, 1u);
    EXPECT_EQ(m.faces[1].role, FeatureRole::fault);
    EXPECT_EQ(m.faces[1].interface_name, "frac");
    ASSERT_TRUE(m.faces[0].key.has_value());
    EXPECT_EQ((*m.faces[0].key)[1], (Vec3{0, 1, 0}));
    ASSERT_EQ(m.regions.size(), 2u);
    EXPECT_TRUE(m.regions[0].universe);
    ASSERT_EQ(m.regions[1].sides.size(), 3u);
    EXPECT_FALSE(m.regions[1].sides[0].front);
    EXPECT_TRUE(m.regions[1].sides[1].front);
    EXPECT_EQ(m.regions[1].sides[2].face, 1u);
    ASSERT_EQ(m.layers.size(), 1u);
    EXPECT_EQ(m.layers[0].regions, std::vector<std::uint32_t>{1});
    EXPECT_EQ(m.fault_blocks.at(0).unresolved, std::vector<std::int64_t>{9});
    EXPECT_EQ(m.features.at(0).faces, std::vector<std::uint32_t>{1});
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings[0].code, "F109");
}

TEST(GocadModel3d, RecordsMayComeInAnotherOrder) {
    const std::string mixed =
        "GOCAD Model3d 1\nLAYER L\n 4 0\nREGION 4 R\n -1 +2 -2 0\nTFACE 2 fault frac\n0.1 0.1 0.1 0.2 0.1 0.1\n0.1 0.2 0.1\n"
        "TSURF frac\nREGION 3 Universe\n+1\n0\nTFACE 1 boundary skin\n0 0 0\n0 1 0\n1 0 0\nTSURF skin\nEND\n";
    const Dataset d = dataset_of(mixed + skin + frac);
    ASSERT_EQ(d.models.size(), 1u);
    const StatedModel& m = d.models[0];
    EXPECT_EQ(m.faces.at(0).interface_name, "frac");
    EXPECT_EQ(m.faces.at(0).object, 1u);
    EXPECT_EQ(m.faces.at(1).object, 0u);
    EXPECT_EQ(m.regions.at(0).sides.size(), 3u);
    EXPECT_TRUE(d.findings.empty());
}

TEST(GocadModel3d, FacesKnowTheLinesOfTheirRecords) {
    const Dataset d = dataset_of(whole);
    const auto line_of = [](const std::string& text) {
        return static_cast<std::uint64_t>(1 +
                                          std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.find(text)), '\n'));
    };
    EXPECT_EQ(d.models.at(0).faces.at(0).line, line_of("TFACE 1 "));
    EXPECT_EQ(d.models.at(0).faces.at(1).line, line_of("TFACE 2 "));
}

TEST(GocadModel3d, WhatDoesNotFitIsRefused) {
    EXPECT_EQ(read_text(header + skin).why().error.code, "F007");
    EXPECT_EQ(read_text(replaced(whole, "-1  +2", "-1  +7")).why().error.code, "F007");
    EXPECT_EQ(read_text(replaced(whole, "fault frac", "fault crack")).why().error.code, "F007");
    EXPECT_EQ(read_text(replaced(whole, "TRGL 1 2 4\n", "TFACE\nTRGL 1 2 4\n")).why().error.code, "F008");
    EXPECT_EQ(read_text(replaced(whole, "  0 1 0\n", "  0 x 0\n")).why().error.code, "F005");
    EXPECT_TRUE(has_finding(dataset_of(replaced(whole, "  4  0\nFAULT", "  4\nFAULT")), "F108"));
}

TEST(GocadModel3d, ComesBackAsItWas) {
    const Dataset d = dataset_of(whole);
    const std::string once = written(d, "gocad-ml");
    const Dataset again = dataset_of(once);
    ASSERT_EQ(again.models.size(), 1u);
    EXPECT_EQ(again.models[0].fault_blocks.at(0).unresolved, std::vector<std::int64_t>{9});
    EXPECT_EQ(again.models[0].regions.at(1).sides.size(), 3u);
    EXPECT_EQ(again.models[0].features.at(0).name, "cracks");
    EXPECT_NE(once.find("*layers*visible: on\n"), std::string::npos);
    EXPECT_EQ(written(again, "gocad-ml"), once);
}

TEST(GocadModel3d, DepthComesBackAsDepth) {
    const std::string block = "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
    std::string text = replaced(whole, "TSURF skin\n", block + "TSURF skin\n");
    text = replaced(text, "name:skin\n}\n", "name:skin\n}\n" + block);
    text = replaced(text, "name:frac\n}\n", "name:frac\n}\n" + block);
    const Dataset d = dataset_of(text);
    EXPECT_EQ(surface_at(d, 0).points[3][2], -1);
    EXPECT_EQ((*d.models.at(0).faces.at(1).key)[0][2], -0.1);
    EXPECT_NE(written(d, "gocad-ml").find("TFACE 2  fault frac\n  0.1 0.1 0.1\n"), std::string::npos);
}

TEST(GocadModel3d, UniverseIsAddedWhereNoneIsStated) {
    Dataset d = dataset_of(whole);
    d.models[0].regions.erase(d.models[0].regions.begin());
    d.models[0].layers.clear();
    d.models[0].fault_blocks.clear();
    const Dataset again = dataset_of(written(d, "gocad-ml"));
    ASSERT_EQ(again.models.at(0).regions.size(), 2u);
    ASSERT_TRUE(again.models[0].regions[0].universe);
    ASSERT_EQ(again.models[0].regions[0].sides.size(), 1u);
    EXPECT_TRUE(again.models[0].regions[0].sides[0].front);
    EXPECT_EQ(again.models[0].regions[0].sides[0].face, 0u);
}

TEST(GocadModel3d, SurfacesAloneAreNoModel) {
    const Dataset d = dataset_of(skin);
    const TemporaryFolder folder;
    OutputSet files(folder / "out.ml");
    const auto done = format_row("gocad-ml").write(d, files, {});
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.why().kind, FailureKind::cannot_hold);
}

TEST(GocadModel3d, AsSurfacesItLosesItsRegions) {
    std::vector<Loss> losses;
    written(dataset_of(whole), "gocad-ts", &losses);
    EXPECT_TRUE(std::ranges::any_of(losses, [](const Loss& l) { return l.loss_class == LossClass::substance; }));
}

// A prefix of the file is refused, or it says that something may be missing; it never passes for the whole.
TEST(GocadModel3d, TruncatedAnywhereIsNeverASilentSuccess) {
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
        const auto read = read_text(whole.substr(0, size));
        if (!read.ok()) {
            EXPECT_FALSE(read.why().error.message.empty());
            continue;
        }
        EXPECT_TRUE(has_finding(*read, "F101")) << "cut at " << size << ": ..." << whole.substr(size > 30 ? size - 30 : 0, 30);
    }
}

TEST(GocadModel3d, CutInsideTheEndOfABlockIsSeen) {
    EXPECT_EQ(read_text("GOCAD Model3d 1\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\nEND").why().error.code, "F004");
    EXPECT_EQ(read_text("GOCAD TSurf 1\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\nEND").why().error.code, "F004");
}

TEST(GocadModel3d, AnyByteMayBeWrongWithoutHarm) {
    for (std::size_t i = 0; i != whole.size(); ++i) {
        for (const char c : {'\0', '\n', '9', '-', '{', '\xff'}) {
            std::string text = whole;
            text[i] = c;
            const auto read = read_text(std::move(text));
            if (read.ok()) continue;
            EXPECT_FALSE(read.why().error.code.empty());
        }
    }
}

}  // namespace
}  // namespace geomend::test
