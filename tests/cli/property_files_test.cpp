// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>

#include "support/program.h"

// Files of cell properties by themselves, which do not state the numbers of cells.

namespace geomend::test {

namespace {

/// A number as such files store it, the highest byte first.
std::string stored(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255u);
    return bytes;
}

/// Text between the markers of its length.
std::string record(const std::string& bytes) {
    const std::string length = stored(static_cast<std::uint32_t>(bytes.size()));
    return length + bytes + length;
}

/// An array of single-precision numbers 1, 2, 3, ...
std::string array_of(const std::string& name, std::uint32_t count) {
    std::string values;
    for (std::uint32_t i = 1; i <= count; ++i) values += stored(std::bit_cast<std::uint32_t>(static_cast<float>(i)));
    return record(name + std::string(8 - name.size(), ' ') + stored(count) + "REAL") + record(values);
}

}  // namespace

TEST(BinaryPropertyFile, TakesTheNumbersOfCellsFromAnOption) {
    const TemporaryFolder folder;
    write_file(folder / "cond.bgrdecl", array_of("COND", 24));
    const std::string file = (folder / "cond.bgrdecl").string();
    const ProgramRun with = run_geomend({"info", "--json", file, "--option", "dims=4,3,2"});
    ASSERT_EQ(with.status, 0) << with.err;
    const auto object = nlohmann::json::parse(with.out).at(0).at("objects").at(0);
    EXPECT_EQ(object.at("dims"), (std::vector<int>{4, 3, 2}));
    EXPECT_NE(with.out.find("COND"), std::string::npos);
    const ProgramRun without = run_geomend({"info", file});
    EXPECT_EQ(without.status, 3);
    EXPECT_NE(without.err.find("dims=NX,NY,NZ"), std::string::npos) << without.err;
    const ProgramRun other = run_geomend({"validate", file, "--option", "dims=4,3,3"});
    EXPECT_NE((other.out + other.err).find("expected 36 values of 'COND', found 24 [F008]"), std::string::npos) << other.out << other.err;
}

TEST(PropertyFile, OfOneArrayWithAnotherCountIsNotReadAsIfItHadNone) {
    const TemporaryFolder folder;
    write_file(folder / "short.bgrdecl", array_of("COND", 20));
    write_file(folder / "facies.grdecl", "FACIES\n 10*1 2 /\n");
    for (const auto& [file, found] : {std::pair{"short.bgrdecl", "20"}, std::pair{"facies.grdecl", "11"}}) {
        const ProgramRun run = run_geomend({"info", (folder / file).string(), "--option", "dims=4,3,2"});
        EXPECT_EQ(run.status, 3) << file;
        EXPECT_NE(run.err.find("expected 24 values of"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find(std::string("found ") + found + " [F008]"), std::string::npos) << run.err;
    }
}

TEST(PropertyFile, UnknownNumbersOfAGridsOwnFileAreALossWhereOnlyDecksHoldThem) {
    const TemporaryFolder folder;
    write_file(folder / "grid.grdecl",
               "SPECGRID\n 1 1 1 1 F /\nCOORD\n 0 0 0 0 0 10 1 0 0 1 0 10 0 1 0 0 1 10 1 1 0 1 1 10 /\nZCORN\n 4*0 4*10 /\n"
               "WONDER\n 3*7 /\n");
    const ProgramRun run = run_geomend({"convert", (folder / "grid.grdecl").string(), "-o", (folder / "o.vtu").string()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("lost (identity): grid: numbers of the unknown keyword WONDER"), std::string::npos) << run.err;
}

}  // namespace geomend::test
