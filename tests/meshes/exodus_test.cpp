// SPDX-License-Identifier: AGPL-3.0-or-later
// Exodus II and FEFLOW against readers that share nothing with the writers; sides and nodes as the manual of Exodus II draws them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/vectors.h"
#include "meshes/cell_samples.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

std::vector<Loss> write_file(CellMesh mesh, const char* format, const std::filesystem::path& file) {
    OutputSet out(file);
    auto losses = write_cells(std::move(mesh), format, out);
    EXPECT_TRUE(losses) << (losses ? "" : losses.why().error.message);
    return losses ? *losses : std::vector<Loss>{};
}

/// A classic netCDF file, read by its specification.
class Netcdf {
public:
    explicit Netcdf(std::string bytes) : bytes_(std::move(bytes)) {
        EXPECT_EQ(bytes_.substr(0, 4), std::string("CDF\2"));
        at_ = 4;
        records = word();
        std::vector<std::pair<std::string, std::uint32_t>> sizes;
        list([&] {
            sizes.emplace_back(text(), 0);
            sizes.back().second = word();
        });
        for (const auto& [name, size] : sizes) dimensions[name] = size;
        attribute_list("");
        list([&] {
            const std::string name = text();
            Variable v;
            for (std::uint32_t left = word(); left > 0; --left) v.count *= std::max(sizes.at(word()).second, 1u);
            attribute_list(name + ":");
            v.type = word();
            const std::uint32_t size = word();
            v.begin = std::uint64_t{word()} << 32;
            v.begin |= word();
            EXPECT_EQ(v.begin % 4, 0u) << name;
            EXPECT_EQ(size, (v.count * (v.type == 2 ? 1 : v.type == 6 ? 8 : 4) + 3) / 4 * 4) << name;
            variables[name] = v;
        });
        std::uint64_t end = at_;
        for (const auto& [name, v] : variables)
            end = std::max(end, v.begin + (v.count * (v.type == 2 ? 1 : v.type == 6 ? 8 : 4) + 3) / 4 * 4);
        EXPECT_EQ(bytes_.size(), end);
    }
    std::vector<double> numbers(const std::string& name) {
        const Variable& v = variables.at(name);
        std::vector<double> all;
        at_ = v.begin;
        for (std::uint64_t i = 0; i < v.count; ++i) {
            if (v.type == 4) all.push_back(static_cast<std::int32_t>(word()));
            else {
                const std::uint64_t high = word();
                all.push_back(std::bit_cast<double>(high << 32 | word()));
            }
        }
        return all;
    }
    std::vector<std::string> texts(const std::string& name, std::size_t length) const {
        const Variable& v = variables.at(name);
        std::vector<std::string> all;
        for (std::uint64_t i = 0; i + length <= v.count; i += length) all.emplace_back(bytes_.substr(v.begin + i, length).c_str());
        return all;
    }

    struct Variable {
        std::uint32_t type = 0;
        std::uint64_t count = 1, begin = 0;
    };
    std::uint32_t records = 0;
    std::map<std::string, std::uint32_t> dimensions;
    std::map<std::string, Variable> variables;
    std::map<std::string, std::string> attributes;

private:
    std::uint32_t word() {
        std::uint32_t value = 0;
        for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes_.at(at_++));
        return value;
    }
    std::string text() {
        const std::uint32_t size = word();
        std::string value = bytes_.substr(at_, size);
        at_ += (size + 3) / 4 * 4;
        return value;
    }
    template <class Item>
    void list(const Item& item) {
        word();
        for (std::uint32_t left = word(); left > 0; --left) item();
    }
    void attribute_list(const std::string& of) {
        list([&] {
            const std::string name = of + text();
            const std::uint32_t type = word();
            if (type == 2) attributes[name] = text();
            else {
                EXPECT_EQ(word(), 1u);
                word();
            }
        });
    }
    std::string bytes_;
    std::uint64_t at_ = 0;
};

/// Sides of the manual by node numbers from 1, wound outwards.
const std::map<std::string, std::vector<std::vector<std::size_t>>> manual_sides{
    {"TETRA", {{1, 2, 4}, {2, 3, 4}, {1, 4, 3}, {1, 3, 2}}},
    {"WEDGE", {{1, 2, 5, 4}, {2, 3, 6, 5}, {1, 4, 6, 3}, {1, 3, 2}, {4, 5, 6}}},
    {"HEX", {{1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {1, 5, 8, 4}, {1, 4, 3, 2}, {5, 6, 7, 8}}}};

std::vector<Vec3> points_of(Netcdf& file) {
    const auto x = file.numbers("coordx"), y = file.numbers("coordy"), z = file.numbers("coordz");
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i], z[i]});
    return points;
}

TEST(Exodus, EachTypeIsTheRightWayOutWithSidesAsTheManualNumbersThem) {
    for (const SampleCell& sample : sample_cells()) {
        if (!sample.edges.empty()) continue;
        const TemporaryFolder folder;
        write_file(mesh_of(sample), "exodus", folder / "m.exo");
        Netcdf file(read_file(folder / "m.exo"));
        const auto points = points_of(file);
        const std::string type = file.attributes.at("connect1:elem_type");
        std::vector<Vec3> corners;
        const auto nodes = file.numbers("connect1");
        for (const double n : nodes) corners.push_back(points.at(static_cast<std::size_t>(n) - 1));
        EXPECT_NEAR(flat_volume(corners), sample.volume, 1e-12) << type;
        const auto names = file.texts("ss_names", 33);
        ASSERT_EQ(names.size(), sample.faces.size());
        for (std::size_t s = 0; s < names.size(); ++s) {
            const auto side = file.numbers("side_ss" + std::to_string(s + 1));
            ASSERT_EQ(side.size(), 1u) << names[s];
            std::set<Vec3> found, known;
            for (const std::size_t n : manual_sides.at(type).at(static_cast<std::size_t>(side[0]) - 1)) found.insert(corners.at(n - 1));
            for (const std::uint32_t n : sample.faces.at(static_cast<std::size_t>(names[s].at(1) - '0'))) known.insert(sample.corners[n]);
            EXPECT_EQ(found, known) << type << ' ' << names[s];
        }
        EXPECT_EQ(file.texts("eb_names", 33), std::vector<std::string>{"rock"});
    }
}

TEST(Exodus, RegionsAreBlocksWithTheirValues) {
    CellMesh mesh = two_boxes(false);
    const auto add = [&](const char* name, AttributeLocation location, AttributeValues values, std::uint32_t components) {
        Attribute a;
        a.name = name;
        a.location = location;
        a.components = components;
        a.values = std::move(values);
        mesh.info.attributes.push_back(std::move(a));
    };
    std::vector<double> shift;
    for (const Vec3& p : mesh.points) shift.insert(shift.end(), {p[0], p[1], p[2] + 0.5});
    add("shift", AttributeLocation::point, shift, 3);
    add("a property with a name of more than thirty two characters", AttributeLocation::cell, std::vector<double>{0.25, 0.125, 0, 0, 0}, 1);
    add("rock", AttributeLocation::cell, std::vector<std::string>{"a", "b", "", "", ""}, 1);
    const TemporaryFolder folder;
    const auto losses = write_file(mesh, "exodus", folder / "m.exo");
    const auto is_lost = [&](const std::string& what) {
        return std::ranges::any_of(losses, [&](const Loss& loss) { return loss.what.find(what) != std::string::npos; });
    };
    EXPECT_TRUE(is_lost("'rock'"));
    EXPECT_TRUE(is_lost("the name of attribute 'a property"));
    Netcdf file(read_file(folder / "m.exo"));
    EXPECT_EQ(file.records, 1u);
    EXPECT_EQ(file.dimensions.at("num_el_blk"), 2u);
    EXPECT_EQ(file.dimensions.at("num_elem"), 2u);
    EXPECT_EQ(file.texts("eb_names", 33), (std::vector<std::string>{"west", "east"}));
    EXPECT_EQ(file.numbers("eb_prop1"), (std::vector<double>{1, 2}));
    EXPECT_EQ(file.attributes.at("eb_prop1:name"), "ID");
    const auto points = points_of(file);
    const auto names = file.texts("name_nod_var", 33);
    EXPECT_EQ(std::vector<std::string>(names.begin(), names.begin() + 3), (std::vector<std::string>{"shift_x", "shift_y", "shift_z"}));
    const auto height = file.numbers("vals_nod_var3");
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(height[i], points[i][2] + 0.5);
    std::set<double> values;
    const auto variables = file.texts("name_elem_var", 33);
    const auto found = std::ranges::find_if(variables, [](const std::string& n) { return n.starts_with("a property"); });
    ASSERT_NE(found, variables.end());
    const std::string number = std::to_string(found - variables.begin() + 1);
    EXPECT_EQ(file.numbers("vals_elem_var" + number + "eb1"), std::vector<double>{0.25});
    EXPECT_EQ(file.numbers("vals_elem_var" + number + "eb2"), std::vector<double>{0.125});
}

TEST(Feflow, ElementsLookOutWithTheirFirstFaceAndRegionsAreRanges) {
    for (const SampleCell& sample : sample_cells()) {
        if (!sample.edges.empty()) continue;
        const TemporaryFolder folder;
        write_file(mesh_of(sample), "feflow", folder / "m.fem");
        std::istringstream in(read_file(folder / "m.fem"));
        std::string line;
        std::size_t points = 0, cells = 0, code = 0;
        while (std::getline(in, line) && line != "DIMENS") {
        }
        in >> points >> cells;
        EXPECT_EQ(points, sample.corners.size());
        EXPECT_EQ(cells, 1u);
        while (std::getline(in, line) && line != "VARNODE") {
        }
        std::size_t least = 0, most = 0;
        in >> cells >> least >> most >> code;
        EXPECT_EQ(least, points);
        EXPECT_EQ(most, points);
        EXPECT_EQ(code, points == 4 ? 6u : points == 6 ? 7u : 8u);
        std::vector<std::size_t> nodes(points);
        for (std::size_t& n : nodes) in >> n;
        in >> line;
        ASSERT_EQ(line, "XYZCOOR");
        std::vector<Vec3> at(points);
        char comma = 0;
        for (Vec3& p : at) in >> p[0] >> comma >> p[1] >> comma >> p[2];
        std::vector<Vec3> corners;
        for (const std::size_t n : nodes) corners.push_back(at.at(n - 1));
        // The upper face comes first: with the lower one first, corners are as in Exodus.
        if (points > 4) std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(points / 2), corners.end());
        EXPECT_NEAR(flat_volume(corners), sample.volume, 1e-12);
        std::getline(in, line);
        std::getline(in, line);
        EXPECT_EQ(line, "ELEMENTALSETS");
        std::getline(in, line);
        EXPECT_EQ(line, " rock 1-1");
    }
}

TEST(Feflow, WellsAreDiscreteFeatures) {
    const TemporaryFolder folder;
    const auto losses = write_file(two_boxes(false), "feflow", folder / "m.fem");
    const std::string text = read_file(folder / "m.fem");
    EXPECT_NE(text.find("<group name=\"W\" mode=\"unstructured\">"), std::string::npos);
    EXPECT_NE(text.find("]]>\n </nop>"), std::string::npos);
    EXPECT_TRUE(text.ends_with("\nEND\n"));
    std::string lost;
    for (const Loss& loss : losses) lost += loss.entity + ": " + loss.what + "\n";
    EXPECT_NE(lost.find("F_footwall: face set"), std::string::npos) << lost;
}

}  // namespace
}  // namespace geomend::test
