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
    const TemporaryFolder folder;
    if (client("make " + folder.path().string()) != 0) GTEST_SKIP() << "python3 with VTK (package python3-vtk9) is not there";
    int files = 0;
    std::vector<std::filesystem::path> made;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        if (entry.path().extension() == ".vtk") made.push_back(entry.path());
    }
    for (const auto& path : made) {
        const auto input = Input::open(path.string());
        ASSERT_TRUE(input.ok());
        auto data = vtk::read_legacy(*input, {});
        ASSERT_TRUE(data.ok()) << data.why().error.message;
        EXPECT_TRUE(data->losses.empty());
        for (const char* version : {"4.2", "5.1"}) {
            const bool binary = files % 2 == 0;  // each file goes out in the other way than it came in, by and by
            write_file(folder / "ours.vtk", written(*data, {{"version", version}, {"encoding", binary ? "binary" : "text"}}));
            ASSERT_EQ(client("dump " + (folder / "ours.vtk").string() + ' ' + (folder / "ours.txt").string()), 0);
            std::string expected = read_file(std::filesystem::path(path).replace_extension(".txt"));
            EXPECT_EQ(read_file(folder / "ours.txt"), expected) << path.filename() << " as version " << version;
            ++files;
        }
        ++files;
    }
    EXPECT_EQ(made.size(), 28u);
}

TEST(LegacyClient, ReadsCoordinatesThatItsOwnTextWriterWouldCut) {
    const TemporaryFolder folder;
    PointSet set;
    set.points = {{400000.33333333331, 5.1e6 + 1.0 / 3, -0.1}};
    Dataset data;
    data.objects.push_back(set);
    write_file(folder / "ours.vtk", written(data));
    const int status = client("dump " + (folder / "ours.vtk").string() + ' ' + (folder / "ours.txt").string());
    if (status != 0) GTEST_SKIP() << "python3 with VTK (package python3-vtk9) is not there";
    char expected[200];
    std::snprintf(expected, sizeof expected, "p %a %a %a", set.points[0][0], set.points[0][1], set.points[0][2]);
    EXPECT_NE(read_file(folder / "ours.txt").find(expected), std::string::npos) << read_file(folder / "ours.txt");
}

}  // namespace
}  // namespace geomend::test
