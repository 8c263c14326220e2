// SPDX-License-Identifier: AGPL-3.0-or-later
// VTK's own library (the Python module of Debian's VTK 9.1) as the other side: what it writes we read, and what we
// write from that it reads with the same points, cells, arrays, types and active attributes.
#include <sys/wait.h>

#include <cstdlib>

#include "vtk/legacy_support.h"

namespace geomend::test {
namespace {

int client(const std::string& arguments) {
    const std::string command = "/usr/bin/python3 " GEOMEND_SOURCE_DIR "/tests/vtk/legacy_client.py " + arguments + " >/dev/null 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(LegacyClient, ReadsBackWhatWeMakeOfItsOwnFiles) {
    const TemporaryFolder theirs, ours;
    if (client("make " + theirs.path().string()) != 0) GTEST_SKIP() << "python3 with VTK (package python3-vtk9) is not there";
    std::vector<std::filesystem::path> made;
    for (const auto& entry : std::filesystem::directory_iterator(theirs.path())) made.push_back(entry.path());
    ASSERT_EQ(made.size(), 28u);
    int turn = 0;
    for (const auto& path : made) {
        const auto input = Input::open(path.string());
        ASSERT_TRUE(input.ok());
        auto data = vtk::read_legacy(*input, {});
        ASSERT_TRUE(data.ok()) << data.why().error.message;
        EXPECT_TRUE(data->losses.empty());
        for (const char* version : {"4.2", "5.1"}) {
            const std::string encoding = ++turn / 2 % 2 == 0 ? "binary" : "text";
            const std::string name = path.stem().string() + "_as_" + version[0] + ".vtk";
            write_file(ours / name, written(*data, {{"version", version}, {"encoding", encoding}}));
        }
    }
    ASSERT_EQ(client("dump " + theirs.path().string()), 0);
    ASSERT_EQ(client("dump " + ours.path().string()), 0);
    for (const auto& path : made) {
        const std::string expected = read_file(std::filesystem::path(path).replace_extension(".txt"));
        EXPECT_FALSE(expected.empty());
        for (const char* version : {"4", "5"}) EXPECT_EQ(read_file(ours / (path.stem().string() + "_as_" + version + ".txt")), expected);
    }
}

TEST(LegacyClient, ReadsCoordinatesThatItsOwnTextWriterWouldCut) {
    const TemporaryFolder folder;
    PointSet set;
    set.points = {{400000.33333333331, 5.1e6 + 1.0 / 3, -0.1}};
    Dataset data;
    data.objects.push_back(set);
    write_file(folder / "ours.vtk", written(data));
    if (client("dump " + folder.path().string()) != 0) GTEST_SKIP() << "python3 with VTK (package python3-vtk9) is not there";
    char expected[200];
    std::snprintf(expected, sizeof expected, "p %a %a %a", set.points[0][0], set.points[0][1], set.points[0][2]);
    EXPECT_NE(read_file(folder / "ours.txt").find(expected), std::string::npos) << read_file(folder / "ours.txt");
}

}  // namespace
}  // namespace geomend::test
