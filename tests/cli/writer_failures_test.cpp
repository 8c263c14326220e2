// SPDX-License-Identifier: AGPL-3.0-or-later
// Every format that is written, every kind of report and debris: what happens when the disk is full, memory runs out or somebody
// stops the program. The older output stays, nothing is left behind, the exit status says why. The formats are those of the table,
// so that a new one is tested with the others.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "support/program.h"

namespace geomend::test {
namespace {

namespace fs = std::filesystem;

/// What goes wrong in a run.
struct Trouble {
    rlim_t file_bytes = RLIM_INFINITY, memory_bytes = RLIM_INFINITY;
    int signal = 0;
    std::chrono::microseconds after{0};
};

int run_in_trouble(const std::vector<std::string>& arguments, const Trouble& trouble) {
    const pid_t child = ::fork();
    if (child == 0) {
        const int nothing = ::open("/dev/null", O_RDWR);
        for (int fd = 0; fd < 3; ++fd) ::dup2(nothing, fd);
        if (trouble.file_bytes != RLIM_INFINITY) {
            const rlimit limit{trouble.file_bytes, trouble.file_bytes};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        if (trouble.memory_bytes != RLIM_INFINITY) {
            const rlimit limit{trouble.memory_bytes, trouble.memory_bytes};
            ::setrlimit(RLIMIT_AS, &limit);
        }
        std::vector<std::string> all{GEOMEND_PROGRAM};
        all.insert(all.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& a : all) argv.push_back(a.data());
        argv.push_back(nullptr);
        ::alarm(120);
        ::execve(argv[0], argv.data(), environ);
        ::_exit(127);
    }
    if (trouble.signal != 0) {
        std::this_thread::sleep_for(trouble.after);
        ::kill(child, trouble.signal);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Path to bytes of all files of a folder.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) all[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
    }
    return all;
}

std::size_t largest(const std::map<std::string, std::string>& files) {
    std::size_t most = 0;
    for (const auto& [name, bytes] : files) most = std::max(most, bytes.size());
    return most;
}

bool has_temporary(const std::map<std::string, std::string>& files) {
    for (const auto& [name, bytes] : files) {
        if (name.find(".geomend-") != std::string::npos) return true;
    }
    return false;
}

/// One thing that the program writes: `good` is what stands in the folder after a run without trouble.
struct Written {
    std::string name;                    ///< of the output in its folder
    std::vector<std::string> arguments;  ///< the output's path comes last
    std::map<std::string, std::string> good;
};

std::optional<Written> try_to_write(std::string name, std::vector<std::string> arguments) {
    const TemporaryFolder folder;
    arguments.push_back((folder / name).string());
    const int status = run_in_trouble(arguments, {});
    arguments.pop_back();
    if (status != 0) return std::nullopt;
    return Written{std::move(name), std::move(arguments), contents(folder.path())};
}

fs::path sample(const char* name) { return fs::path(GEOMEND_SOURCE_DIR) / "samples" / name; }

/// What no sample holds: lines, and lattices of two kinds.
std::vector<std::string> further_inputs(const fs::path& folder) {
    const std::string head = "# vtk DataFile Version 3.0\nlattice\nASCII\nDATASET ";
    std::string points;
    for (int i = 0; i < 8; ++i) points += std::to_string(i % 2) + ' ' + std::to_string(i / 2 % 2) + ' ' + std::to_string(i / 4) + '\n';
    write_file(folder / "bent.vtk", head + "STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 8 double\n" + points);
    const std::string axis = "_COORDINATES 3 double\n0 1 3\n";
    write_file(folder / "straight.vtk", head + "RECTILINEAR_GRID\nDIMENSIONS 3 3 3\nX" + axis + "Y" + axis + "Z" + axis);
    write_file(folder / "lines.pl",
               "GOCAD PLine 1\nHEADER {\nname:lines\n}\nILINE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 2 1 0\nSEG 1 2\nSEG 2 3\nEND\n");
    return {(folder / "bent.vtk").string(), (folder / "straight.vtk").string(), (folder / "lines.pl").string()};
}

/// Every format of the table that can be written, each from the first input that it can hold.
std::vector<Written> all_models() {
    static const TemporaryFolder folder;
    static const std::vector<std::string> further = further_inputs(folder.path());
    std::vector<std::string> inputs = further;
    for (const char* name : {"layered_box.ml", "faulted_grid.grdecl", "h1_grid.zmap", "h1_picks.vs", "wells.wl", "layered_box.so"})
        inputs.push_back(sample(name).string());
    std::vector<Written> all;
    for (const auto& row : nlohmann::json::parse(run_geomend({"formats", "--json"}).out)) {
        if (!row["write"]) continue;
        const std::string format = row["name"], name = "out" + row["extensions"][0].get<std::string>();
        std::optional<Written> found;
        for (auto from = inputs.rbegin(); from != inputs.rend() && !found; ++from)
            found = try_to_write(name, {"convert", *from, "--lossy", "--to", format, "-o"});
        EXPECT_TRUE(found) << "no sample goes into " << format;
        if (found) all.push_back(std::move(*found));
    }
    return all;
}

std::vector<Written> all_reports() {
    std::vector<Written> all;
    for (const char* name : {"out.json", "out.html", "out.sarif", "out.xml", "out.txt"}) {
        auto found = try_to_write(name, {"validate", sample("faulted_grid.grdecl").string(), "--fail-on", "never", "--report"});
        EXPECT_TRUE(found) << name;
        if (found) all.push_back(std::move(*found));
    }
    auto sites = try_to_write("sites.vtp", {"info", sample("layered_box.ml").string(), "--complexity-sites"});
    EXPECT_TRUE(sites);
    if (sites) all.push_back(std::move(*sites));
    return all;
}

std::vector<Written> all_outputs() {
    std::vector<Written> all = all_models();
    std::ranges::move(all_reports(), std::back_inserter(all));
    return all;
}

/// Runs in a folder where an older output stands, and gives what is there then.
std::map<std::string, std::string> over_an_older_one(const Written& output, const Trouble& trouble, int& status) {
    const TemporaryFolder folder;
    write_file(folder / output.name, "old");
    auto arguments = output.arguments;
    arguments.push_back((folder / output.name).string());
    status = run_in_trouble(arguments, trouble);
    return contents(folder.path());
}

const std::map<std::string, std::string> untouched(const Written& output) { return {{output.name, "old"}}; }

TEST(WriterFailures, AFullDiskLeavesTheOlderOutputAndNothingElse) {
    for (const Written& output : all_outputs()) {
        for (const std::size_t room : {std::size_t{0}, largest(output.good) / 2, largest(output.good) - 1}) {
            int status = 0;
            const auto left = over_an_older_one(output, {.file_bytes = room}, status);
            EXPECT_EQ(status, 4) << output.name << " with room for " << room;
            EXPECT_EQ(left, untouched(output)) << output.name << " with room for " << room;
        }
    }
}

TEST(WriterFailures, AFullDiskLeavesNoDebris) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"validate", sample("faulted_grid.grdecl").string(), "--fail-on", "never", "--debris"};
    arguments.push_back((folder / "good").string());
    ASSERT_EQ(run_in_trouble(arguments, {}), 0);
    const auto good = contents(folder / "good");
    ASSERT_FALSE(good.empty());
    arguments.back() = (folder / "full").string();
    EXPECT_EQ(run_in_trouble(arguments, {.file_bytes = largest(good) - 1}), 4);
    EXPECT_TRUE(contents(folder / "full").empty());
}

// The memory at which a run fails is not known before: from too little to enough, each run is whole or leaves all as it was.
TEST(WriterFailures, ExhaustedMemoryLeavesTheOlderOutputAndNothingElse) {
    if (run_in_trouble({"--version"}, {.memory_bytes = rlim_t{1} << 32}) != 0) GTEST_SKIP() << "memory cannot be limited here";
    for (const Written& output : all_outputs()) {
        auto arguments = output.arguments;
        arguments.insert(arguments.begin() + 1, {"--threads", "1"});
        const Written single{output.name, arguments, output.good};
        for (rlim_t megabytes = 80; megabytes <= 640; megabytes *= 2) {
            int status = 0;
            const auto left = over_an_older_one(single, {.memory_bytes = megabytes << 20}, status);
            if (status == 0) {
                EXPECT_EQ(left.size(), output.good.size()) << output.name << " with " << megabytes << " MB";
            } else {
                EXPECT_EQ(left, untouched(output)) << output.name << " with " << megabytes << " MB, status " << status;
            }
        }
    }
}

TEST(WriterFailures, AStopLeavesTheOlderOutputOrAllOfTheNewOne) {
    for (const Written& output : all_outputs()) {
        for (const int signal : {SIGTERM, SIGINT}) {
            for (const int milliseconds : {20, 30, 40, 60}) {
                int status = 0;
                const auto left = over_an_older_one(output, {.signal = signal, .after = std::chrono::milliseconds(milliseconds)}, status);
                const std::string what =
                    output.name + " stopped after " + std::to_string(milliseconds) + " ms, status " + std::to_string(status);
                EXPECT_TRUE(status == 0 || status == 130 || status == 128 + signal) << what;
                EXPECT_FALSE(has_temporary(left)) << what;
                if (status == 0) {
                    EXPECT_EQ(left.size(), output.good.size()) << what;
                } else {
                    EXPECT_EQ(left, untouched(output)) << what;
                }
            }
        }
    }
}

TEST(WriterFailures, AKillLeavesTheOlderOutputOrTheNewOne) {
    for (const Written& output : all_outputs()) {
        for (const int milliseconds : {15, 25, 35, 50}) {
            int status = 0;
            const auto left = over_an_older_one(output, {.signal = SIGKILL, .after = std::chrono::milliseconds(milliseconds)}, status);
            ASSERT_TRUE(left.contains(output.name)) << output.name;
            const std::string& main = left.at(output.name);
            EXPECT_TRUE(main == "old" || main.size() == output.good.at(output.name).size()) << output.name;
        }
    }
}

}  // namespace
}  // namespace geomend::test
