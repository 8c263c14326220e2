// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cstring>

#include "roff_testing.h"
#include "support/corner_point_samples.h"

namespace geomend::test {
namespace {

// One cell of 10 x 20 x 5, its top at 100.
std::string one_cell(
    const std::string& zvalues = "array byte splitEnz 8\n1 1 1 1 1 1 1 1\narray float data 8\n-105 -100 -105 -100 -105 -100 -105 -100\n") {
    return "roff-asc\n#a comment#\ntag filedata\nint byteswaptest 1\nchar filetype \"grid\"\nendtag\n"
           "tag dimensions\nint nX 1\nint nY 1\nint nZ 1\nendtag\n"
           "tag translate\nfloat xoffset 1000\nfloat yoffset 2000\nfloat zoffset 0\nendtag\n"
           "tag scale\nfloat xscale 1\nfloat yscale 1\nfloat zscale -1\nendtag\n"
           "tag subgrids\narray int nLayers 1\n1\nendtag\n"
           "tag cornerLines\narray float data 24\n0 0 -105 0 0 -100 0 20 -105 0 20 -100 10 0 -105 10 0 -100 10 20 -105 10 20 -100\nendtag\n"
           "tag zvalues\n" +
           zvalues +
           "endtag\n"
           "tag active\narray bool data 1\n1\nendtag\n"
           "tag eof\nendtag\n";
}

std::string code_of(const std::string& bytes) {
    const auto data = read_roff_bytes(bytes);
    return data.ok() ? "" : data.why().error.code;
}

TEST(ReadRoff, OffsetsAndScalesGiveDepths) {
    auto data = read_roff_bytes(one_cell());
    const CornerPointGrid& grid = grid_of(data);
    EXPECT_EQ(grid.pillars, (std::vector<double>{1000, 2000, 100, 1000, 2000, 105, 1010, 2000, 100, 1010, 2000, 105,
                                                 1000, 2020, 100, 1000, 2020, 105, 1010, 2020, 100, 1010, 2020, 105}));
    EXPECT_EQ(grid.depths, (std::vector<double>{100, 100, 100, 100, 105, 105, 105, 105}));
    EXPECT_EQ(grid.info.name, "memory");
}

TEST(ReadRoff, SplitNodesAndActivityMayBeMissing) {
    std::string text = one_cell("array float data 8\n-105 -100 -105 -100 -105 -100 -105 -100\n");
    const std::size_t active = text.find("tag active");
    text.erase(active, text.find("tag eof") - active);
    auto data = read_roff_bytes(text);
    EXPECT_EQ(grid_of(data).depths, (std::vector<double>{100, 100, 100, 100, 105, 105, 105, 105}));
    EXPECT_TRUE(grid_of(data).activity.empty());
}

TEST(ReadRoff, FourDepthsOfANodeAreOfTheColumnsSouthWestToNorthEast) {
    // Node (0,0,1), the top at the south-west: its only column is to the north-east, the fourth of the values.
    auto data = read_roff_bytes(
        one_cell("array byte splitEnz 8\n1 4 1 1 1 1 1 1\narray float data 11\n-105 -1 -2 -3 -99 -105 -100 -105 -100 -105 -100\n"));
    EXPECT_EQ(grid_of(data).depths, (std::vector<double>{99, 100, 100, 100, 105, 105, 105, 105}));
}

TEST(ReadRoff, TwoDepthsOfANodeAreBelowThenAbove) {
    auto data = read_roff_bytes(
        one_cell("array byte splitEnz 8\n2 2 1 1 1 1 1 1\narray float data 10\n-1 -106 -98 -2 -105 -100 -105 -100 -105 -100\n"));
    EXPECT_EQ(grid_of(data).depths, (std::vector<double>{98, 100, 100, 100, 106, 105, 105, 105}));
}

// A column of three cells of 1 x 1 x 1 in two subgrids, of one and two layers.
std::string three_layers(const std::string& layers) {
    return "roff-asc\ntag filedata\nint byteswaptest 1\nchar filetype \"grid\"\nendtag\n"
           "tag dimensions\nint nX 1\nint nY 1\nint nZ 3\nendtag\ntag subgrids\n" +
           layers +
           "endtag\ntag cornerLines\narray float data 24\n0 0 3 0 0 0 0 1 3 0 1 0 1 0 3 1 0 0 1 1 3 1 1 0\nendtag\n"
           "tag zvalues\narray float data 16\n3 2 1 0 3 2 1 0 3 2 1 0 3 2 1 0\nendtag\ntag eof\nendtag\n";
}

TEST(ReadRoff, SubgridsAreAPropertyOfCellsToo) {
    auto data = read_roff_bytes(three_layers("array int nLayers 2\n1 2\n"));
    const CornerPointGrid& grid = grid_of(data);
    ASSERT_EQ(grid.info.attributes.size(), 1U);
    EXPECT_EQ(grid.info.attributes[0].name, "SUBGRID");
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(grid.info.attributes[0].values), (std::vector<std::int32_t>{1, 2, 2}));
    // There and back it is no parameter: the tag says it.
    TemporaryFolder folder;
    write_roff(grid, text_row(), folder / "memory.roff");
    EXPECT_EQ(read_file(folder / "memory.roff").find("SUBGRID"), std::string::npos);
    auto back = read_roff(folder / "memory.roff");
    ASSERT_EQ(grid_of(back).info.attributes.size(), 1U);
    EXPECT_EQ(grid_of(back).info.attributes[0].values, grid.info.attributes[0].values);
    // A property that says something else is written.
    CornerPointGrid other = grid;
    std::get<std::vector<std::int32_t>>(other.info.attributes[0].values)[1] = 1;
    write_roff(other, text_row(), folder / "other.roff");
    EXPECT_NE(read_file(folder / "other.roff").find("SUBGRID"), std::string::npos);
}

TEST(ReadRoff, OneSubgridOrWrongOnesAreNoProperty) {
    for (const char* layers : {"array int nLayers 1\n3\n", "array int nLayers 2\n1 1\n", "array int nLayers 2\n4 -1\n", ""}) {
        auto data = read_roff_bytes(three_layers(layers));
        EXPECT_TRUE(grid_of(data).info.attributes.empty()) << layers;
        const bool is_one = layers == std::string("array int nLayers 1\n3\n");
        EXPECT_EQ(data->losses.size(), is_one ? 0u : 1u) << layers;
        EXPECT_EQ(std::ranges::count(data->findings, "F150", &Finding::code), is_one ? 0 : 1) << layers;
    }
}

TEST(ReadRoff, UnknownTagsGoBack) {
    std::string text = one_cell();
    text.insert(text.find("tag eof"), "tag mystery\nint a 3\narray char b 2\n\"x y\"\n\"\"\nbool c 1\ndouble d 0.5\nendtag\n");
    auto data = read_roff_bytes(text);
    TemporaryFolder folder;
    for (const Format* row : {&binary_row(), &text_row()}) {
        write_roff(grid_of(data), *row, folder / "memory.roff");
        auto back = read_roff(folder / "memory.roff");
        const auto& annotations = grid_of(back).info.annotations;
        const auto kept = std::ranges::find_if(annotations, [](const Annotation& a) { return a.value.starts_with("tag mystery"); });
        ASSERT_NE(kept, annotations.end());
        const auto before =
            std::ranges::find_if(grid_of(data).info.annotations, [](const Annotation& a) { return a.value.starts_with("tag mystery"); });
        EXPECT_EQ(kept->value, before->value);
        EXPECT_TRUE(std::ranges::any_of(annotations, [](const Annotation& a) { return a.value.starts_with("tag subgrids"); }));
    }
}

TEST(ReadRoff, BinaryFilesOfEitherByteOrderAreRead) {
    TemporaryFolder folder;
    const CornerPointGrid grid = faulted_grid(2, 1, 1);
    write_roff(grid, binary_row(), folder / "a.roff");
    std::string bytes = read_file(folder / "a.roff");
    // Turns the numbers of every value of four bytes.
    std::size_t at = 0;
    const auto word = [&] {
        const std::size_t end = bytes.find('\0', at);
        std::string w = bytes.substr(at, end - at);
        at = end + 1;
        return w;
    };
    const auto turn = [&] {
        std::uint32_t v = 0;
        std::memcpy(&v, bytes.data() + at, 4);
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(at) + 4);
        at += 4;
        return v;
    };
    while (at < bytes.size()) {
        std::string w = word();
        if (w == "array") {
            w = word();
            word();
            const std::uint32_t count = turn();
            for (std::uint32_t i = 0; i < count && (w == "int" || w == "float"); ++i) turn();
            if (w == "byte" || w == "bool") at += count;
        } else if (w == "int" || w == "float") {
            word();
            turn();
        } else if (w == "char") {
            word();
            word();
        }
    }
    auto data = read_roff_bytes(bytes);
    EXPECT_EQ(grid_of(data).depths, grid.depths);
    EXPECT_EQ(grid_of(data).pillars, grid.pillars);
}

TEST(ReadRoff, WrongFilesAreRefusedWithTheirPlace) {
    EXPECT_EQ(code_of(""), "F002");
    EXPECT_EQ(code_of("roff-hex"), "F003");
    EXPECT_EQ(code_of("roff-asc\ntag eof\nendtag\n"), "F017");
    std::string text = one_cell();
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string t = text;
        t.replace(t.find(from), from.size(), to);
        return t;
    };
    EXPECT_EQ(code_of(changed("nX 1", "nX 1000000000")), "F014");
    EXPECT_EQ(code_of(changed("nX 1", "nX 2")), "F008");
    EXPECT_EQ(code_of(changed("nX 1", "nX 1.5")), "F005");
    EXPECT_EQ(code_of(changed("splitEnz 8\n1", "splitEnz 8\n3")), "F012");
    EXPECT_EQ(code_of(changed("splitEnz 8\n1", "splitEnz 8\n4")), "F008");
    EXPECT_EQ(code_of(changed("data 8\n-105", "data 8\nnan")), "F006");
    EXPECT_EQ(code_of(changed("data 24", "data 999999999999")), "F014");
    EXPECT_EQ(code_of(changed("zscale -1", "zscale 0")), "F012");
    EXPECT_EQ(code_of(changed("tag active", "gat active")), "F012");
    const auto data = read_roff_bytes(changed("data 8\n-105", "data 8\n-1o5"));
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(data.why().error.code, "F005");
    EXPECT_EQ(data.why().error.where.line, 34u);
    EXPECT_EQ(data.why().error.where.column, 1u);
    EXPECT_NE(data.why().error.message.find("-1o5"), std::string::npos);
}

TEST(ReadRoff, CutFilesAreRefused) {
    TemporaryFolder folder;
    for (const Format* row : {&binary_row(), &text_row()}) {
        write_roff(faulted_grid(4, 3, 2), *row, folder / "a.roff");
        const std::string bytes = read_file(folder / "a.roff");
        for (std::size_t size = 0; size + 10 < bytes.size(); size += 1 + size / 50) EXPECT_NE(code_of(bytes.substr(0, size)), "") << size;
    }
}

TEST(ReadRoff, FlippedBytesNeverCrash) {
    TemporaryFolder folder;
    for (const Format* row : {&binary_row(), &text_row()}) {
        write_roff(faulted_grid(3, 2, 2), *row, folder / "a.roff");
        std::string bytes = read_file(folder / "a.roff");
        std::uint32_t random = 12345;
        for (int n = 0; n < 4000; ++n) {
            random = random * 1664525u + 1013904223u;
            const std::size_t at = (random >> 8) % bytes.size();
            const char before = bytes[at];
            bytes[at] = static_cast<char>(random >> 24);
            const auto data = read_roff_bytes(bytes);
            if (!data) {
                EXPECT_NE(data.why().error.code, "");
            }
            bytes[at] = before;
        }
    }
}

}  // namespace
}  // namespace geomend::test
