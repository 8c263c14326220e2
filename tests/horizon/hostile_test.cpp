// SPDX-License-Identifier: AGPL-3.0-or-later
#include <atomic>
#include <map>

#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

/// A sound file of each format, from its own writer.
std::map<std::string, std::string> samples() {
    const Dataset grid = grid_dataset({4, 3}, {1000, 2000, 0}, {{{25, 0, 0}, {0, 50, 0}}}, {1, 2, 3, 4, 5, 1e30, 7, 8, 9, 10.5, 11, 12});
    Dataset points = good("petrel-points",
                          "# Petrel Points with attributes\nVERSION 1\nBEGIN HEADER\nX\nY\nZ\nFLOAT,a\nSTRING,b\nEND HEADER\n1 2 3 4 \"x "
                          "y\"\n5 6 7 -999 \"\"\n");
    Dataset lines = good("irap-polygons", "0 0 0\n1 0 0\n1 1 0\n0 0 0\n999 999 999\n5 5 5\n6 6 6\n");
    std::map<std::string, std::string> all;
    for (const char* name : {"irap-grid", "irap-grid-binary", "zmap", "cps3"}) all[name] = well_written(name, grid).bytes;
    all["irap-points"] = well_written("irap-points", points, {{"attributes", "rms"}}).bytes;
    all["petrel-points"] = well_written("petrel-points", points).bytes;
    for (const char* name : {"irap-polygons", "cps3-lines"}) all[name] = well_written(name, lines).bytes;
    return all;
}

/// Reading must end with a dataset or with a failure that says something.
void expect_answer(const std::string& name, const std::string& content) {
    const auto d = read(name, content);
    if (!d) {
        EXPECT_FALSE(d.why().error.code.empty());
        EXPECT_FALSE(d.why().error.message.empty());
        EXPECT_FALSE(d.why().error.where.file.empty());
    }
}

TEST(HostileInput, EveryCutIsAFailureOrAShorterWhole) {
    for (const auto& [name, whole] : samples()) {
        for (std::size_t size = 1; size < whole.size(); ++size) expect_answer(name, whole.substr(0, size));
    }
}

TEST(HostileInput, CutGridsAreNeverReadSilently) {
    for (const char* name : {"irap-grid", "irap-grid-binary", "zmap", "cps3"}) {
        const std::string whole = samples()[name];
        for (const int percent : {10, 50, 90})
            EXPECT_FALSE(read(name, whole.substr(0, whole.size() * static_cast<std::size_t>(percent) / 100))) << name << percent;
    }
}

TEST(HostileInput, CutRowsOfPointsAreToldOrMarked) {
    for (const char* name : {"irap-points", "petrel-points", "irap-polygons", "cps3-lines"}) {
        const std::string whole = samples()[name];
        for (std::size_t size = whole.size() / 2; size < whole.size(); ++size) {
            const auto d = read(name, whole.substr(0, size));
            if (d && whole[size - 1] != '\n') {
                EXPECT_TRUE(has_finding(*d, "F101")) << name << size;
            }
        }
    }
}

TEST(HostileInput, ChangedBytesGiveAnAnswer) {
    std::uint64_t state = 7;
    const auto random = [&state](std::size_t below) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::size_t>(state >> 33) % below;
    };
    for (const auto& [name, whole] : samples()) {
        for (int i = 0; i < 2000; ++i) {
            std::string changed = whole;
            for (std::size_t n = 1 + random(4); n > 0; --n) changed[random(changed.size())] = static_cast<char>(random(256));
            expect_answer(name, changed);
        }
    }
}

TEST(HostileInput, HugeNumbersTakeNoMemory) {
    for (const auto& [name, whole] : samples()) {
        for (std::size_t at = 0; at < whole.size(); ++at) {
            if (whole[at] < '0' || whole[at] > '9' || (at > 0 && whole[at - 1] != ' ' && whole[at - 1] != '\n' && whole[at - 1] != ','))
                continue;
            std::string changed = whole;
            changed.replace(at, 1, "1000000000000000000");
            expect_answer(name, changed);
            changed = whole;
            changed.replace(at, 1, "2147483647");
            expect_answer(name, changed);
        }
    }
}

TEST(HostileInput, AReaderTakesAnyOtherFile) {
    const auto all = samples();
    for (const auto& [name, own] : all) {
        for (const auto& [other, content] : all) {
            if (name != other) expect_answer(name, content);
        }
        expect_answer(name, "");
        expect_answer(name, std::string(1000, '\0'));
        expect_answer(name, std::string(100000, '1'));
        expect_answer(name, std::string(100000, ','));
        expect_answer(name, std::string(100000, '\n'));
        expect_answer(name, "@" + std::string(100000, ','));
    }
}

TEST(HostileInput, WindowsLineEndsChangeNothing) {
    for (const auto& [name, whole] : samples()) {
        if (name == "irap-grid-binary") continue;
        std::string crlf;
        for (const char c : whole) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
        const Dataset d = good(name, crlf);
        ASSERT_EQ(d.objects.size(), 1) << name;
        EXPECT_EQ(well_written(name, d, {{"attributes", "rms"}}).bytes, whole) << name;
    }
}

TEST(Stopping, IsHeardByEveryReader) {
    std::atomic<bool> stop{true};
    Monitor monitor;
    monitor.stop = &stop;
    const Dataset grid = grid_dataset({300, 300}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, std::vector<double>(90000, 1.5));
    for (const char* name : {"irap-grid", "irap-grid-binary", "zmap", "cps3"}) {
        const auto d = format(name).read(text(well_written(name, grid).bytes), {{}, &monitor});
        ASSERT_FALSE(d) << name;
        EXPECT_EQ(d.why().kind, FailureKind::cancelled) << name;
    }
    std::string rows;
    for (int i = 0; i < 40000; ++i) rows += "1 2 3\n";
    for (const char* name : {"irap-points", "irap-polygons"}) {
        const auto d = format(name).read(text(rows), {{}, &monitor});
        ASSERT_FALSE(d) << name;
        EXPECT_EQ(d.why().kind, FailureKind::cancelled) << name;
    }
}

}  // namespace
}  // namespace geomend::test
