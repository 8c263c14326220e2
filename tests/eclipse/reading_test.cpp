// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "eclipse_testing.h"
#include "formats/eclipse/array_writer.h"
#include "formats/eclipse/arrays.h"
#include "formats/eclipse/byte_order.h"
#include "formats/eclipse/kept_arrays.h"
#include "support/corner_point_samples.h"

namespace geomend::test {
namespace {

using eclipse::ArrayWriter;
using Build = std::function<void(ArrayWriter&)>;

/// The bytes of a file of arrays.
std::string bytes_of(const Build& build, bool formatted = false) {
    TemporaryFolder folder;
    OutputSet out(folder / "arrays");
    ArrayWriter writer(out.main_file(), formatted);
    build(writer);
    EXPECT_TRUE(out.commit().ok());
    return read_file(folder / "arrays");
}

Result<Dataset> read_bytes(std::string bytes, std::string_view row, std::string name = "memory.EGRID") {
    return eclipse_row(row).read(Input::from_memory(std::move(bytes), std::move(name)), {});
}

std::string code_of(const Result<Dataset>& data) { return data.ok() ? "" : data.why().error.code; }

std::vector<std::int32_t> head(std::initializer_list<std::int32_t> first, std::size_t size = 100) {
    std::vector<std::int32_t> all(first);
    all.resize(size, 0);
    return all;
}

/// A cube of 1 x 1 x 1 cells; what is asked for is changed.
struct Cube {
    std::vector<std::int32_t> dims = head({1, 1, 1, 1});
    std::vector<float> coord, zcorn = {10, 10, 10, 10, 15, 15, 15, 15};
    std::vector<std::int32_t> actnum = {1};
    bool end = true;
    Cube() {
        for (const float y : {0.0F, 20.0F}) {
            for (const float x : {0.0F, 10.0F}) coord.insert(coord.end(), {x, y, 10, x, y, 15});
        }
    }
    std::string bytes(bool formatted = false) const {
        return bytes_of(
            [&](ArrayWriter& w) {
                w.integers("FILEHEAD", head({3, 2007, 0, 3, 0, 0, 1}));
                w.integers("GRIDHEAD", dims);
                w.floats("COORD", coord);
                w.floats("ZCORN", zcorn);
                w.integers("ACTNUM", actnum);
                if (end) w.integers("ENDGRID", {});
            },
            formatted);
    }
};

TEST(ReadEgrid, WrongArraysAreRefusedWithTheirPlace) {
    for (const bool formatted : {false, true}) {
        const char* row = formatted ? "fegrid" : "egrid";
        const auto code = [&](const Cube& cube) { return code_of(read_bytes(cube.bytes(formatted), row)); };
        EXPECT_EQ(code(Cube{}), "");
        Cube cube;
        cube.zcorn.pop_back();
        EXPECT_EQ(code(cube), "F008");
        const auto data = read_bytes(cube.bytes(formatted), row);
        EXPECT_NE(data.why().error.message.find("expected 8 values of 'ZCORN', found 7"), std::string::npos) << data.why().error.message;
        EXPECT_TRUE(formatted ? data.why().error.where.line == 44 : data.why().error.where.offset == 992)
            << to_string(data.why().error.where);
        cube = {};
        cube.coord.push_back(0);
        EXPECT_EQ(code(cube), "F008");
        cube = {};
        cube.actnum = {1, 1};
        EXPECT_EQ(code(cube), "F008");
        cube.actnum = {-1};
        EXPECT_EQ(code(cube), "F012");
        cube = {};
        cube.dims[1] = 0;
        EXPECT_EQ(code(cube), "F014");
        cube.dims = head({1, 2000000000, 2000000000, 2000000000});
        EXPECT_EQ(code(cube), "F014");
        cube.dims = head({2, 1, 1, 1});
        EXPECT_EQ(code(cube), "F013");
        cube = {};
        cube.dims[24] = 2;
        EXPECT_EQ(code(cube), "F014");
        cube = {};
        cube.end = false;
        EXPECT_EQ(code(cube), "F004");
    }
}

TEST(ReadInit, APropertyWithNeitherAllNorTheActiveCellsIsRefused) {
    const auto init = [](std::size_t count, const char* name) {
        return bytes_of([&](ArrayWriter& w) {
            std::vector<std::int32_t> intehead = head({}, 100);
            intehead[8] = 2, intehead[9] = 2, intehead[10] = 1, intehead[11] = 3;
            w.integers("INTEHEAD", intehead);
            w.floats("PORV", std::vector<float>{1, 0, 1, 1});
            w.floats(name, std::vector<float>(count, 0.5F));
        });
    };
    EXPECT_EQ(code_of(read_bytes(init(3, "PORO"), "init", "memory.INIT")), "");
    EXPECT_EQ(code_of(read_bytes(init(4, "PORO"), "init", "memory.INIT")), "");
    const auto data = read_bytes(init(2, "PORO"), "init", "memory.INIT");
    EXPECT_EQ(code_of(data), "F008");
    EXPECT_NE(data.why().error.message.find("expected 4 values of 'PORO' (or 3, those of active cells), found 2"), std::string::npos)
        << data.why().error.message;
    const auto kept = read_bytes(init(2, "WONDER"), "init", "memory.INIT");
    ASSERT_TRUE(kept.ok());
    const auto losses = eclipse::losses_of_arrays(*kept);
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].what, "array WONDER");
}

TEST(ReadEgrid, NonFiniteCoordinatesAreRefusedAtTheirOffset) {
    Cube cube;
    cube.zcorn[3] = std::numeric_limits<float>::quiet_NaN();
    const std::string bytes = cube.bytes();
    const auto data = read_bytes(bytes, "egrid");
    ASSERT_EQ(code_of(data), "F006");
    const auto at = static_cast<std::size_t>(data.why().error.where.offset);
    EXPECT_EQ(bytes.substr(at, 2), "\x7f\xc0");
    cube.zcorn[3] = 1e30F;  // large ones are for the checks
    EXPECT_EQ(code_of(read_bytes(cube.bytes(), "egrid")), "");
}

/// An array in records of a length that is asked for, as other programs write them.
std::string in_records(const char* name, const char* type, const std::vector<std::uint32_t>& words, std::size_t block) {
    std::string bytes;
    const auto put = [&bytes](std::uint32_t v) {
        bytes.resize(bytes.size() + 4);
        eclipse::put_word(bytes.data() + bytes.size() - 4, v);
    };
    put(16);
    bytes += name;
    put(static_cast<std::uint32_t>(words.size()));
    bytes += type;
    put(16);
    for (std::size_t first = 0; first < words.size(); first += block) {
        const std::size_t n = std::min(block, words.size() - first);
        put(static_cast<std::uint32_t>(4 * n));
        for (std::size_t i = first; i != first + n; ++i) put(words[i]);
        put(static_cast<std::uint32_t>(4 * n));
    }
    return bytes;
}

TEST(ReadEgrid, ValuesAreTheSameInRecordsOfAnyLength) {
    std::vector<std::uint32_t> reals(5003), integers(5003);
    for (std::size_t i = 0; i != reals.size(); ++i) {
        reals[i] = std::bit_cast<std::uint32_t>(static_cast<float>(i) * -0.37F);
        integers[i] = i * 7 % 256;
    }
    for (const std::size_t block : {1, 7, 1000, 1024, 1025, 5003}) {
        SCOPED_TRACE(block);
        const std::string bytes = in_records("ZCORN   ", "REAL", reals, block) + in_records("ACTNUM  ", "INTE", integers, block);
        const auto file = eclipse::find_arrays(Input::from_memory(bytes, "x"), nullptr);
        ASSERT_TRUE(file.ok());
        const auto values = eclipse::reals(*file, file->arrays[0]);
        const auto flags = eclipse::flags(*file, file->arrays[1]);
        ASSERT_TRUE(values.ok() && flags.ok());
        ASSERT_EQ(values->size(), reals.size());
        ASSERT_EQ(flags->size(), reals.size());
        for (std::size_t i = 0; i != reals.size(); ++i) {
            EXPECT_EQ((*values)[i], static_cast<double>(std::bit_cast<float>(reals[i])));
            EXPECT_EQ((*flags)[i], integers[i]);
        }
    }
}

TEST(ReadEgrid, TheFirstWrongValueIsFoundWhereverItStands) {
    const std::vector<std::uint32_t> good(3001, 0x3f800000u);
    for (const std::size_t at : {0, 1, 31, 1023, 1024, 2999, 3000}) {
        for (const std::uint32_t wrong : {0x7f800000u, 0xff800000u, 0x7fc00000u, 0xff800001u}) {
            SCOPED_TRACE(at);
            auto words = good;
            words[at] = wrong;
            words[3000] = wrong;
            const std::string bytes = in_records("ZCORN   ", "REAL", words, 700);
            const auto file = eclipse::find_arrays(Input::from_memory(bytes, "x"), nullptr);
            ASSERT_TRUE(file.ok());
            const auto values = eclipse::reals(*file, file->arrays[0]);
            ASSERT_FALSE(values.ok());
            EXPECT_EQ(values.why().error.where.offset, static_cast<std::int64_t>(28 + 4 * at + 8 * (at / 700)));
        }
        auto words = std::vector<std::uint32_t>(3001, 1);
        words[at] = 256;
        const auto file = eclipse::find_arrays(Input::from_memory(in_records("ACTNUM  ", "INTE", words, 700), "x"), nullptr);
        ASSERT_TRUE(file.ok());
        EXPECT_FALSE(eclipse::flags(*file, file->arrays[0]).ok());
    }
}

TEST(ReadEgrid, RecordsThatDoNotFitAreRefused) {
    const std::string bytes = Cube{}.bytes();
    const auto with = [&](std::size_t at, char c) {
        std::string b = bytes;
        b[at] = c;
        return code_of(read_bytes(b, "egrid"));
    };
    EXPECT_EQ(with(3, 17), "F012");    // length before the first header
    EXPECT_EQ(with(23, 17), "F012");   // and after it
    EXPECT_EQ(with(16, 'X'), "F012");  // type
    EXPECT_EQ(with(12, '\x7f'), "F004");
    EXPECT_EQ(with(12, '\x80'), "F014");
    EXPECT_EQ(with(27, '\x91'), "F012");           // length of the values, not a multiple of their size
    EXPECT_EQ(with(24 + 4 + 400 + 3, 1), "F012");  // and after them
    std::string turned = bytes;
    std::swap(turned[0], turned[3]);
    EXPECT_EQ(code_of(read_bytes(turned, "egrid")), "F013");
}

TEST(ReadEgrid, ConnectionsOfCellsThatAreNotThereAreRefused) {
    const auto code = [&](std::int32_t a, std::int32_t b, std::int32_t grid) {
        const std::string more = bytes_of([&](ArrayWriter& w) {
            w.integers("NNCHEAD", head({1, grid}, 10));
            w.integers("NNC1", std::vector{a});
            w.integers("NNC2", std::vector{b});
        });
        return code_of(read_bytes(Cube{}.bytes() + more, "egrid"));
    };
    EXPECT_EQ(code(1, 1, 0), "");
    EXPECT_EQ(code(0, 1, 0), "F007");
    EXPECT_EQ(code(1, 2, 0), "F007");
    EXPECT_EQ(code(1, 1, 5), "F007");
}

TEST(ReadEgrid, UnknownArraysGoBack) {
    const std::string more = bytes_of([&](ArrayWriter& w) {
        w.integers("FILEHEAD", head({3, 2007}));
        w.integers("GRIDHEAD", Cube{}.dims);
        w.integers("BOXORIG", std::vector<std::int32_t>{1, 2, 3});
        w.texts("WORDS", std::vector<std::string>{"it's", "", "*"}, 12);
        w.doubles("EXACT", std::vector<double>{0.1, 0.1, -3e-300});
        w.logicals("FLAGS", std::vector<std::uint8_t>{1, 0, 0, 1});
        w.message("NOTE");
        w.floats("COORD", Cube{}.coord);
        w.floats("ZCORN", Cube{}.zcorn);
        w.integers("ENDGRID", {});
    });
    TemporaryFolder folder;
    const auto data = read_bytes(more, "egrid");
    ASSERT_EQ(code_of(data), "");
    for (const char* row : {"egrid", "fegrid"}) {
        write_eclipse(*data, row, folder / "memory.EGRID");
        const auto back = read_eclipse(folder / "memory.EGRID");
        const auto &a = grid_of(data).info.annotations, &b = grid_of(back).info.annotations;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 2; i < a.size(); ++i) EXPECT_EQ(a[i].value, b[i].value);
    }
}

TEST(ReadEgrid, ManyRecordsAndBothKindsOfTruthAreRead) {
    std::vector<std::int32_t> many(12345);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::int32_t>(i * 7919);
    for (const bool formatted : {false, true}) {
        std::string bytes = bytes_of(
            [&](ArrayWriter& w) {
                w.integers("MANY", many);
                w.logicals("FLAGS", std::vector<std::uint8_t>{1, 0, 1});
            },
            formatted);
        if (!formatted) bytes[bytes.size() - 7] = 0, bytes[bytes.size() - 6] = 0, bytes[bytes.size() - 5] = 0, bytes[bytes.size() - 8] = 1;
        const auto file = eclipse::find_arrays(Input::from_memory(bytes, "x"), nullptr);
        ASSERT_TRUE(file.ok());
        ASSERT_EQ(file->arrays.size(), 2u);
        EXPECT_EQ(*eclipse::integers(*file, file->arrays[0]), many);
        EXPECT_EQ(*eclipse::logicals(*file, file->arrays[1]), (std::vector<std::uint8_t>{1, 0, 1}));
    }
}

TEST(ReadEgrid, FormattedNumbersHaveTheirPlaceInMessages) {
    std::string text = Cube{}.bytes(true);
    const std::size_t at = text.find("0.15000000E+02");
    text.replace(at, 14, "0.15oo0000E+02");
    const auto data = read_bytes(text, "fegrid");
    ASSERT_EQ(code_of(data), "F005");
    EXPECT_NE(data.why().error.message.find("0.15oo0000E+02"), std::string::npos);
    EXPECT_GT(data.why().error.where.line, 38u);
    text = Cube{}.bytes(true);
    text.replace(text.find("0.15000000E+02"), 14, "  1.5D+1      ");
    EXPECT_EQ(code_of(read_bytes(text, "fegrid")), "");
}

// ---- the old GRID ----

struct OldCell {
    std::array<std::int32_t, 3> ijk;
    std::array<float, 24> corners;
};

/// A column of boxes, of which those asked for are in the file.
std::string old_grid(const std::vector<int>& layers, bool formatted, float bend = 0) {
    return bytes_of(
        [&](ArrayWriter& w) {
            w.integers("DIMENS", std::vector<std::int32_t>{2, 1, 4});
            for (const int k : layers) {
                w.integers("COORDS", std::vector<std::int32_t>{1, 1, k, 2 * k - 1, 1});
                std::vector<float> corners;
                for (int c = 0; c < 8; ++c) {
                    const float z = 100.0F + 10.0F * static_cast<float>(k - 1 + (c >> 2));
                    const float lean = (z - 100) / 10 + (k == 3 && c == 1 ? bend : 0);
                    corners.insert(corners.end(), {static_cast<float>(c & 1) * 50 + lean, static_cast<float>(c >> 1 & 1) * 40, z});
                }
                w.floats("CORNERS", corners);
            }
        },
        formatted);
}

TEST(ReadOldGrid, PillarsRunThroughTheCornersAndAbsentCellsAreInactive) {
    for (const bool formatted : {false, true}) {
        const auto data = read_bytes(old_grid({1, 2, 4}, formatted), formatted ? "fgrid" : "grid");
        const CornerPointGrid& grid = grid_of(data);
        EXPECT_EQ(misfit(grid), "");
        EXPECT_EQ(grid.dims, (std::array<std::uint32_t, 3>{2, 1, 4}));
        EXPECT_EQ(grid.activity, (std::vector<std::uint8_t>{1, 0, 1, 0, 0, 0, 1, 0}));
        EXPECT_EQ(std::vector<double>(grid.pillars.begin(), grid.pillars.begin() + 12),
                  (std::vector<double>{0, 0, 100, 4, 0, 140, 50, 0, 100, 54, 0, 140}));
        EXPECT_EQ(grid.pillars[12], 100.0);  // one more step of 50
        const auto between = cell_corners(grid, 0, 0, 2);
        EXPECT_EQ(between[0][2], 120.0);
        EXPECT_EQ(between[4][2], 130.0);
        ASSERT_EQ(data->findings.size(), 1u);
        EXPECT_EQ(data->findings[0].code, "F134");
        EXPECT_EQ(data->findings[0].count, 5u);
    }
}

TEST(ReadOldGrid, CornersOffTheirLineNameTheCell) {
    const auto data = read_bytes(old_grid({1, 2, 3, 4}, false, 0.5F), "grid");
    ASSERT_EQ(code_of(data), "F013");
    EXPECT_NE(data.why().error.message.find("corner 2 of cell (1,1,3)"), std::string::npos) << data.why().error.message;
}

TEST(ReadOldGrid, CellsTwiceOrOutsideAreRefused) {
    EXPECT_EQ(code_of(read_bytes(old_grid({1, 1}, false), "grid")), "F009");
    EXPECT_EQ(code_of(read_bytes(old_grid({1, 5}, false), "grid")), "F007");
    EXPECT_EQ(code_of(read_bytes(old_grid({}, false), "grid")), "F004");
}

// ---- restart files ----

std::string restart(bool unified, bool formatted, const std::vector<float>& pressure) {
    return bytes_of(
        [&](ArrayWriter& w) {
            for (int step = 0; step < (unified ? 2 : 1); ++step) {
                if (unified) w.integers("SEQNUM", std::vector<std::int32_t>{10 + step});
                auto ints = head({0, 0, 2, 0, 0, 0, 0, 0, 2, 1, 2, static_cast<std::int32_t>(pressure.size())}, 411);
                ints[64] = 3 + step;
                ints[65] = 2;
                ints[66] = 2021;
                w.integers("INTEHEAD", ints);
                w.doubles("DOUBHEAD", std::vector<double>{1.5 + step, 1});
                w.doubles("XWEL", std::vector<double>{1, 2, 3, 4});
                w.message("STARTSOL");
                auto values = pressure;
                for (float& v : values) v += static_cast<float>(step);
                w.floats("PRESSURE", values);
                w.message("ENDSOL");
            }
        },
        formatted);
}

TEST(ReadRestart, StepsBecomeAttributesWithTheirTime) {
    for (const bool formatted : {false, true}) {
        const auto data = read_bytes(restart(true, formatted, {1, 2, 3, 4}), formatted ? "funrst" : "unrst", "CASE.UNRST");
        const CornerPointGrid& grid = grid_of(data);
        EXPECT_EQ(grid.dims, (std::array<std::uint32_t, 3>{2, 1, 2}));
        ASSERT_EQ(grid.info.attributes.size(), 2u);
        const Attribute& a = grid.info.attributes[1];
        EXPECT_EQ(a.name, "PRESSURE_20210204");
        EXPECT_EQ(a.unit, "psia");
        EXPECT_EQ(std::get<std::vector<float>>(a.values), (std::vector<float>{2, 3, 4, 5}));
        EXPECT_EQ(a.time, (TimeStep{"2021-02-04", 2.5, 11}));
        ASSERT_EQ(data->losses.size(), 1u);
        EXPECT_NE(data->losses[0].what.find("XWEL"), std::string::npos);
    }
}

TEST(ReadRestart, SingleFilesHaveTheirStepInTheirName) {
    const auto data = read_bytes(restart(false, false, {1, 2, 3, 4}), "unrst", "CASE.X0012");
    ASSERT_EQ(grid_of(data).info.attributes.size(), 1u);
    EXPECT_EQ(grid_of(data).info.attributes[0].time->number, 12);
}

TEST(ReadRestart, WithoutAGridActiveCellsAreNotGuessed) {
    EXPECT_EQ(code_of(read_bytes(restart(true, false, {1, 2, 3}), "unrst", "CASE.UNRST")), "F010");
}

TEST(ReadRestart, TheGridBesideItPlacesTheValues) {
    TemporaryFolder folder;
    CornerPointGrid grid = faulted_grid(2, 1, 2);
    write_eclipse(dataset_of(grid), "egrid", folder / "CASE.EGRID");
    write_file(folder / "CASE.UNRST", restart(true, false, {1, 2, 3}));
    const auto data = read_eclipse(folder / "CASE.UNRST");
    EXPECT_EQ(grid_of(data).depths, grid.depths);
    const auto missing = static_cast<float>(-9.99e20);
    EXPECT_EQ(std::get<std::vector<float>>(grid_of(data).info.attributes[0].values), (std::vector<float>{1, missing, 2, 3}));
}

// ---- binary GRDECL ----

TEST(ReadBgrdecl, SizesMayComeLastAndOtherArraysAreKept) {
    const Cube cube;
    const auto data = read_bytes(bytes_of([&](ArrayWriter& w) {
                                     w.floats("COORD", cube.coord);
                                     w.floats("ZCORN", cube.zcorn);
                                     w.floats("PORO", std::vector<float>{0.25F});
                                     w.integers("TOPOLOGY", std::vector<std::int32_t>{1, 2, 3});
                                     w.integers("SPECGRID", std::vector<std::int32_t>{1, 1, 1, 1});
                                 }),
                                 "bgrdecl");
    const CornerPointGrid& grid = grid_of(data);
    ASSERT_EQ(grid.info.attributes.size(), 1u);
    EXPECT_EQ(grid.info.attributes[0].name, "PORO");
    ASSERT_EQ(data->findings.size(), 1u);
    EXPECT_EQ(data->findings[0].code, "F102");
    ASSERT_EQ(grid.info.annotations.size(), 1u);
    EXPECT_EQ(grid.info.annotations[0].value, "'TOPOLOGY' INTE 3 1 2 3");
}

// ---- damaged files ----

std::vector<std::pair<std::string, std::string>> samples() {
    std::vector<std::pair<std::string, std::string>> all;
    TemporaryFolder folder;
    CornerPointGrid grid = faulted_grid(3, 2, 2);
    grid.connections = {{0, 5, std::nullopt}};
    grid.map_axes = std::array<double, 6>{0, 1, 0, 0, 1, 0};
    Attribute a;
    a.name = "PORO";
    a.location = AttributeLocation::cell;
    a.values = std::vector<float>(12, 0.25F);
    grid.info.attributes.push_back(a);
    for (const char* row : {"egrid", "fegrid", "init", "finit", "bgrdecl"}) {
        write_eclipse(dataset_of(grid), row, folder / "x");
        all.emplace_back(row, read_file(folder / "x"));
    }
    all.emplace_back("grid", old_grid({1, 2, 3, 4}, false));
    all.emplace_back("fgrid", old_grid({1, 2, 3, 4}, true));
    all.emplace_back("unrst", restart(true, false, {1, 2, 3, 4}));
    all.emplace_back("funrst", restart(true, true, {1, 2, 3, 4}));
    return all;
}

TEST(DamagedFiles, EgridIsRefusedWhereverItIsCut) {
    for (const auto& [row, bytes] : samples()) {
        if (row != "egrid" && row != "fegrid") continue;
        const std::size_t end = bytes.find("ENDGRID");
        for (std::size_t size = 1; size < end; size += 1 + size / 100)
            EXPECT_NE(code_of(read_bytes(bytes.substr(0, size), row)), "") << size;
    }
}

TEST(DamagedFiles, ChangedBytesNeverCrash) {
    for (auto& [row, bytes] : samples()) {
        std::uint32_t random = 99;
        for (int n = 0; n < 1500; ++n) {
            random = random * 1664525u + 1013904223u;
            const std::size_t at = (random >> 8) % bytes.size();
            const char before = bytes[at];
            bytes[at] = static_cast<char>(random >> 24);
            const auto data = read_bytes(bytes, row, "x");
            if (!data) {
                EXPECT_NE(data.why().error.code, "");
            }
            bytes[at] = before;
        }
    }
}

TEST(Sniffing, EachKindIsToldByItsFirstArrays) {
    for (const auto& [row, bytes] : samples()) {
        EXPECT_EQ(sniffed(Input::from_memory(bytes, "x")).name, row);
    }
    for (const Format& row : eclipse::formats()) EXPECT_EQ(row.sniff("SPECGRID\n 1 1 1 1 F /\n", "x.grdecl"), 0);
}

}  // namespace
}  // namespace geomend::test
