// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/sanitisers.h"
#include "support/program.h"

namespace geomend::test {
namespace {

const char* const triangle = "GOCAD TSurf 1\nHEADER {\nname:t\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";

std::string grid(int top, int bottom) {
    std::string text = "SPECGRID\n1 1 1 1 F /\nCOORD\n";
    for (const char* pillar : {"0 0", "1 0", "0 1", "1 1"}) text += std::string(pillar) + " 0 " + pillar + " 9\n";
    text += "/\nZCORN\n4*" + std::to_string(top) + " 4*" + std::to_string(bottom) + " /\nACTNUM\n1 /\n";
    return text;
}

nlohmann::json report_of(const ProgramRun& run) { return nlohmann::json::parse(run.out, nullptr, false); }

// The runs of this file say how long they take at most themselves.
ProgramRun validate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "validate");
    return run_geomend(arguments);
}

TEST(ValidateMany, JudgesThreeHundredFilesTheSameWithAnyNumberOfThreads) {
    const TemporaryFolder folder;
    for (int i = 0; i < 300; ++i) {
        const std::string text = i % 10 == 3 ? grid(5, 2) : i % 50 == 7 ? std::string("SPECGRID\n1 x /\n") : grid(1, 2);
        write_file(folder / ("grid" + std::to_string(1000 + i) + ".grdecl"), text);
    }
    const ProgramRun one = validate({folder.path().string(), "--json", "--threads", "1"});
    const ProgramRun four = validate({folder.path().string(), "--json", "--threads", "4"});
    EXPECT_EQ(one.status, 3) << one.err;
    EXPECT_EQ(one.out, four.out);
    const auto report = report_of(one);
    EXPECT_EQ(report["files"].size(), 300u);
    EXPECT_EQ(report["summary"]["valid"], 264);
    EXPECT_EQ(report["summary"]["not_valid"], 30);
    EXPECT_EQ(report["summary"]["unreadable"], 6);
    EXPECT_EQ(report["files"][3]["file"], (folder / "grid1003.grdecl").string());
    EXPECT_EQ(report["files"][3]["findings"][0]["code"], "C03");
    EXPECT_EQ(report["files"][7]["outcome"], "unreadable");
}

TEST(ValidateMany, GivesTheSameFindingsAsOneFileAlone) {
    const TemporaryFolder folder;
    write_file(folder / "bad.grdecl", grid(5, 2));
    const auto alone = report_of(validate({(folder / "bad.grdecl").string(), "--json"}));
    const auto many = report_of(validate({folder.path().string(), "--json"}));
    EXPECT_EQ(alone["files"], many["files"]);
    EXPECT_FALSE(alone.contains("summary"));
    EXPECT_EQ(many["summary"]["not_valid"], 1);
}

TEST(ValidateMany, PassesOptionsOn) {
    const TemporaryFolder folder;
    write_file(folder / "bad.grdecl", grid(5, 2));
    write_file(folder / "good.grdecl", grid(1, 2));
    const std::string all = folder.path().string();
    EXPECT_EQ(validate({all}).status, 1);
    EXPECT_EQ(validate({all, "--fail-on", "never"}).status, 0);
    EXPECT_EQ(validate({all, "--skip", "C03,C07", "--checks", "C03,C04"}).status, 0);
    EXPECT_EQ(report_of(validate({all, "--json", "--tolerance", "0.5"}))["files"][0]["tolerance"], 0.5);
    EXPECT_EQ(validate({all, "--tolerance", "10", "--option", "cells=all"}).status, 0);
    const ProgramRun wrong = validate({all, "--checks", "C99"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("C99"), std::string::npos);
    EXPECT_EQ(validate({all, "--option", "cells=some"}).status, 2);
    EXPECT_EQ(validate({all, "--from", "nonsense"}).status, 2);
}

TEST(ValidateMany, ATimeLimitEndsAFileThatHangsAndNoOther) {
    const TemporaryFolder folder;
    // Nobody ever writes into this pipe.
    ASSERT_EQ(::mkfifo((folder / "pipe.ts").c_str(), 0600), 0);
    write_file(folder / "good.grdecl", grid(1, 2));
    const ProgramRun run =
        validate({(folder / "pipe.ts").string(), (folder / "good.grdecl").string(), "--json", "--time-limit", "1", "--threads", "1"});
    EXPECT_EQ(run.status, 5) << run.err;
    const auto report = report_of(run);
    EXPECT_EQ(report["files"][0]["outcome"], "limit");
    EXPECT_EQ(report["files"][0]["findings"][0]["code"], "F023");
    EXPECT_EQ(report["files"][1]["valid"], true);
    EXPECT_EQ(report["summary"]["limit"], 1);
    // A limit that is asked for holds for one file, too.
    EXPECT_EQ(validate({(folder / "pipe.ts").string(), "--time-limit", "0.2"}).status, 5);
}

TEST(ValidateMany, AMemoryLimitEndsAFileThatNeedsMoreAndNoOther) {
    if (with_address_sanitiser) GTEST_SKIP() << "the address sanitiser reserves terabytes";
    const TemporaryFolder folder;
    std::string large = "SPECGRID\n100 100 100 1 F /\nCOORD\n61206*1 /\nZCORN\n8000000*5 /\n";
    write_file(folder / "large.grdecl", large);
    write_file(folder / "small.grdecl", grid(1, 2));
    const ProgramRun run = validate({folder.path().string(), "--json", "--memory-limit", "60", "--threads", "1"});
    EXPECT_EQ(run.status, 5) << run.err;
    const auto report = report_of(run);
    EXPECT_EQ(report["files"][0]["outcome"], "limit") << run.out;
    EXPECT_EQ(report["files"][1]["valid"], true) << run.out;
}

TEST(ValidateMany, FilesThatAnotherOneReadsAreNotJudgedApart) {
    const TemporaryFolder folder;
    const std::string whole = grid(1, 2);
    const std::size_t cut = whole.find("ZCORN");
    write_file(folder / "a_depths.grdecl", whole.substr(cut));
    write_file(folder / "model.grdecl", whole.substr(0, cut) + "INCLUDE\n'a_depths.grdecl' /\nINCLUDE\n'values' /\n");
    write_file(folder / "values", "PORO\n0.2 /\n");
    const ProgramRun run = validate({folder.path().string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    const auto report = report_of(run);
    ASSERT_EQ(report["files"].size(), 1u) << run.out;
    EXPECT_EQ(report["files"][0]["companions"].size(), 2u);
    EXPECT_EQ(report["summary"]["companions"][0]["file"], (folder / "a_depths.grdecl").string());
    EXPECT_EQ(report["summary"]["companions"][0]["read_with"], (folder / "model.grdecl").string());
    // Asked for by name it is judged for itself, and that fails.
    EXPECT_EQ(validate({(folder / "a_depths.grdecl").string(), (folder / "model.grdecl").string()}).status, 3);
    // Where the whole cannot be read, its part is told, too.
    write_file(folder / "model.grdecl", whole.substr(0, cut) + "INCLUDE\n'a_depths.grdecl' /\nINCLUDE\n'gone' /\n");
    const auto broken = report_of(validate({folder.path().string(), "--json"}));
    EXPECT_EQ(broken["summary"]["unreadable"], broken["files"].size()) << broken.dump(1);
}

TEST(ValidateMany, PatternsAndFoldersThatStandForNothingAreNotPassedOver) {
    const TemporaryFolder folder;
    write_file(folder / "good.grdecl", grid(1, 2));
    const ProgramRun run = validate({(folder / "*.vtu").string(), (folder / "*.grdecl").string()});
    EXPECT_EQ(run.status, 3);
    EXPECT_NE(run.err.find("no file matches"), std::string::npos) << run.err;
    EXPECT_NE(run.out.find("2 files: 1 valid, 0 not valid, 1 not readable"), std::string::npos) << run.out;
    std::filesystem::create_directories(folder / "empty");
    EXPECT_EQ(validate({(folder / "empty").string()}).status, 3);
}

TEST(ValidateMany, TakesStandardInputAmongFiles) {
    const TemporaryFolder folder;
    write_file(folder / "good.grdecl", grid(1, 2));
    write_file(folder / "bad.grdecl", grid(5, 2));
    const ProgramRun run = run_geomend({"validate", "-", (folder / "good.grdecl").string(), "--json"}, folder / "bad.grdecl");
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_EQ(report_of(run)["files"][0]["valid"], false);
    EXPECT_EQ(report_of(run)["files"][1]["valid"], true);
}

TEST(ValidateMany, NamesThatLookLikeOptionsAreFiles) {
    const TemporaryFolder folder;
    write_file(folder / "--json.grdecl", grid(1, 2));
    const ProgramRun run = validate({folder.path().string() + "/*", "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(ValidateMany, PagesBaselinesAndDebrisAreThoseOfOneFile) {
    const TemporaryFolder folder;
    write_file(folder / "bad.grdecl", grid(5, 2));
    write_file(folder / "good.grdecl", grid(1, 2));
    const std::string all = folder.path().string(), bad = (folder / "bad.grdecl").string();
    const std::string one_page = (folder / "one.html").string(), page = (folder / "all.html").string();
    EXPECT_EQ(validate({bad, "--quiet", "--report", one_page}).status, 1);
    EXPECT_EQ(validate({all, "--quiet", "--report", page}).status, 1);
    // The model of the one file is drawn in the page of both, with the same marks.
    const std::string text = read_file(one_page);
    const std::string marks = "\"mark\":";
    ASSERT_NE(text.find(marks), std::string::npos);
    const std::string drawn = text.substr(text.find(marks), 200);
    EXPECT_NE(read_file(page).find(drawn), std::string::npos);

    const std::string old = (folder / "old.json").string();
    EXPECT_EQ(validate({bad, "--quiet", "--report", old}).status, 1);
    const auto known = report_of(validate({bad, (folder / "good.grdecl").string(), "--baseline", old, "--json"}));
    EXPECT_TRUE(known["files"][0]["findings"].empty()) << known.dump(1);
    EXPECT_EQ(known["files"][0]["known"]["error"], 1);

    const auto with = report_of(validate({bad, (folder / "good.grdecl").string(), "--debris", (folder / "debris").string(), "--json"}));
    std::size_t written = 0;
    for (const auto& f : with["files"][0]["findings"]) {
        for (const auto& path : f.value("debris", nlohmann::json::array())) {
            EXPECT_TRUE(std::filesystem::exists(path.get<std::string>()));
            ++written;
        }
    }
    EXPECT_GT(written, 0u);
}

struct Process {
    int number = 0, parent = 0;
    std::string command;
};

std::vector<Process> all_processes() {
    std::vector<Process> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const std::string status = read_file(entry.path() / "status");
        const std::size_t at = status.find("\nPPid:");
        if (at == std::string::npos || status.find("\nState:\tZ") != std::string::npos) continue;
        all.push_back({std::stoi(name), std::stoi(status.substr(at + 6)), read_file(entry.path() / "cmdline")});
    }
    return all;
}

// The processes that were started to validate a file, and their workers.
std::vector<Process> run_over(const std::string& file) {
    std::vector<Process> found;
    const auto all = all_processes();
    for (const Process& p : all) {
        if (p.command.find(file) == std::string::npos) continue;
        found.push_back(p);
        std::ranges::copy_if(all, std::back_inserter(found), [&](const Process& worker) { return worker.parent == p.number; });
    }
    return found;
}

// Workers of a process, also of one that is gone.
std::size_t workers_of(pid_t parent) {
    const std::string word = std::string("--worker") + '\0' + std::to_string(parent) + '\0';
    return static_cast<std::size_t>(
        std::ranges::count_if(all_processes(), [&](const Process& p) { return p.command.find(word) != std::string::npos; }));
}

TEST(ValidateMany, StopsAllItsWorkersOnASignal) {
    for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
        const TemporaryFolder folder;
        for (const char* name : {"a.ts", "b.ts", "c.ts"}) ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
        const std::string root = folder.path().string();
        const std::string a = root + "/a.ts", b = root + "/b.ts", c = root + "/c.ts";
        const pid_t child = ::fork();
        if (child == 0) {
            const int nothing = ::open("/dev/null", O_RDWR);
            for (int fd = 0; fd < 3; ++fd) ::dup2(nothing, fd);
            ::execl(GEOMEND_PROGRAM, "geomend", "validate", a.c_str(), b.c_str(), c.c_str(), "--threads", "2", nullptr);
            ::_exit(127);
        }
        const auto wait_for = [&](std::size_t count) {
            for (int i = 0; i < 500 && workers_of(child) != count; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
            return workers_of(child);
        };
        EXPECT_EQ(wait_for(2), 2u);
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        if (signal == SIGKILL) EXPECT_EQ(WTERMSIG(status), SIGKILL);
        else EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130);
        EXPECT_EQ(wait_for(0), 0u) << signal;
    }
}

TEST(ValidateMany, AWorkerThatCrashesIsAFindingOfItsFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe.ts").c_str(), 0600), 0);
    write_file(folder / "good.grdecl", grid(1, 2));
    const std::string pipe = (folder / "pipe.ts").string();
    // Nothing in the product crashes on purpose: the worker that waits for the pipe is shot from outside.
    const std::jthread shot([&] {
        for (int i = 0; i < 500; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            for (const Process& p : run_over(pipe)) {
                if (p.command.find("--worker") == std::string::npos) continue;
                ::kill(p.number, SIGSEGV);
                return;
            }
        }
    });
    const ProgramRun run = validate({pipe, (folder / "good.grdecl").string(), "--json", "--threads", "1", "--time-limit", "60"});
    EXPECT_EQ(run.status, 70) << run.err;
    const auto report = report_of(run);
    EXPECT_EQ(report["files"][0]["outcome"], "crashed");
    EXPECT_EQ(report["files"][0]["findings"][0]["code"], "F025");
    EXPECT_EQ(report["files"][1]["valid"], true);
}

}  // namespace
}  // namespace geomend::test
