// SPDX-License-Identifier: AGPL-3.0-or-later
#include <bit>
#include <set>

#include "gocad/gocad_support.h"
#include "support/real_data.h"

using namespace geomend;
using namespace geomend::test;

namespace {

const char* const axes = "AXIS_O 100 200 0\nAXIS_U 30 0 0\nAXIS_V 0 20 0\nAXIS_W 0 0 -10\nAXIS_MIN 0 0 0\n";

std::string voxet(const std::string& counts, const std::string& records = "", const std::string& high = "1 1 1") {
    return std::string("GOCAD Voxet 1\nHEADER {\nname: v\n}\n") + axes + "AXIS_MAX " + high + "\nAXIS_N " + counts + '\n' + records +
           "END\n";
}

std::string big_endian(std::initializer_list<std::uint32_t> words) {
    std::string bytes;
    for (const std::uint32_t w : words) {
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(w >> shift & 0xff);
    }
    return bytes;
}

std::string floats(std::initializer_list<float> values) {
    std::string bytes;
    for (const float v : values) bytes += big_endian({std::bit_cast<std::uint32_t>(v)});
    return bytes;
}

Result<Dataset> read_path(const std::filesystem::path& path) {
    auto input = Input::open(path.string());
    if (!input.ok()) return std::move(input).why();
    return gocad::read_gocad(*input, {});
}

Dataset good(const std::filesystem::path& path) {
    auto read = read_path(path);
    EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.why().error.code + ' ' + read.why().error.message);
    return read.ok() ? std::move(*read) : Dataset{};
}

// Writes and reads back, with companion files.
Dataset there_and_back(const Dataset& dataset, const char* format, std::vector<Loss>* losses = nullptr, const char* data = nullptr) {
    const TemporaryFolder folder;
    OutputSet files(folder / "out.vo");
    WriteOptions options;
    if (data != nullptr) options.options.emplace_back("data", data);
    auto done = format_row(format).write(dataset, files, options);
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.why().error.message);
    if (!done.ok()) return {};
    if (losses != nullptr) *losses = *done;
    EXPECT_TRUE(files.commit().ok());
    return good(folder / "out.vo");
}

template <class T>
const T& first(const Dataset& dataset) {
    return std::get<T>(dataset.objects.at(0));
}

void expect_same_attributes(const ObjectInfo& a, const ObjectInfo& b) {
    ASSERT_EQ(a.attributes.size(), b.attributes.size());
    for (std::size_t i = 0; i < a.attributes.size(); ++i) {
        const Attribute &x = a.attributes[i], &y = b.attributes[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.location, y.location) << x.name;
        EXPECT_EQ(x.components, y.components) << x.name;
        EXPECT_STREQ(type_name(x.values), type_name(y.values)) << x.name;
        EXPECT_TRUE(x.values == y.values) << x.name;
        EXPECT_EQ(x.unit, y.unit) << x.name;
        EXPECT_EQ(x.kind, y.kind) << x.name;
        EXPECT_EQ(x.property_class, y.property_class) << x.name;
        EXPECT_EQ(x.no_data, y.no_data) << x.name;
    }
}

Attribute attribute(const char* name, AttributeValues values, AttributeLocation location = AttributeLocation::point) {
    Attribute a;
    a.name = name;
    a.location = location;
    a.values = std::move(values);
    return a;
}

Dataset of(Object object) {
    Dataset dataset;
    dataset.objects.push_back(std::move(object));
    return dataset;
}

// 2 x 2 x 1 samples with values of every type that a Voxet stores.
Raster raster_of_all_types() {
    Raster raster;
    raster.info.name = "r";
    raster.dims = {2, 2, 1};
    raster.origin = {0.1, -2, 1.0 / 3};
    raster.step = {{{10, 0.5, 0}, {0, 1e-3, 0}, {0, 0, 7}}};
    auto& all = raster.info.attributes;
    all.push_back(attribute("f", std::vector<float>{0.1f, -99999, 1e-30f, 3}));
    all.back().no_data = -99999;
    all.back().unit = "m s";
    all.back().kind = "Real Number";
    all.push_back(attribute("i8", std::vector<std::int8_t>{-128, 127, 0, -1}));
    all.push_back(attribute("u8", std::vector<std::uint8_t>{0, 255, 1, 2}));
    all.push_back(attribute("i16", std::vector<std::int16_t>{-32768, 32767, 0, -1}));
    all.push_back(attribute("u16", std::vector<std::uint16_t>{0, 65535, 1, 2}));
    all.push_back(attribute("i32", std::vector<std::int32_t>{-2147483647 - 1, 2147483647, 0, -1}));
    all.push_back(attribute("u32", std::vector<std::uint32_t>{0, 4294967295u, 1, 2}));
    all.push_back(attribute("colour", std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 255}));
    all.back().components = 4;
    all.back().annotations.emplace_back("gocad.storage", "RGBA");
    return raster;
}

const char* const sgrid_head =
    "GOCAD SGrid 1\nHEADER {\nname:s\n}\nAXIS_N 3 2 2\nPROP_ALIGNMENT CELLS\n"
    "POINTS_OFFSET 0\nPOINTS_FILE s__points@@\nFLAGS_OFFSET 0\nFLAGS_FILE s__flags@@\n";

std::string sgrid_points() {
    std::string bytes;
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 3; ++i)
                bytes += floats({10.f * static_cast<float>(i), 5.f * static_cast<float>(j), -2.f * static_cast<float>(k)});
        }
    }
    return bytes;
}

void write_sgrid_files(const TemporaryFolder& folder, const std::string& records) {
    write_file(folder / "s.sg", sgrid_head + records + "END\n");
    write_file(folder / "s__points@@", sgrid_points());
    std::string flags(48, '\0');
    flags[47] = 1;  // not what follows from the place
    write_file(folder / "s__flags@@", flags);
    write_file(folder / "s__p@@", floats({0.5f, -99999}));
    write_file(folder / "s__r@@", std::string("\1\2\0\0\0\0\0\0\0\0\0\0", 12));
}

const char* const sgrid_records =
    "REGION left 0\nREGION right 1\n"
    "REGION_FLAGS_ARRAY_LENGTH 12\nREGION_FLAGS_BIT_LENGTH 2\nREGION_FLAGS_ESIZE 1\nREGION_FLAGS_OFFSET 0\nREGION_FLAGS_FILE s__r@@\n"
    "PROPERTY 1 phi\nPROP_UNIT 1 none\nPROP_NO_DATA_VALUE 1 -99999\nPROP_ESIZE 1 4\nPROP_ALIGNMENT 1 CELLS\nPROP_FILE 1 s__p@@\n"
    "SPLIT 1 0 0 10 0.25 -1.5 12 1 0 0 0 1 0 0 0\n"
    "FACE_SET top 2\n0 0 12 2\n";

}  // namespace

TEST(GocadVoxet, SamplesStandAtTheirSteps) {
    const Dataset data = dataset_of(voxet("4 3 2"));
    const Raster& raster = first<Raster>(data);
    EXPECT_EQ(sample_count(raster.dims), 24u);
    EXPECT_EQ(sample_position(raster, 1, 0, 0), (Vec3{110, 200, 0}));
    EXPECT_EQ(sample_position(raster, 3, 2, 1), (Vec3{130, 220, -10}));
}

TEST(GocadVoxet, OneSampleInADirectionIsNoDivisionByZero) {
    std::string text = voxet("2 2 1", "", "1 1 0");
    text.replace(text.find("AXIS_MIN 0 0 0"), 14, "AXIS_MIN 0.5 0 0");
    const Dataset data = dataset_of(text);
    const Raster& raster = first<Raster>(data);
    EXPECT_EQ(sample_position(raster, 0, 0, 0), (Vec3{115, 200, 0}));
    EXPECT_EQ(sample_position(raster, 1, 1, 0), (Vec3{130, 220, 0}));
}

TEST(GocadVoxet, FloatsAreBigEndianAndNoDataIsKnown) {
    const TemporaryFolder folder;
    write_file(folder / "v.vo",
               voxet("2 1 1", "PROPERTY 1 p\nPROP_ESIZE 1 4\nPROP_NO_DATA_VALUE 1 -99999\nPROP_OFFSET 1 3\nPROP_FILE 1 \"v p@@\"\n"));
    write_file(folder / "v p@@", "abc" + big_endian({0x3f800000, 0xc7c34f80}));
    const Dataset data = good(folder / "v.vo");
    const Attribute& p = first<Raster>(data).info.attributes.at(0);
    EXPECT_EQ(value_as_double(p, 0), 1.0);
    EXPECT_TRUE(is_no_data(p, value_as_double(p, 1)));
}

TEST(GocadVoxet, AllTypesComeBackAsTheyWere) {
    const Dataset data = of(raster_of_all_types());
    std::vector<Loss> losses;
    const Dataset back = there_and_back(data, "gocad-vo", &losses);
    EXPECT_TRUE(losses.empty()) << (losses.empty() ? "" : losses[0].what);
    ASSERT_EQ(back.objects.size(), 1u);
    const Raster &a = first<Raster>(data), &b = first<Raster>(back);
    EXPECT_EQ(a.dims, b.dims);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.step[0], b.step[0]);
    EXPECT_EQ(a.step[1], b.step[1]);
    expect_same_attributes(a.info, b.info);
}

TEST(GocadVoxet, TextHoldsAllTypesAndDoublesToo) {
    Raster raster = raster_of_all_types();
    raster.info.attributes.push_back(attribute("d", std::vector<double>{0.1, 1e300, -1.0 / 3, 0}));
    const Dataset data = of(raster);
    const Dataset back = there_and_back(data, "gocad-vo");  // doubles have no binary form: text is chosen
    ASSERT_EQ(back.objects.size(), 1u);
    expect_same_attributes(raster.info, first<Raster>(back).info);
}

TEST(GocadVoxet, RegionsComeBack) {
    Raster raster = raster_of_all_types();
    raster.info.sets.push_back({"rock a", AttributeLocation::point, {0, 3}});
    raster.info.sets.push_back({"b", AttributeLocation::point, {1}});
    const Dataset back = there_and_back(of(raster), "gocad-vo");
    ASSERT_EQ(back.objects.size(), 1u);
    const auto& sets = first<Raster>(back).info.sets;
    ASSERT_EQ(sets.size(), 2u);
    EXPECT_EQ(sets[0].name, "rock a");
    EXPECT_EQ(sets[0].members, (std::vector<std::uint32_t>{0, 3}));
    EXPECT_EQ(sets[1].members, (std::vector<std::uint32_t>{1}));
    EXPECT_EQ(first<Raster>(back).info.attributes.size(), raster.info.attributes.size());
}

TEST(GocadVoxet, ARegionWithoutANameIsNamedByItsBit) {
    Raster raster = raster_of_all_types();
    raster.info.sets.push_back({"", AttributeLocation::point, {0, 3}});
    const auto sets = first<Raster>(there_and_back(of(raster), "gocad-vo")).info.sets;
    ASSERT_EQ(sets.size(), 1u);
    EXPECT_TRUE(sets[0].name.starts_with("region_")) << sets[0].name;
    EXPECT_EQ(sets[0].members, (std::vector<std::uint32_t>{0, 3}));
}

TEST(GocadVoxet, CountsBeyondAllMeasureAreRefusedBeforeMemoryIsTaken) {
    const auto read = read_text(voxet("1000000000 1000000000 1000000000"));
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F014");
}

TEST(GocadVoxet, MissingAndShortCompanionFilesAreNamed) {
    const TemporaryFolder folder;
    write_file(folder / "v.vo", voxet("2 1 1", "PROPERTY 1 p\nPROP_ESIZE 1 4\nPROP_FILE 1 v_p@@\n"));
    auto read = read_path(folder / "v.vo");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F010");
    EXPECT_NE(read.why().error.message.find((folder / "v_p@@").string()), std::string::npos) << read.why().error.message;
    write_file(folder / "v_p@@", "1234567");
    read = read_path(folder / "v.vo");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F011");
}

TEST(GocadSGrid, CountsNodesAndHasValuesRegionsSplitsAndFaces) {
    const TemporaryFolder folder;
    write_sgrid_files(folder, sgrid_records);
    const Dataset data = good(folder / "s.sg");
    ASSERT_EQ(data.objects.size(), 1u);
    const auto& grid = first<StructuredGrid>(data);
    EXPECT_EQ(grid.points.size(), 12u);
    EXPECT_EQ(lattice_cell_count(grid.dims), 2u);
    EXPECT_EQ(grid.points[11], (Vec3{20, 5, -2}));
    const Attribute* phi = find_attribute(grid.info.attributes, "phi", AttributeLocation::cell);
    ASSERT_NE(phi, nullptr);
    EXPECT_EQ(value_count(*phi), 2u);
    ASSERT_EQ(grid.info.sets.size(), 2u);
    EXPECT_EQ(grid.info.sets[0].members, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(grid.info.sets[1].members, (std::vector<std::uint32_t>{1}));
    ASSERT_EQ(grid.splits.size(), 1u);
    EXPECT_EQ(grid.splits[0].cells, 0x11);
    ASSERT_EQ(grid.face_sets.size(), 1u);
    EXPECT_EQ(grid.face_sets[0].faces.size(), 2u);
}

TEST(GocadSGrid, ComesBackAsItWasFromBytesAndFromText) {
    const TemporaryFolder folder;
    write_sgrid_files(folder, sgrid_records);
    Dataset data = good(folder / "s.sg");
    auto& grid = std::get<StructuredGrid>(data.objects.at(0));
    for (const char* way : {"binary", "ascii"}) {
        std::vector<Loss> losses;
        const Dataset back = there_and_back(data, "gocad-sg", &losses, way);
        ASSERT_EQ(back.objects.size(), 1u) << way;
        const auto& b = first<StructuredGrid>(back);
        EXPECT_TRUE(losses.empty()) << way << ' ' << (losses.empty() ? "" : losses[0].what);
        EXPECT_EQ(grid.points, b.points) << way;
        expect_same_attributes(grid.info, b.info);
        ASSERT_EQ(b.info.sets.size(), 2u) << way;
        EXPECT_EQ(grid.info.sets[1].members, b.info.sets[1].members);
        ASSERT_EQ(b.splits.size(), 1u);
        EXPECT_EQ(grid.splits[0].position, b.splits[0].position);
        EXPECT_EQ(grid.splits[0].id, b.splits[0].id);
        EXPECT_EQ(grid.splits[0].cells, b.splits[0].cells);
        ASSERT_EQ(b.face_sets.size(), 1u);
        EXPECT_EQ(grid.face_sets[0].faces, b.face_sets[0].faces);
    }
}

TEST(GocadSGrid, PointsThatFloatsDoNotHoldGoOutInDoublePrecision) {
    StructuredGrid grid;
    grid.info.name = "g";
    grid.info.crs.stated = true;
    grid.info.crs.z_positive = ZPositive::depth;
    grid.dims = {2, 2, 1};
    grid.points = {{0.1, 0, -5}, {1, 0.2, -5}, {0, 1, -6}, {1, 1, 1.0 / 3}};
    grid.dead_cells = {1};
    const Dataset back = there_and_back(of(grid), "gocad-sg");
    ASSERT_EQ(back.objects.size(), 1u);
    EXPECT_EQ(first<StructuredGrid>(back).points, grid.points);
    EXPECT_EQ(first<StructuredGrid>(back).dead_cells, grid.dead_cells);
}

TEST(GocadSGrid, ShortPointsFileIsAnErrorAndSoIsANodeThatIsNotThere) {
    const TemporaryFolder folder;
    write_sgrid_files(folder, "");
    write_file(folder / "s__points@@", sgrid_points().substr(1));
    auto read = read_path(folder / "s.sg");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F011");
    write_sgrid_files(folder, "FACE_SET top 1\n12 0\n");
    read = read_path(folder / "s.sg");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F007");
}

TEST(GocadGrid2d, HeightsAreTurnedUpAndComeBack) {
    const TemporaryFolder folder;
    write_file(folder / "h.gs",
               "GOCAD GSurf 1\nHEADER {\nname:h\n}\n"
               "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n"
               "ORIGIN 100 200 0\nAXIS_U 10 0 0\nAXIS_V 0 20 0\nAXIS_W 0 0 1\nAXIS_MIN 0 0\nAXIS_MAX 2 1\nAXIS_N 3 2\nTYPE POINTS\n"
               "PROPERTY 1 Z\nPROP_NO_DATA_VALUE 1 -99999\nPROP_ESIZE 1 4\nPROP_FILE 1 h_z@@\n"
               "PROPERTY 2 amplitude\nPROP_ESIZE 2 4\nPROP_FILE 2 h_a@@\nEND\n");
    write_file(folder / "h_z@@", floats({1000, 1001.5f, -99999, 1003, 1004, 1005}));
    write_file(folder / "h_a@@", floats({1, 2, 3, 4, 5, 6}));
    const Dataset data = good(folder / "h.gs");
    ASSERT_EQ(data.objects.size(), 1u);
    const Raster& raster = first<Raster>(data);
    EXPECT_EQ(raster.dims, (std::array<std::uint32_t, 3>{3, 2, 1}));
    ASSERT_EQ(raster.height_attribute, 0u);
    EXPECT_EQ(value_as_double(raster.info.attributes[0], 1), -1001.5);
    EXPECT_EQ(value_as_double(raster.info.attributes[0], 2), -99999);
    EXPECT_EQ(raster.step[1], (Vec3{0, 20, 0}));
    std::vector<Loss> losses;
    const Dataset back = there_and_back(data, "gocad-gs", &losses);
    ASSERT_EQ(back.objects.size(), 1u);
    EXPECT_TRUE(losses.empty()) << (losses.empty() ? "" : losses[0].what);
    const Raster& again = first<Raster>(back);
    EXPECT_EQ(again.origin, raster.origin);
    EXPECT_EQ(again.step[0], raster.step[0]);
    EXPECT_EQ(again.height_attribute, 0u);
    EXPECT_EQ(again.info.crs.z_positive, ZPositive::depth);
    expect_same_attributes(raster.info, again.info);
}

TEST(GocadGrid2d, ValuesOfCellsStandAtTheirCentres) {
    const TemporaryFolder folder;
    write_file(folder / "c.gs",
               "GOCAD GSurf 1\nHEADER {\nname:c\n}\nORIGIN 0 0 0\nAXIS_U 10 0 0\nAXIS_V 0 20 0\nAXIS_W 0 0 1\nAXIS_MIN 0 0\nAXIS_MAX 2 1\n"
               "AXIS_N 3 2\nTYPE CELLS\nPROPERTY 1 Z\nPROP_ESIZE 1 4\nPROP_FILE 1 c_z@@\nEND\n");
    write_file(folder / "c_z@@", floats({7, 8}));
    const Dataset data = good(folder / "c.gs");
    ASSERT_EQ(data.objects.size(), 1u);
    const Raster& raster = first<Raster>(data);
    EXPECT_EQ(raster.dims, (std::array<std::uint32_t, 3>{2, 1, 1}));
    EXPECT_EQ(raster.origin, (Vec3{5, 10, 0}));
}

// In each kind of array object, in bytes and in text.
TEST(GocadArrays, PropertiesWithoutANameGetOneAndThatIsSaid) {
    const auto expect_named = [](const Dataset& dataset, const char* format, const char* data, std::size_t others) {
        std::vector<Loss> losses;
        const Dataset back = there_and_back(dataset, format, &losses, data);
        ASSERT_EQ(back.objects.size(), 1u);
        const auto &own = info_of(dataset.objects[0]).attributes, &found = info_of(back.objects[0]).attributes;
        ASSERT_EQ(found.size(), own.size());
        std::set<std::string> names;
        for (std::size_t i = 0; i < own.size(); ++i) {
            EXPECT_TRUE(names.insert(found[i].name).second) << found[i].name;
            EXPECT_EQ(found[i].name.starts_with("unnamed"),
                      own[i].name.find_first_not_of(" \n") == std::string::npos || own[i].name == "unnamed");
            EXPECT_EQ(found[i].values, own[i].values);
        }
        const auto is_of_name = [](const Loss& l) {
            return l.loss_class == LossClass::identity && l.what.find("no name") != std::string::npos;
        };
        EXPECT_EQ(std::ranges::count_if(losses, is_of_name), static_cast<std::ptrdiff_t>(own.size() - others));
    };
    const std::vector<Attribute> three{attribute("", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}),
                                       attribute("unnamed", std::vector<float>{2, 2, 3, 4, 5, 6, 7, 8}),
                                       attribute(" \n", std::vector<float>{3, 2, 3, 4, 5, 6, 7, 8})};
    Raster raster;
    raster.dims = {2, 2, 2};
    raster.info.attributes = three;
    StructuredGrid grid;
    grid.dims = {2, 2, 2};
    for (std::size_t n = 0; n < 8; ++n) grid.points.push_back({n & 1u ? 1.0 : 0.0, n & 2u ? 1.0 : 0.0, n & 4u ? 1.0 : 0.0});
    grid.info.attributes = three;
    for (const char* data : {"binary", "ascii"}) {
        SCOPED_TRACE(data);
        Dataset one;
        one.objects = {raster};
        expect_named(one, "gocad-vo", data, 1);
        one.objects = {grid};
        expect_named(one, "gocad-sg", data, 1);
    }
    Raster plan;
    plan.dims = {4, 2, 1};
    plan.info.attributes = {attribute("", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8})};
    plan.height_attribute = 0;
    Dataset one;
    one.objects = {plan};
    expect_named(one, "gocad-gs", nullptr, 0);
}

TEST(GocadVoxet, ValuesOfTheRealTextFileStandAtTheirSamples) {
    const auto path = real_data("gocad/test.vo");
    if (!path) GTEST_SKIP() << "test.vo is not here";
    const Dataset data = good(*path);
    ASSERT_EQ(data.objects.size(), 1u);
    const Raster& raster = first<Raster>(data);
    ASSERT_EQ(raster.dims, (std::array<std::uint32_t, 3>{10, 10, 10}));
    ASSERT_EQ(raster.info.attributes.size(), 1u);
    const auto value = [&](std::size_t i, std::size_t j, std::size_t k) {
        return value_as_double(raster.info.attributes[0], (k * 10 + j) * 10 + i);
    };
    EXPECT_NEAR(value(0, 0, 0), 6.48414, 5e-6);
    EXPECT_NEAR(value(5, 0, 9), 8.95907, 5e-6);
    EXPECT_NEAR(value(9, 9, 9), 7.21909, 5e-6);
}
