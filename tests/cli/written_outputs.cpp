// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/written_outputs.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <thread>
#include <utility>

#include "support/program.h"

namespace geomend::test {

namespace fs = std::filesystem;

fs::path sample(std::string_view name) { return fs::path(GEOMEND_SOURCE_DIR) / "samples" / name; }

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
        if (!trouble.misfortune.empty()) {
            ::setenv("LD_PRELOAD", GEOMEND_MISFORTUNE_LIBRARY, 1);
            ::setenv("GEOMEND_MISFORTUNE", trouble.misfortune.c_str(), 1);
        }
        if (!trouble.calls.empty()) ::setenv("GEOMEND_CALLS", trouble.calls.c_str(), 1);
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

Contents contents(const fs::path& folder) {
    Contents all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) all[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
    }
    return all;
}

std::size_t largest(const Contents& files) {
    std::size_t most = 0;
    for (const auto& [name, bytes] : files) most = std::max(most, bytes.size());
    return most;
}

bool has_temporary(const Contents& files) {
    for (const auto& [name, bytes] : files) {
        if (name.find(".geomend-") != std::string::npos) return true;
    }
    return false;
}

namespace {

std::optional<Written> try_to_write(std::string name, std::vector<std::string> arguments) {
    const TemporaryFolder folder;
    arguments.push_back((folder / name).string());
    const int status = run_in_trouble(arguments, {});
    arguments.pop_back();
    if (status != 0) return std::nullopt;
    return Written{std::move(name), std::move(arguments), contents(folder.path())};
}

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

// Each is the only output of its run.
std::vector<Written> all_others() {
    const std::string grid = sample("faulted_grid.grdecl"), model = sample("layered_box.ml");
    const std::vector<std::string> judged{"validate", grid, "--fail-on", "never", "--report"};
    const std::vector<std::string> planned{"repair", model, "--dry-run", "-o", "none.ml"};
    const auto with = [](std::vector<std::string> words, const char* last) {
        words.emplace_back(last);
        return words;
    };
    std::vector<std::pair<std::string, std::vector<std::string>>> runs;
    for (const char* name : {"out.json", "out.html", "out.sarif", "out.xml", "out.txt"}) runs.emplace_back(name, judged);
    for (const char* name : {"plan.json", "plan.html"}) runs.emplace_back(name, with(planned, "--report"));
    runs.emplace_back("recipe.toml", with(planned, "--write-recipe"));
    runs.emplace_back("sites.vtp", std::vector<std::string>{"info", model, "--complexity-sites"});
    runs.emplace_back("mended.ml", std::vector<std::string>{"repair", model, "-o"});
    runs.emplace_back("mended.grdecl", std::vector<std::string>{"repair", grid, "-o"});
    std::vector<Written> all;
    for (const auto& [name, arguments] : runs) {
        auto found = try_to_write(name, arguments);
        EXPECT_TRUE(found) << name;
        if (found) all.push_back(std::move(*found));
    }
    return all;
}

}  // namespace

const std::vector<Written>& all_outputs() {
    static const std::vector<Written> outputs = [] {
        std::vector<Written> all = all_models();
        std::ranges::move(all_others(), std::back_inserter(all));
        return all;
    }();
    return outputs;
}

Contents over_an_older_one(const Written& output, const Trouble& trouble, int& status) {
    const TemporaryFolder folder;
    write_file(folder / output.name, "old");
    auto arguments = output.arguments;
    arguments.push_back((folder / output.name).string());
    status = run_in_trouble(arguments, trouble);
    return contents(folder.path());
}

Contents untouched(const Written& output) { return {{output.name, "old"}}; }

}  // namespace geomend::test
