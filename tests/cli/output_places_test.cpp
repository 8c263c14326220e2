// SPDX-License-Identifier: AGPL-3.0-or-later
// Every output of the program goes through one door: links are followed, devices and pipes are written into.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <thread>

#include "support/program.h"

namespace geomend::test {
namespace {

namespace fs = std::filesystem;

// A dangling triangle: two findings at least, so that there is debris.
const char* const crossing =
    "GOCAD TSurf 1\nHEADER {\nname:t\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nTFACE\n"
    "VRTX 4 0.2 0.2 -1\nVRTX 5 0.2 0.2 1\nVRTX 6 0.3 0.2 1\nTRGL 4 5 6\nEND\n";

// Takes everything (3) or is always full (7); a node of our own, never one under /dev.
bool make_device(const fs::path& path, unsigned minor) {
    if (::mknod(path.c_str(), S_IFCHR | 0666, makedev(1, minor)) != 0) return false;
    const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd >= 0) ::close(fd);
    return fd >= 0;
}

class OutputDoor : public ::testing::Test {
protected:
    OutputDoor() { write_file(folder / "in.ts", crossing); }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    bool is_device(const std::string& name) const { return fs::status(folder / name).type() == fs::file_type::character; }
    const TemporaryFolder folder;
};

TEST_F(OutputDoor, ModelsAndReportsGoIntoDevicesThatStay) {
    for (const char* name : {"null.ts", "null.json", "null.html", "null.sarif", "null.xml", "null.txt"}) {
        if (!make_device(folder / name, 3)) GTEST_SKIP() << "device nodes cannot be made here";
    }
    EXPECT_EQ(run_geomend({"convert", path("in.ts"), "-o", path("null.ts")}).status, 0);
    EXPECT_EQ(run_geomend({"validate", path("in.ts"), "--fail-on", "never", "--report", path("null.json"), "--report", path("null.html"),
                           "--report", path("null.sarif"), "--report", path("null.xml"), "--report", path("null.txt")})
                  .status,
              0);
    for (const char* name : {"null.ts", "null.json", "null.html", "null.sarif", "null.xml", "null.txt"})
        EXPECT_TRUE(is_device(name)) << name;
}

TEST_F(OutputDoor, ADeviceThatIsFullGivesFourAndNamesIt) {
    for (const char* name : {"full.ts", "full.json"}) {
        if (!make_device(folder / name, 7)) GTEST_SKIP() << "device nodes cannot be made here";
    }
    const ProgramRun model = run_geomend({"convert", path("in.ts"), "-o", path("full.ts")});
    EXPECT_EQ(model.status, 4);
    EXPECT_NE(model.err.find("full.ts: cannot write: No space left on device [F020]"), std::string::npos) << model.err;
    EXPECT_EQ(run_geomend({"validate", path("in.ts"), "--fail-on", "never", "--report", path("full.json")}).status, 4);
    EXPECT_TRUE(is_device("full.ts"));
    EXPECT_TRUE(is_device("full.json"));
}

TEST_F(OutputDoor, APipeHasWhatAFileHas) {
    ASSERT_EQ(run_geomend({"convert", path("in.ts"), "-o", path("file.ts")}).status, 0);
    ASSERT_EQ(::mkfifo(path("pipe.ts").c_str(), 0600), 0);
    std::string seen;
    std::jthread reader([&] { seen = read_file(folder / "pipe.ts"); });
    EXPECT_EQ(run_geomend({"convert", path("in.ts"), "-o", path("pipe.ts")}).status, 0);
    reader.join();
    EXPECT_EQ(seen, read_file(folder / "file.ts"));
    EXPECT_EQ(fs::status(folder / "pipe.ts").type(), fs::file_type::fifo);
}

TEST_F(OutputDoor, DebrisAndReportsFollowLinks) {
    fs::create_directory(folder / "disk");
    fs::create_directory_symlink("disk", folder / "debris");
    fs::create_symlink("disk/report.json", folder / "report.json");
    EXPECT_EQ(
        run_geomend({"validate", path("in.ts"), "--fail-on", "never", "--debris", path("debris"), "--report", path("report.json")}).status,
        0);
    EXPECT_TRUE(fs::is_symlink(folder / "debris"));
    EXPECT_TRUE(fs::is_symlink(folder / "report.json"));
    EXPECT_TRUE(fs::is_regular_file(folder / "disk/report.json"));
    EXPECT_GT(std::distance(fs::directory_iterator(folder / "disk"), fs::directory_iterator()), 1) << "the report and some debris";
}

TEST_F(OutputDoor, AFormatOfSeveralFilesDoesNotGoIntoAStream) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    for (const char* format : {"vtm", "pvd"}) {
        const ProgramRun run = run_geomend({"convert", path("in.ts"), "-o", path("pipe"), "--to", format});
        EXPECT_EQ(run.status, 4) << format << run.err;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2) << "the input and the pipe";
}

// A picture or a deck over the model that is read would be the end of it.
TEST(OutputPlaces, AGridWritesNothingOverWhatItReadsOrWrites) {
    const TemporaryFolder folder;
    const auto at = [&](const std::string& name) { return (folder / name).string(); };
    const std::string samples = std::string(GEOMEND_SOURCE_DIR) + "/samples/";
    fs::copy_file(samples + "layered_box.ml", at("box.ml"));
    fs::copy_file(samples + "layered_box.so", at("box.DATA"));
    const std::string model = read_file(at("box.ml"));
    const std::vector<std::vector<std::string>> refused{
        {"-o", at("a.grdecl"), "--map", at("box.ml")},
        {"-o", at("a.grdecl"), "--section", at("box.ml")},
        {"-o", at("box.grdecl"), "--properties-of", at("box.DATA"), "--option", "deck=yes"},
        {"-o", at("a.grdecl"), "--map", at("a.grdecl")},
        {"-o", at("a.grdecl"), "--report", at("a.properties.grdecl")},
        {"-o", at("a.egrid"), "--map", at("a.include.grdecl")},
        {"-o", at("a.grdecl"), "--map", at("p.png"), "--section", (folder / "." / "p.png").string()},
    };
    for (std::vector<std::string> words : refused) {
        words.insert(words.begin(), {"grid", at("box.ml"), "--cells", "4x4"});
        const ProgramRun run = run_geomend(words);
        EXPECT_EQ(run.status, 2) << words[5] << run.err;
        EXPECT_NE(run.err.find("is named twice"), std::string::npos) << run.err;
    }
    const ProgramRun nowhere = run_geomend({"grid", at("box.ml"), "--cells", "4x4", "-o", at("a.grdecl"), "--map", at("none/p.png")});
    EXPECT_EQ(nowhere.status, 4) << nowhere.err;
    EXPECT_EQ(read_file(at("box.ml")), model);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2) << "nothing but the inputs";
}

}  // namespace
}  // namespace geomend::test
