// SPDX-License-Identifier: AGPL-3.0-or-later
// Binary files of each version in both byte orders: the mesh of two_tets_22() with values.
#include <algorithm>
#include <bit>
#include <initializer_list>

#include "gmsh_support.h"

namespace geomend::test {
namespace {

/// Puts numbers as a machine of either byte order stores them.
class Bytes {
public:
    explicit Bytes(std::endian order) : turned_(order != std::endian::native) {}

    Bytes& text(std::string_view t) {
        bytes_ += t;
        return *this;
    }
    Bytes& ints(std::initializer_list<std::int32_t> values) {
        for (const std::int32_t v : values) put(v);
        return *this;
    }
    Bytes& sizes(std::initializer_list<std::uint64_t> values) {
        for (const std::uint64_t v : values) put(v);
        return *this;
    }
    Bytes& reals(std::initializer_list<double> values) {
        for (const double v : values) put(v);
        return *this;
    }
    std::string take() { return std::move(bytes_); }

private:
    template <class T>
    void put(T value) {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        if (turned_) std::ranges::reverse(raw);
        bytes_ += raw;
    }
    bool turned_;
    std::string bytes_;
};

constexpr double nodes[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1.5}, {0, 0, 1e-1}};

Bytes begin(std::endian order, const std::string& version) {
    Bytes b(order);
    b.text("$MeshFormat\n" + version + " 1 8\n").ints({1}).text("\n$EndMeshFormat\n");
    b.text("$PhysicalNames\n3\n2 7 \"fault\"\n3 1 \"lower\"\n3 2 \"upper \"B\"\"\n$EndPhysicalNames\n");
    return b;
}

void put_values(Bytes& b) {
    b.text("\n$NodeData\n1\n\"depth\"\n1\n0\n3\n0\n1\n5\n");
    for (std::int32_t i = 0; i < 5; ++i) b.ints({i + 1}).reals({100.0 + i});
    b.text("\n$EndNodeData\n$ElementData\n1\n\"porosity\"\n1\n0\n3\n0\n1\n2\n");
    b.ints({4}).reals({0.25}).ints({5}).reals({0.125});
    b.text("\n$EndElementData\n");
}

std::string msh_22(std::endian order) {
    Bytes b = begin(order, "2.2");
    b.text("$Nodes\n5\n");
    for (std::int32_t i = 0; i < 5; ++i) b.ints({i + 1}).reals({nodes[i][0], nodes[i][1], nodes[i][2]});
    b.text("\n$EndNodes\n$Elements\n5\n");
    b.ints({15, 1, 2, 1, 0, 1, 1}).ints({1, 1, 2, 2, 0, 1, 1, 2}).ints({2, 1, 2, 3, 7, 4, 1, 2, 3});
    b.ints({4, 2, 2, 4, 1, 1, 1, 3, 2, 4, 5, 2, 2, 1, 2, 3, 5}).text("\n$EndElements");
    put_values(b);
    return b.take();
}

// $Entities of MSH 4: dimension 0 has one position in 4.1, but a box in 4.0.
void put_entities(Bytes& b, bool v41) {
    b.text("$Entities\n").sizes({1, 1, 1, 2});
    b.ints({1}).reals({0, 0, 0});
    if (!v41) b.reals({0, 0, 0});
    b.sizes({0});
    b.ints({1}).reals({0, 0, 0, 1, 0, 0}).sizes({0}).sizes({1}).ints({1});
    b.ints({4}).reals({0, 0, 0, 1, 1, 0}).sizes({1}).ints({7}).sizes({1}).ints({1});
    b.ints({1}).reals({0, 0, -1.5, 1, 1, 0}).sizes({1}).ints({1}).sizes({1}).ints({4});
    b.ints({2}).reals({0, 0, 0, 1, 1, 0.1}).sizes({1}).ints({2}).sizes({1}).ints({-4});
    b.text("\n$EndEntities\n");
}

std::string msh_40(std::endian order) {
    Bytes b = begin(order, "4");
    put_entities(b, false);
    b.text("$Nodes\n").sizes({2, 5}).ints({4, 2, 0}).sizes({3});  // tag, dimension, parametric
    for (std::int32_t i = 0; i < 3; ++i) b.ints({i + 1}).reals({nodes[i][0], nodes[i][1], nodes[i][2]});
    b.ints({1, 3, 0}).sizes({2});
    for (std::int32_t i = 3; i < 5; ++i) b.ints({i + 1}).reals({nodes[i][0], nodes[i][1], nodes[i][2]});
    b.text("\n$EndNodes\n$Elements\n").sizes({5, 5});
    b.ints({1, 0, 15}).sizes({1}).ints({1, 1}).ints({1, 1, 1}).sizes({1}).ints({2, 1, 2});
    b.ints({4, 2, 2}).sizes({1}).ints({3, 1, 2, 3}).ints({1, 3, 4}).sizes({1}).ints({4, 1, 3, 2, 4});
    b.ints({2, 3, 4}).sizes({1}).ints({5, 1, 2, 3, 5}).text("\n$EndElements");
    put_values(b);
    return b.take();
}

std::string msh_41(std::endian order) {
    Bytes b = begin(order, "4.1");
    put_entities(b, true);
    b.text("$Nodes\n").sizes({2, 5, 1, 5}).ints({2, 4, 0}).sizes({3, 1, 2, 3});
    for (std::size_t i = 0; i < 3; ++i) b.reals({nodes[i][0], nodes[i][1], nodes[i][2]});
    b.ints({3, 1, 0}).sizes({2, 4, 5});
    for (std::size_t i = 3; i < 5; ++i) b.reals({nodes[i][0], nodes[i][1], nodes[i][2]});
    b.text("\n$EndNodes\n$Elements\n").sizes({5, 5, 1, 5});
    b.ints({0, 1, 15}).sizes({1, 1, 1}).ints({1, 1, 1}).sizes({1, 2, 1, 2});
    b.ints({2, 4, 2}).sizes({1, 3, 1, 2, 3}).ints({3, 1, 4}).sizes({1, 4, 1, 3, 2, 4});
    b.ints({3, 2, 4}).sizes({1, 5, 1, 2, 3, 5}).text("\n$EndElements");
    put_values(b);
    return b.take();
}

struct Make {
    const char* version;
    std::string (*bytes)(std::endian);
};

class MshBinary : public testing::TestWithParam<Make> {};

TEST_P(MshBinary, IsReadAlikeInBothByteOrders) {
    const auto text = read_text(two_tets_22());
    ASSERT_TRUE(text.ok());
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const auto read = read_text(GetParam().bytes(order));
        ASSERT_TRUE(read.ok()) << read.why().error.message;
        EXPECT_EQ(read->variant.find(std::string("MSH ") + GetParam().version), 0u) << read->variant;
        const CellMesh &m = mesh_of(*read), &wanted = mesh_of(*text);
        EXPECT_EQ(m.points, wanted.points);
        EXPECT_EQ(m.types, wanted.types);
        EXPECT_EQ(m.nodes, wanted.nodes);
        ASSERT_EQ(m.entities.size(), wanted.entities.size());
        for (std::size_t cell = 0; cell < m.cell_count(); ++cell) {
            const auto &mine = m.entities[m.cell_entity[cell]], &its = wanted.entities[wanted.cell_entity[cell]];
            EXPECT_EQ(mine.tag, its.tag);
            EXPECT_EQ(mine.name, its.name);
            EXPECT_EQ(m.cell_labels[cell], wanted.cell_labels[cell]);
        }
        const Attribute* depth = find_attribute(m.info.attributes, "depth", AttributeLocation::point);
        ASSERT_NE(depth, nullptr);
        EXPECT_EQ(value_as_double(*depth, 4), 104);
        const Attribute* porosity = find_attribute(m.info.attributes, "porosity", AttributeLocation::cell);
        ASSERT_NE(porosity, nullptr);
        EXPECT_EQ(value_as_double(*porosity, 4), 0.125);
        EXPECT_TRUE(is_no_data(*porosity, value_as_double(*porosity, 0)));
    }
}

TEST_P(MshBinary, CutsAreToldInBothByteOrders) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const std::string whole = GetParam().bytes(order);
        const std::size_t end_of_mesh = whole.find("$EndElements") + 12;
        for (std::size_t size = whole.find("$Nodes"); size < end_of_mesh; ++size) {
            const auto read = read_text(whole.substr(0, size));
            // Nodes without elements may be read; half a section may not.
            const std::string_view left = std::string_view(whole).substr(0, size);
            const bool between = left.ends_with("$EndNodes") || left.ends_with("$EndNodes\n");
            EXPECT_EQ(read.ok(), between) << size << " of " << whole.size();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Versions, MshBinary, testing::Values(Make{"2.2", msh_22}, Make{"4", msh_40}, Make{"4.1", msh_41}),
                         [](const auto& one) { return "Msh" + std::to_string(one.index); });

TEST(MshBinaryOrder, AnIntegerThatIsNotOneInAnyOrderIsRefused) {
    Bytes b(std::endian::native);
    b.text("$MeshFormat\n4.1 1 8\n").ints({2}).text("\n$EndMeshFormat\n");
    EXPECT_EQ(failure_of(b.take()).code, "F012");
}

}  // namespace
}  // namespace geomend::test
