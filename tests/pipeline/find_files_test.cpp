// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/find_files.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace geomend {
namespace {

using test::TemporaryFolder;
using test::write_file;

const char* const triangle = "GOCAD TSurf 1\nHEADER {\nname:t\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";

class FindFiles : public testing::Test {
protected:
    FindFiles() {
        for (const char* name : {"b.ts", "a.ts", "notes.md", "sub/c.ml", "sub/deep/d.ts.gz", "sub/no_ending", ".hidden.ts", ".git/e.ts"}) {
            std::filesystem::create_directories((folder / name).parent_path());
            write_file(folder / name, name == std::string("notes.md") ? "# Notes\n" : triangle);
        }
    }

    // Relative to the folder, one after the other.
    std::string found(const std::vector<std::string>& arguments) {
        last = find_files(arguments);
        std::string text;
        for (const FoundFile& f : last.files) text += (text.empty() ? "" : " ") + short_name(f.path);
        return text;
    }
    std::string short_name(const std::string& path) const {
        const std::string root = folder.path().string() + "/";
        return path.starts_with(root) ? path.substr(root.size()) : path;
    }
    std::string at(const char* name) const { return (folder / name).string(); }

    TemporaryFolder folder;
    FoundFiles last;
};

TEST_F(FindFiles, InAFolderByNameAndContentInOrder) {
    EXPECT_EQ(found({folder.path().string()}), "a.ts b.ts sub/c.ml sub/deep/d.ts.gz sub/no_ending");
    ASSERT_EQ(last.not_models.size(), 1u);
    EXPECT_EQ(short_name(last.not_models[0]), "notes.md");
    EXPECT_TRUE(last.folders_or_patterns);
    EXPECT_FALSE(last.files[0].named);
}

TEST_F(FindFiles, GivenByNameStandForThemselvesWhateverTheyAre) {
    EXPECT_EQ(found({at("notes.md"), at("none.ts"), "-"}), "notes.md none.ts -");
    EXPECT_FALSE(last.folders_or_patterns);
    EXPECT_TRUE(last.files[0].named);
}

TEST_F(FindFiles, ByPattern) {
    EXPECT_EQ(found({at("*.ts")}), "a.ts b.ts");
    EXPECT_EQ(found({at("**/*.ts*")}), "a.ts b.ts sub/deep/d.ts.gz");
    EXPECT_EQ(found({at("s?b/*")}), "sub/c.ml sub/deep/d.ts.gz sub/no_ending");
    EXPECT_EQ(found({at("[b-z].ts")}), "b.ts");
    EXPECT_EQ(found({at(".*.ts")}), ".hidden.ts");
    EXPECT_EQ(found({at("**")}), "a.ts b.ts notes.md sub/c.ml sub/deep/d.ts.gz sub/no_ending");
}

TEST_F(FindFiles, ComesOnceHoweverOftenItIsMeant) {
    EXPECT_EQ(found({at("b.ts"), at("*.ts"), at("./b.ts"), at("a.ts")}), "b.ts a.ts");
    EXPECT_TRUE(last.files[0].named);
    EXPECT_TRUE(last.nothing_there.empty());
    EXPECT_EQ(found({at("a.ts"), at("[a].ts")}), "a.ts");
    EXPECT_TRUE(last.nothing_there.empty());
}

TEST_F(FindFiles, SaysWhereThereIsNone) {
    std::filesystem::create_directories(folder / "empty");
    EXPECT_EQ(found({at("*.vtu"), at("empty")}), "");
    ASSERT_EQ(last.nothing_there.size(), 2u);
    EXPECT_EQ(last.nothing_there[0].error.code, "F017");
    EXPECT_EQ(last.nothing_there[0].error.where.file, at("*.vtu"));
}

TEST_F(FindFiles, TakesAFileOfThatVeryNameBeforeAPattern) {
    write_file(folder / "a[1].ts", triangle);
    EXPECT_EQ(found({at("a[1].ts")}), "a[1].ts");
    EXPECT_FALSE(last.folders_or_patterns);
}

TEST_F(FindFiles, DoesNotFollowLinksToFoldersRound) {
    std::filesystem::create_directory_symlink(folder.path(), folder / "sub/round");
    std::filesystem::create_symlink(folder / "a.ts", folder / "sub/also_a.ts");
    EXPECT_EQ(found({folder.path().string()}), "a.ts b.ts sub/c.ml sub/deep/d.ts.gz sub/no_ending");
    EXPECT_EQ(found({at("**/*.ts")}), "a.ts b.ts");
}

TEST_F(FindFiles, NamesEmptyFilesThatClaimToBeModels) {
    write_file(folder / "empty.vtu", "");
    write_file(folder / "empty", "");
    EXPECT_EQ(found({at("empty*")}), "empty empty.vtu");
    EXPECT_NE(found({folder.path().string()}).find("empty.vtu"), std::string::npos);
    EXPECT_EQ(last.not_models.size(), 2u);
}

}  // namespace
}  // namespace geomend
