// SPDX-License-Identifier: AGPL-3.0-or-later
// Decks that take geometry or arrays from files of other kinds.
#include <gtest/gtest.h>

#include "pipeline/load.h"
#include "support/program.h"

namespace geomend {
namespace {

const char* const text_grid =
    "SPECGRID\n 2 1 2 1 F /\nMAPAXES\n 0 100 0 0 100 0 /\nGRIDUNIT\n METRES /\nCOORD\n"
    " 0 0 0 0 0 10 100 0 0 100 0 10 200 0 0 200 0 10\n 0 100 0 0 100 10 100 100 0 100 100 10 200 100 0 200 100 10 /\n"
    "ZCORN\n 8*1 16*2 8*3 /\nACTNUM\n 1 0 1 1 /\n";

class DeckCompanions : public ::testing::Test {
protected:
    void SetUp() override {
        test::write_file(folder_ / "grid.grdecl", text_grid);
        std::filesystem::create_directory(folder_ / "sub");
    }
    void make(const std::string& name) {
        ASSERT_EQ(test::run_geomend({"convert", (folder_ / "grid.grdecl").string(), "-o", (folder_ / name).string(), "--lossy"}).status, 0);
    }
    Result<Dataset> read(const std::string& grid_section, const FormatOptions& options = {}) {
        test::write_file(folder_ / "CASE.DATA",
                         "RUNSPEC\nDIMENS\n 2 1 2 /\nMETRIC\nGRID\n" + grid_section + "PORO\n 0.1 0.2 0.3 0.4 /\nEND\n");
        return load((folder_ / "CASE.DATA").string(), {"", options, nullptr});
    }
    void expect_whole(const Result<Dataset>& d, bool own_activity) {
        ASSERT_TRUE(d.ok()) << (d.ok() ? "" : d.why().error.message);
        const auto& grid = std::get<CornerPointGrid>(d->objects.front());
        ASSERT_EQ(grid.depths.size(), 32u);
        EXPECT_EQ(grid.depths[8], 2);
        EXPECT_EQ(grid.pillars[6], 100);
        EXPECT_EQ(grid.activity, (own_activity ? std::vector<std::uint8_t>{1, 1, 1, 0} : std::vector<std::uint8_t>{1, 0, 1, 1}));
        EXPECT_TRUE(grid.map_axes.has_value());
        EXPECT_EQ(grid.info.name, "CASE");
        EXPECT_NE(find_attribute(grid.info.attributes, "PORO", AttributeLocation::cell), nullptr);
        for (const Loss& loss : d->losses) EXPECT_NE(loss.loss_class, LossClass::substance) << loss.what;
    }
    test::TemporaryFolder folder_;
};

TEST_F(DeckCompanions, gdfile_gives_the_geometry) {
    make("sub/X.EGRID");
    expect_whole(read("GDFILE\n 'sub/X.EGRID' /\n"), false);
    expect_whole(read("GDFILE\n sub\\X.EGRID /\n"), false);
    expect_whole(read("GDFILE\n 'sub/X.EGRID' /\nACTNUM\n 1 1 1 0 /\n"), true);
}

TEST_F(DeckCompanions, import_gives_geometry_and_arrays) {
    make("X.bgrdecl");
    expect_whole(read("IMPORT\n 'X.bgrdecl' /\n"), false);
}

TEST_F(DeckCompanions, that_are_missing_are_named_with_the_paths_tried) {
    const auto d = read("GDFILE\n 'sub/X.EGRID' /\n");
    ASSERT_FALSE(d.ok());
    EXPECT_EQ(d.why().error.code, "F010");
    EXPECT_NE(d.why().error.message.find((folder_ / "sub/X.EGRID").string()), std::string::npos) << d.why().error.message;
    EXPECT_FALSE(read("IMPORT\n 'X.bgrdecl' /\n").ok());
    const auto skipped = read("GDFILE\n 'sub/X.EGRID' /\n", {{"includes", "skip"}});
    ASSERT_TRUE(skipped.ok());
    EXPECT_TRUE(std::ranges::any_of(skipped->losses, [](const Loss& l) { return l.loss_class == LossClass::substance; }));
}

TEST_F(DeckCompanions, of_another_size_are_refused) {
    make("X.EGRID");
    test::write_file(folder_ / "CASE.DATA", "RUNSPEC\nDIMENS\n 1 1 2 /\nGRID\nGDFILE\n 'X.EGRID' /\nPORO\n 0.1 0.2 /\nEND\n");
    const auto d = load((folder_ / "CASE.DATA").string(), {});
    ASSERT_FALSE(d.ok());
    EXPECT_EQ(d.why().error.code, "F008");
}

TEST_F(DeckCompanions, a_missing_file_of_further_properties_is_told) {
    test::write_file(folder_ / "g.grdecl", std::string(text_grid) + "FACIES\n 1 2 3 4 /\n");
    ASSERT_EQ(test::run_geomend({"convert", (folder_ / "g.grdecl").string(), "-o", (folder_ / "out.grdecl").string()}).status, 0);
    ASSERT_TRUE(std::filesystem::remove(folder_ / "out.properties.grdecl"));
    const auto d = load((folder_ / "out.grdecl").string(), {});
    ASSERT_TRUE(d.ok());
    EXPECT_TRUE(std::ranges::any_of(d->findings, [](const Finding& f) { return f.code == "F143"; }));
}

}  // namespace
}  // namespace geomend
